"""An emulated Cortex-M. On a Cortex-M4 an instruction that an IT block skips counts as well: it takes its place in the
pipeline.
"""

from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_MODE_MCLASS, UC_MODE_THUMB, Uc
from unicorn.arm_const import UC_ARM_REG_LR, UC_ARM_REG_PC, UC_ARM_REG_SP

from machine import RETURN, STACK_TOP, Machine


class CortexM(Machine):
    """One of unicorn's models."""

    def __init__(self, path, model):
        uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        uc.ctl_set_cpu_model(model)
        super().__init__(path, uc)
        self._blocks = {}
        uc.hook_add(UC_HOOK_BLOCK, self._count_block)

    def _count_block(self, _uc, address, size, _data):
        if address >= RETURN:
            return
        count = self._blocks.get((address, size))
        if count is None:
            count = self._blocks[address, size] = instructions(bytes(self._uc.mem_read(address, size)))
        self._executed += count

    def _enter(self, function):
        self._uc.reg_write(UC_ARM_REG_SP, STACK_TOP)
        self._uc.reg_write(UC_ARM_REG_LR, RETURN | 1)
        return function | 1

    def _at(self):
        return self._uc.reg_read(UC_ARM_REG_PC) & ~1


def instructions(code):
    """How many Thumb instructions these bytes are: 32 bits long when the first five bits say so, else 16."""
    count = at = 0
    while at < len(code):
        at += 4 if code[at + 1] >> 3 in (0b11101, 0b11110, 0b11111) else 2
        count += 1
    return count
