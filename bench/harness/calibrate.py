"""Proposes what the kinds of work in `grafcet/src/bound/work.rs` cost, from the longest scans of many programs: so that
every bound is MARGIN times what was reached or more, as few as possible are more than twice that, and no cost is far from
what it is now. Needs scipy (`pip install scipy`), which counting does not.

    calibrate.py --grafcet TOOL IMAGES NAME=FILE ...
"""

import argparse
import re
from pathlib import Path

import numpy
from scipy.optimize import linprog

from bounds import ask, count_inputs, load, longest_scan

WORK = Path(__file__).resolve().parents[2] / "grafcet" / "src" / "bound" / "work.rs"
MARGIN = 1.2
# From this on a bound is thought to be long, and weighs the more.
LONG, WEIGHT = 1.9, 20
# From this on it is long by its structure, whatever the costs, and weighs nothing.
HOPELESS = 2.2
# What it weighs when a cost moves by as much as it is.
INERTIA = 0.5


def main():
    """Prints a line for each kind, as it stands in the source."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--grafcet", required=True)
    parser.add_argument("images", type=Path)
    parser.add_argument("programs", nargs="+", metavar="NAME=FILE")
    arguments = parser.parse_args()
    text = WORK.read_text(encoding="utf-8")
    cpus = re.findall(r"Cpu::\w+ => \"([a-z0-9_]+)\"", text)
    kinds = [line.split() for line in re.findall(r"^    (\w+(?: \d+){%d})$" % len(cpus), text, re.MULTILINE)]
    programs = [program.split("=", 1) for program in arguments.programs]
    bounds = [ask(arguments.grafcet, "bound", "--format", "json", file) for _, file in programs]
    costs = []
    for place, cpu in enumerate(cpus):
        longest = []
        for name, file in programs:
            inputs = count_inputs(ask(arguments.grafcet, "symbols", file))
            longest.append(longest_scan(load(arguments.images / f"{name}.{cpu}.elf", cpu), inputs))
        work = [[bound[cpu]["work"].get(kind[0], 0) for kind in kinds] for bound in bounds]
        costs.append(fit(numpy.array(work), numpy.array(longest), [int(kind[1 + place]) / 10 for kind in kinds]))
    for kind, *cost in zip(kinds, *costs):
        print("   ", kind[0], *(int(numpy.ceil(10 * value)) for value in cost))


def fit(work, longest, now):
    """Costs that make a linear programme's optimum: variables are the costs, how far each moves, and by how much each
    bound is long."""
    now = numpy.array(now)
    times = work / longest[:, None]
    weighs = (times @ now <= HOPELESS).astype(float)
    programs, kinds = times.shape
    none, one = numpy.zeros, numpy.eye
    relative = numpy.diag(1 / now)
    limits = [
        (numpy.hstack([-times, none((programs, kinds)), none((programs, programs))]), numpy.full(programs, -MARGIN)),
        (numpy.hstack([relative, -one(kinds), none((kinds, programs))]), numpy.ones(kinds)),
        (numpy.hstack([-relative, -one(kinds), none((kinds, programs))]), -numpy.ones(kinds)),
        (numpy.hstack([times, none((programs, kinds)), -one(programs)]), numpy.full(programs, LONG)),
    ]
    weights = numpy.concatenate([weighs @ times, numpy.full(kinds, INERTIA), WEIGHT * weighs])
    found = linprog(
        weights,
        A_ub=numpy.vstack([matrix for matrix, _ in limits]),
        b_ub=numpy.concatenate([limit for _, limit in limits]),
        bounds=[(cost / 2, cost * 5) for cost in now] + [(0, None)] * (kinds + programs),
    )
    if not found.success:
        raise SystemExit(found.message)
    return found.x[:kinds]


if __name__ == "__main__":
    main()
