"""What was counted of one image, and the checked-in counts that it is held to."""

from dataclasses import asdict, dataclass
from statistics import median_low

from processors import PROCESSORS
from schedule import Run

# How much a count may grow unnoticed.
TOLERANCE = 0.05

HEADER = """\
# What script/bench --update counted: for each program and processor the executed instructions of a scan and the bytes
# of the bare image; and the bytes of the whole image that is flashed. script/bench --check fails when one has grown by
# more than 5 %.
"""


@dataclass(frozen=True)
class Counts:
    """Executed instructions by the kind of scan, the most that one of them took unless the name says `usual`, which is
    the median; and bytes."""

    idle: int
    steady_usual: int
    steady: int
    firing_usual: int
    firing: int
    worst: int
    code: int
    flash: int
    ram: int


def count(elf, cpu, schedule):
    """Plays a schedule to an image. The answer: its counts, and what it had at its outputs after each scan."""
    machine = PROCESSORS[cpu](elf)
    run = Run(machine, schedule)
    steady, firing = run.counts["steady"], run.counts["fire"]
    counts = Counts(
        idle=max(run.counts["idle"]),
        steady_usual=median_low(steady),
        steady=max(steady),
        firing_usual=median_low(firing),
        firing=max(firing),
        worst=max(max(counts) for counts in run.counts.values()),
        code=machine.code,
        flash=machine.flash,
        ram=machine.ram,
    )
    return counts, run.answers


def to_text(counted):
    """The checked-in form: a line for each count, in a fixed order. `counted` maps program and processor to Counts,
    or to the size of a whole image."""
    lines = [
        f"{program} {cpu} {name} {value}\n"
        for (program, cpu), counts in sorted(counted.items())
        for name, value in asdict(counts).items()
    ]
    return HEADER + "".join(lines)


def from_text(text):
    """The values of the checked-in form, by program, processor and name."""
    lines = (line.split() for line in text.splitlines() if line and not line.startswith("#"))
    return {(program, cpu, name): int(value) for program, cpu, name, value in lines}


def compare(text, counted):
    """Compares with the checked-in counts. The answer: what is wrong, and what has shrunk as much."""
    kept = from_text(text)
    now = from_text(to_text(counted))
    wrong = [f"{' '.join(key)}: not in the counts file" for key in now if key not in kept]
    wrong += [f"{' '.join(key)}: in the counts file, and not counted" for key in kept if key not in now]
    shrunk = []
    for key in now.keys() & kept.keys():
        before, after = kept[key], now[key]
        change = f"{' '.join(key)}: {before} -> {after}"
        if after > before * (1 + TOLERANCE):
            wrong.append(change)
        elif after < before * (1 - TOLERANCE):
            shrunk.append(change)
    return sorted(wrong), sorted(shrunk)
