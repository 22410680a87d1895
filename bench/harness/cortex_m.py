"""An emulated Cortex-M that calls functions of a bare ELF and counts the instructions they execute.

Counted is every instruction from the first one of the function to its return, called functions included. On a
Cortex-M4 an instruction that an IT block skips counts as well: it takes its place in the pipeline.
"""

from pathlib import Path

from elftools.elf.constants import SH_FLAGS
from elftools.elf.elffile import ELFFile
from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_MODE_MCLASS, UC_MODE_THUMB, Uc, UcError
from unicorn.arm_const import (
    UC_ARM_REG_LR,
    UC_ARM_REG_PC,
    UC_ARM_REG_SP,
    UC_CPU_ARM_CORTEX_M0,
    UC_CPU_ARM_CORTEX_M4,
)

# A Cortex-M0+ executes what a Cortex-M0 does.
CPUS = {"m0plus": UC_CPU_ARM_CORTEX_M0, "m4": UC_CPU_ARM_CORTEX_M4}

MEGABYTE = 1 << 20
FLASH, RAM, RETURN = 0x0000_0000, 0x2000_0000, 0x3000_0000
STACK_TOP = RAM + 14 * MEGABYTE
# More than any scan executes: a function that goes on for longer does not return.
TIMEOUT_US = 60_000_000

CONTRACT = ("bench_in", "bench_out", "bench_now_ms")


class BadImage(Exception):
    """The ELF does not keep the contract, or its code fails."""


class Machine:
    """One ELF, loaded."""

    def __init__(self, path, cpu):
        self.path = Path(path)
        self._uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self._uc.ctl_set_cpu_model(CPUS[cpu])
        self._uc.mem_map(FLASH, 32 * MEGABYTE)
        self._uc.mem_map(RAM, 16 * MEGABYTE)
        self._uc.mem_map(RETURN, 0x1000)
        self._load()
        self._executed = 0
        self._blocks = {}
        self._uc.hook_add(UC_HOOK_BLOCK, self._count_block)

    def _load(self):
        with self.path.open("rb") as file:
            elf = ELFFile(file)
            table = elf.get_section_by_name(".symtab")
            if table is None:
                raise BadImage(f"{self.path} has no symbols")
            self._symbols = {symbol.name: symbol["st_value"] for symbol in table.iter_symbols()}
            self.code = self.constants = self.ram = 0
            for section in elf.iter_sections():
                self._load_section(section)
        missing = [name for name in (*CONTRACT, "bench_init", "scan_once") if name not in self._symbols]
        if missing:
            raise BadImage(f"{self.path} has no {', '.join(missing)}")
        self.ram -= 4 * len(CONTRACT)
        # Initial values of variables lie in flash, too.
        self.flash = self.code + self.constants

    def _load_section(self, section):
        flags, size = section["sh_flags"], section["sh_size"]
        if not flags & SH_FLAGS.SHF_ALLOC or not size:
            return
        if section["sh_type"] != "SHT_NOBITS":
            self._uc.mem_write(section["sh_addr"], section.data())
        # For unwinding, which nobody does on the target.
        if section.name.startswith(".ARM.exidx"):
            return
        if flags & SH_FLAGS.SHF_WRITE:
            self.ram += size
            self.constants += size if section["sh_type"] != "SHT_NOBITS" else 0
        elif flags & SH_FLAGS.SHF_EXECINSTR:
            self.code += size
        else:
            self.constants += size

    def _count_block(self, _uc, address, size, _data):
        if address >= RETURN:
            return
        count = self._blocks.get((address, size))
        if count is None:
            count = self._blocks[address, size] = instructions(bytes(self._uc.mem_read(address, size)))
        self._executed += count

    def call(self, name):
        """Calls a function without arguments; the answer is how many instructions it executed."""
        self._executed = 0
        self._uc.reg_write(UC_ARM_REG_SP, STACK_TOP)
        self._uc.reg_write(UC_ARM_REG_LR, RETURN | 1)
        try:
            self._uc.emu_start(self._symbols[name] | 1, RETURN, TIMEOUT_US)
        except UcError as error:
            at = self._uc.reg_read(UC_ARM_REG_PC)
            raise BadImage(f"{self.path}: {name} fails at {at:#x}: {error}") from error
        if self._uc.reg_read(UC_ARM_REG_PC) & ~1 != RETURN:
            raise BadImage(f"{self.path}: {name} does not return")
        return self._executed

    def read(self, name):
        """A word of the contract."""
        return int.from_bytes(self._uc.mem_read(self._symbols[name], 4), "little")

    def write(self, name, value):
        """Writes a word of the contract."""
        self._uc.mem_write(self._symbols[name], (value & 0xFFFF_FFFF).to_bytes(4, "little"))


def instructions(code):
    """How many Thumb instructions these bytes are: 32 bits long when the first five bits say so, else 16."""
    count = at = 0
    while at < len(code):
        at += 4 if code[at + 1] >> 3 in (0b11101, 0b11110, 0b11111) else 2
        count += 1
    return count
