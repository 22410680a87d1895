"""How much of a Pico an image takes."""

from dataclasses import dataclass

from elftools.elf.constants import SH_FLAGS
from elftools.elf.elffile import ELFFile

from machine import BadImage

RAM_START = 0x2000_0000


@dataclass(frozen=True)
class Size:
    """Bytes."""

    # What is flashed: bootloader, code, constants and the first values of variables. What is retained lies elsewhere.
    flash: int
    # Variables, without the stack.
    ram: int


def size(path):
    """What an image takes."""
    flash = ram = 0
    with open(path, "rb") as file:
        for section in ELFFile(file).iter_sections():
            if not section["sh_flags"] & SH_FLAGS.SHF_ALLOC:
                continue
            flash += section["sh_size"] if section["sh_type"] != "SHT_NOBITS" else 0
            ram += section["sh_size"] if section["sh_addr"] >= RAM_START else 0
    if not flash or not ram:
        raise BadImage(f"{path} is no image of a Pico")
    return Size(flash, ram)
