"""Writes the large program as a graph, with its schedule.

    generate.py PROGRAM.grafcet SCHEDULE.txt [SLEEPING]
"""

import sys

from large import INPUTS, sequences


def program(sleeping):
    """The text of the program."""
    lines = [f"input I{number} at %IX{number // 8}.{number % 8}" for number in range(INPUTS)]
    lines += [f"output O{number} at %QX{number // 8}.{number % 8}" for number in range(INPUTS)]
    for sequence in sequences(sleeping):
        lines += graph(sequence)
    return "\n".join(lines) + "\n"


def graph(sequence):
    """The text of a sequence."""
    yield f"graph {sequence.name} {{"
    for step in sequence.steps():
        initial = "initial " if sequence.awake and step == 1 else ""
        output = sequence.output(step)
        action = "" if output is None else f" {{ O{output} }}"
        yield f"    {initial}step {step}{action}"
    for step in sequence.steps():
        yield f"    transition {step}: {step} -> {sequence.behind(step)} when I{sequence.trigger(step)}"
    yield "}"


def schedule():
    """Ten scans in which everything fires bring every sequence round once."""
    names = " ".join(f"I{number}" for number in range(INPUTS))
    round_trip = "scan 5 fire\nexpect O0=1\nscan 5 fire\nexpect O0=0\n"
    return (
        f"in {names}\nout O0\ninit\nscan 1 first\nrest 20\nlook 6\nexpect O0=0\n"
        f"all 1\n{round_trip}{round_trip}scan 5 fire\nall 0\nrest 20\nlook 6\nexpect O0=1\nrandom 200\n"
    )


def main(program_path, schedule_path, sleeping="0"):
    """Writes both."""
    with open(program_path, "w", encoding="utf-8") as file:
        file.write(program(int(sleeping)))
    with open(schedule_path, "w", encoding="utf-8") as file:
        file.write(schedule())


if __name__ == "__main__":
    main(*sys.argv[1:])
