"""Counts the images that script/bench has built, and prints or compares what it counted."""

import argparse
import sys
from pathlib import Path

import pico
import table
from counts import compare, count, to_text
from machine import BadImage
from processors import PROCESSORS
from schedule import Missed

BENCH = Path(__file__).resolve().parent.parent
COUNTS = BENCH / "counts.txt"
OWN = "this engine"
# The image that is flashed, with log and retain store: for the same processor, and with everything around the engine.
WHOLE = ("line_switcher", "pico")
HAND = {"C, Booleans": "bool", "C, bit words": "bits", "C, switch": "switch"}


def main():
    """The exit status is 1 when something is wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("images", type=Path, help="directory of PROGRAM.CPU.elf and PROGRAM.VARIANT.CPU.elf")
    parser.add_argument("mode", choices=("table", "check", "update"))
    parser.add_argument("programs", nargs="+", help="programs to count, for every processor that they were built for")
    parser.add_argument("--pico", type=Path, required=True, help="the image that is flashed")
    arguments = parser.parse_args()
    try:
        whole = pico.size(arguments.pico)
        if arguments.mode == "table":
            print_table(arguments.images, arguments.programs, whole)
            return 0
        counted = {
            (program, cpu): counts
            for program in arguments.programs
            for cpu, (counts, _) in count_own(arguments.images, program).items()
        }
        counted[WHOLE] = whole
    except (BadImage, Missed, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    if arguments.mode == "update":
        COUNTS.write_text(to_text(counted), encoding="utf-8")
        return 0
    return check(counted)


def check(counted):
    """Holds the counts to those checked in."""
    wrong, shrunk = compare(COUNTS.read_text(encoding="utf-8"), counted)
    for change in wrong:
        print(f"grown: {change}" if "->" in change else f"error: {change}")
    for change in shrunk:
        print(f"shrunk: {change}")
    if wrong or shrunk:
        print("help: `script/bench --update` writes the counts of now; commit them with their reason")
    print(f"{len(counted)} images counted: {len(wrong)} counts too high, {len(shrunk)} lower by more than 5 %")
    return 1 if wrong else 0


def schedule_of(images, program):
    """Written for the program, or generated with it."""
    written = BENCH / "schedules" / f"{program}.txt"
    return written if written.exists() else images / f"{program}.txt"


def count_own(images, program):
    """Counts this engine's images: for each processor the counts, and what was at the outputs."""
    counted = {}
    for cpu in PROCESSORS:
        elf = images / f"{program}.{cpu}.elf"
        if elf.exists():
            counted[cpu] = count(elf, cpu, schedule_of(images, program))
            demand_same(elf, next(iter(counted.values()))[1], counted[cpu][1])
    return counted


def print_table(images, programs, whole):
    """Every program on every processor, beside C."""
    rows, bare = [], {}
    for program in programs:
        measured = set()
        for cpu, (counts, answers) in count_own(images, program).items():
            bare[program, cpu] = counts
            rows.append(table.counted_row(program, cpu, OWN, counts))
            for form, variant in HAND.items():
                elf = images / f"{program}.{variant}.{cpu}.elf"
                if elf.exists():
                    by_hand, others = count(elf, cpu, schedule_of(images, program))
                    demand_same(elf, answers, others)
                    rows.append(table.counted_row(program, cpu, form, by_hand))
                    # What was recorded was recorded for this one.
                    if cpu == "m0plus":
                        measured.add(form)
        rows += table.recorded_rows(program, measured)
    rows.append(table.size_row(*WHOLE, whole))
    print(table.text(rows))
    print()
    print(table.LEGEND)
    if {"many_steps", "sleeping_steps"} <= set(programs):
        print()
        for cpu in ("m0plus", "m4"):
            few, more = bare["many_steps", cpu], bare["sleeping_steps", cpu]
            print(
                f"A sleeping step with its transition and an action costs {(more.flash - few.flash) / 10_000:.1f} bytes"
                f" of flash and {(more.ram - few.ram) / 10_000:.2f} of RAM ({cpu})."
            )


def demand_same(elf, answers, others):
    """An image does what the graph does, in every scan of the schedule."""
    for scan, (answer, other) in enumerate(zip(answers, others, strict=True)):
        if answer != other:
            raise Missed(f"{elf.name}: scan {scan}: its outputs are {other:#b}, those of the graph {answer:#b}")


if __name__ == "__main__":
    sys.exit(main())
