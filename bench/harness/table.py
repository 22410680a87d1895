"""The tables that script/bench prints."""

TITLES = ("program", "CPU", "as", "idle", "steady", "firing", "worst", "flash", "code", "RAM")

# Instructions of a steady and a firing scan on a Cortex-M0+, counted earlier with the same harness, of programs like
# these: of the drilling station and the line switcher simpler variants. -O2.
RECORDED = {
    "radial_saw": {
        "matiec": (336, 360),
        "C, Booleans": (21, 29),
        "C, bit words": (26, 27),
        "C, switch": (18, 20),
    },
    "drill_press_faults": {
        "matiec": (1155, 1171),
        "C, Booleans": (167, 170),
        "C, bit words": (98, 102),
        "C, switch": (45, 46),
    },
    "drilling_station": {
        "matiec": (2342, 2343),
        "C, Booleans": (349, 348),
        "C, bit words": (107, 152),
        "C, switch": (44, 78),
    },
    "line_switcher": {
        "matiec": (2239, 2266),
        "C, Booleans": (356, 350),
        "C, bit words": (119, 126),
        "C, switch": (51, 42),
    },
    "many_steps": {
        "matiec": (54040, 56243),
        "C, Booleans": (13475, None),
        "C, bit words": (3687, 7194),
        "C, switch": (1370, 1548),
    },
}

LEGEND = """\
Executed instructions of one scan. idle: no input is new and no timer due. steady: the same, but everything is looked at
all the same, and nothing fires. firing: a transition fires, in many_steps and its sleeping twin a hundred. `30..41` is
the usual scan and the longest. worst: the longest of the whole schedule, random inputs included.
Bytes of the bare image: flash (of it code; the rest are tables) and RAM, without the stack and the words of inputs,
outputs and time.
The C of many_steps and sleeping_steps is generated as their graphs are; all C and all processors answered alike in every
scan. The row `pico` is the image that is flashed, with its log and its retain store.
Rows marked * were not measured now, but recorded earlier with the same harness, of programs like these: matiec is in no
package registry."""


def counted_row(program, cpu, form, counts):
    """A row of counts."""
    return (
        program,
        cpu,
        form,
        str(counts.idle),
        span(counts.steady_usual, counts.steady),
        span(counts.firing_usual, counts.firing),
        str(counts.worst),
        str(counts.flash),
        str(counts.code),
        str(counts.ram),
    )


def size_row(program, cpu, whole):
    """A row of bytes alone."""
    return (program, cpu, "the whole image", "-", "-", "-", "-", str(whole.flash), "-", str(whole.ram))


def recorded_rows(program, measured):
    """The rows that were not measured now."""
    for form, counts in RECORDED.get(program, {}).items():
        if form not in measured:
            steady, firing = ("-" if count is None else str(count) for count in counts)
            yield (program, "m0plus", f"{form} *", "-", steady, firing, "-", "-", "-", "-")


def span(usual, most):
    """The usual one and the longest."""
    return str(most) if usual == most else f"{usual}..{most}"


def text(rows, titles=TITLES, left=3):
    """Columns, the first ones aligned to the left."""
    rows = [titles, *rows]
    widths = [max(len(row[column]) for row in rows) for column in range(len(titles))]
    lines = []
    for row in rows:
        cells = [
            cell.ljust(width) if column < left else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths))
        ]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)
