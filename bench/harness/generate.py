"""Writes the large program: a hundred sequences of ten steps, a hundred of its thousand steps active.

    generate.py PROGRAM.grafcet SCHEDULE.txt [SLEEPING]

Every sequence goes round, and each of its transitions waits for one of 31 inputs; with all of them True a hundred
transitions fire in every scan. SLEEPING steps more, with a transition and an action each, stand in graphs of a hundred
steps of which none is ever active.
"""

import sys

SEQUENCES, STEPS, INPUTS = 100, 10, 31
SLEEPERS = 100


def program(sleeping):
    """The text of the program."""
    lines = [f"input I{number} at %IX{number // 8}.{number % 8}" for number in range(INPUTS)]
    lines += [f"output O{number} at %QX{number // 8}.{number % 8}" for number in range(INPUTS)]
    for graph in range(SEQUENCES):
        lines += sequence(f"G{graph}", STEPS, graph, awake=True)
    for graph in range(sleeping // SLEEPERS):
        lines += sequence(f"Sleeping{graph}", SLEEPERS, graph, awake=False)
    return "\n".join(lines) + "\n"


def sequence(name, steps, shift, awake):
    """A graph that goes round."""
    yield f"graph {name} {{"
    for step in range(1, steps + 1):
        if awake and step == 1:
            yield "    initial step 1"
        elif awake and shift:
            yield f"    step {step}"
        else:
            output = 0 if awake else 1 + (shift + step) % (INPUTS - 1)
            yield f"    step {step} {{ O{output} }}"
    for step in range(1, steps + 1):
        trigger = (7 * shift + step) % INPUTS
        yield f"    transition {step}: {step} -> {step % steps + 1} when I{trigger}"
    yield "}"


def schedule():
    """Ten scans in which everything fires bring every sequence round once."""
    names = " ".join(f"I{number}" for number in range(INPUTS))
    round_trip = "scan 9 fire\nexpect O0=1\nscan 1 fire\nexpect O0=0\n"
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
