"""An emulated x86 in its 64-bit mode. The repetitions of a string instruction count one by one."""

from unicorn import UC_ARCH_X86, UC_HOOK_CODE, UC_MODE_64, Uc
from unicorn.x86_const import UC_X86_REG_RIP, UC_X86_REG_RSP

from machine import RETURN, STACK_TOP, Machine


class X86(Machine):
    """Any that knows no more than the first ones did: the images use no vectors."""

    def __init__(self, path):
        uc = Uc(UC_ARCH_X86, UC_MODE_64)
        super().__init__(path, uc)
        uc.hook_add(UC_HOOK_CODE, self._count)

    def _count(self, _uc, address, _size, _data):
        if address < RETURN:
            self._executed += 1

    def _enter(self, function):
        # As a call leaves it: the stack is aligned to 16 bytes but for the return address.
        top = STACK_TOP - 8
        self._uc.mem_write(top, RETURN.to_bytes(8, "little"))
        self._uc.reg_write(UC_X86_REG_RSP, top)
        return function

    def _at(self):
        return self._uc.reg_read(UC_X86_REG_RIP)
