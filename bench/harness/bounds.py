"""Holds what `grafcet bound` states to the longest scan that random inputs reach: it may not be exceeded, and may not be
more than twice as long.
"""

import argparse
import json
import subprocess
import sys
from math import inf
from pathlib import Path
from statistics import median

import table
from machine import BadImage
from processors import PROCESSORS
from schedule import PERIOD_MS, Dice

TITLES = ("program", "CPU", "longest", "bound", "times")
# How much longer a bound may be than what was reached.
SPAN = 2
# An image is scanned until one of these is reached: scans, and instructions in all of them.
SCANS, INSTRUCTIONS = 4000, 6_000_000
# The inputs that an image takes.
INPUTS = 32


def main():
    """The exit status is 1 when a bound is wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--grafcet", required=True, help="the tool that states bounds")
    parser.add_argument("--longer", action="store_true", help="bounds may be as long as they like")
    parser.add_argument("images", type=Path, help="directory of NAME.CPU.elf")
    parser.add_argument("programs", nargs="+", metavar="NAME=FILE", help="programs that images were built of")
    arguments = parser.parse_args()
    rows, wrong = [], []
    try:
        for program in arguments.programs:
            name, file = program.split("=", 1)
            bounds = ask(arguments.grafcet, "bound", "--format", "json", file)
            inputs = count_inputs(ask(arguments.grafcet, "symbols", file))
            for cpu, bound in bounds.items():
                elf = arguments.images / f"{name}.{cpu}.elf"
                if not elf.exists():
                    continue
                longest, bound = longest_scan(load(elf, cpu), inputs), bound["instructions"]
                rows.append((name, cpu, str(longest), str(bound), f"{bound / longest:.2f}"))
                fault = judge(longest, bound, inf if arguments.longer else SPAN)
                if fault:
                    wrong.append(f"{name} {cpu}: {fault}")
    except (BadImage, OSError, subprocess.CalledProcessError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(table.text(rows, TITLES, left=2))
    for cpu in sorted({row[1] for row in rows}):
        print(summary(cpu, [float(row[-1]) for row in rows if row[1] == cpu]))
    if not rows:
        wrong.append(f"no images in {arguments.images}")
    for fault in wrong:
        print(f"error: {fault}")
    return 1 if wrong else 0


def load(elf, cpu):
    """An image, built for a processor in one way or another: `m0plus`, `m0plus_flashed`."""
    return PROCESSORS[cpu.split("_")[0]](elf)


def judge(longest, bound, span=SPAN):
    """What is wrong with a bound, if anything."""
    if longest > bound:
        return f"a scan took {longest} instructions, {bound} are stated as the most"
    if bound > span * longest:
        return f"{bound} instructions are stated as the most, more than {span} times the {longest} that were reached"
    return None


def summary(cpu, times):
    """The bounds of all programs on one processor."""
    longer = sum(it > SPAN for it in times)
    return (
        f"{cpu}: {min(times):.2f} times the longest at least, {median(times):.2f} usually, {max(times):.2f} at most; "
        f"{longer} of {len(times)} more than {SPAN}"
    )


def ask(*command):
    """The JSON that a command prints."""
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def count_inputs(symbols):
    """The inputs of a program that an image takes."""
    variables = symbols["variables"].values()
    return min(INPUTS, sum(it["kind"] == "input" and it["type"] == "bool" for it in variables))


def longest_scan(machine, inputs):
    """The instructions of the longest scan behind scan 0."""
    machine.call("bench_init")
    longest = total = now_ms = 0
    for word, after_ms in stimuli(inputs):
        now_ms += after_ms
        machine.write("bench_in", word)
        machine.write("bench_now_ms", now_ms)
        count = machine.call("scan_once")
        longest, total = max(longest, count), total + count
        if total > INSTRUCTIONS:
            break
    return longest


def stimuli(inputs):
    """Inputs, with the time after which they come. In turn, for a hundred scans each: one input changes now and then;
    all are thrown anew; some change in every scan; all are True or False at once. Time leaps more or less often."""
    dice, word = Dice(), 0
    for scan in range(SCANS):
        manner = scan // 100 % 4
        if not inputs:
            pass
        elif manner == 0:
            word ^= (dice.throw(3) == 0) << dice.throw(inputs)
        elif manner == 1:
            word = thrown(dice, inputs) if dice.throw(2) else word
        elif manner == 2:
            for _ in range(1 + dice.throw(3)):
                word ^= 1 << dice.throw(inputs)
        else:
            word = (1 << inputs) - 1 if dice.throw(8) else 0
        leap = dice.throw(16 >> manner) == 0
        yield word, PERIOD_MS * (1 + dice.throw(1600)) if leap else PERIOD_MS


def thrown(dice, inputs):
    """Each of the inputs by chance."""
    return sum(dice.throw(2) << bit for bit in range(inputs))


if __name__ == "__main__":
    sys.exit(main())
