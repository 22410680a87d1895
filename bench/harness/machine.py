"""An emulated processor that calls functions of a bare ELF and counts the instructions they execute.

Counted is every instruction from the first one of the function to its return, called functions included.
"""

from pathlib import Path

from elftools.elf.constants import SH_FLAGS
from elftools.elf.elffile import ELFFile
from unicorn import UcError

MEGABYTE = 1 << 20
FLASH, RAM, RETURN = 0x0000_0000, 0x2000_0000, 0x3000_0000
STACK_TOP = RAM + 14 * MEGABYTE
# More than any scan executes: a function that goes on for longer does not return.
TIMEOUT_US = 60_000_000

CONTRACT = ("bench_in", "bench_out", "bench_now_ms")


class BadImage(Exception):
    """The ELF does not keep the contract, or its code fails."""


class Machine:
    """One ELF, loaded. What is special to a processor is in its subclasses: how a function is entered, and how the
    instructions are counted, in `_executed`."""

    def __init__(self, path, uc):
        self.path = Path(path)
        self._uc = uc
        self._uc.mem_map(FLASH, 32 * MEGABYTE)
        self._uc.mem_map(RAM, 16 * MEGABYTE)
        self._uc.mem_map(RETURN, 0x1000)
        self._load()
        self._executed = 0

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

    def _enter(self, function):
        """Makes ready for a call that returns to RETURN; the answer is where to begin."""
        raise NotImplementedError

    def _at(self):
        """The address of the next instruction."""
        raise NotImplementedError

    def has(self, name):
        """Whether there is a function of that name."""
        return name in self._symbols

    def call(self, name):
        """Calls a function without arguments; the answer is how many instructions it executed."""
        self._executed = 0
        begin = self._enter(self._symbols[name])
        try:
            self._uc.emu_start(begin, RETURN, TIMEOUT_US)
        except UcError as error:
            raise BadImage(f"{self.path}: {name} fails at {self._at():#x}: {error}") from error
        if self._at() != RETURN:
            raise BadImage(f"{self.path}: {name} does not return")
        return self._executed

    def read(self, name):
        """A word of the contract."""
        return int.from_bytes(self._uc.mem_read(self._symbols[name], 4), "little")

    def write(self, name, value):
        """Writes a word of the contract."""
        self._uc.mem_write(self._symbols[name], (value & 0xFFFF_FFFF).to_bytes(4, "little"))

