"""Writes the large program as C, in one of the three forms in which the others are written by hand.

    generate_c.py PROGRAM.c bool|bits|switch [SLEEPING]
"""

import sys

from large import INPUTS, sequences

TOP = '#include "bench.h"\n'


def booleans(all_sequences):
    """A Boolean for each step and for each transition, everything evaluated in each scan."""
    steps = [f"{sequence.name}_{step}" for sequence in all_sequences for step in sequence.steps()]
    first = [f"{sequence.name}_1" for sequence in all_sequences if sequence.awake]
    yield f"static bool {', '.join(steps)};"
    yield "void bench_init(void) {"
    yield from (f"    {step} = true;" for step in first)
    yield "}"
    yield "void scan_once(void) {"
    yield "    uint32_t in = bench_in, out = 0;"
    for sequence in all_sequences:
        name = sequence.name
        yield "    {"
        for step in sequence.steps():
            yield f"        bool t{step} = {name}_{step} && (in & 1u << {sequence.trigger(step)});"
        yield from (f"        if (t{step}) {name}_{step} = false;" for step in sequence.steps())
        yield from (f"        if (t{step}) {name}_{sequence.behind(step)} = true;" for step in sequence.steps())
        yield "    }"
    for output in range(INPUTS):
        lit_by = [
            f"{sequence.name}_{step}"
            for sequence in all_sequences
            for step in sequence.steps()
            if sequence.output(step) == output
        ]
        if lit_by:
            yield f"    if ({' || '.join(lit_by)}) out |= 1u << {output};"
    yield "    bench_out = out;"
    yield "}"


def bits(all_sequences):
    """A bit for each step, a sequence of up to 32 steps in a word of its own, longer ones in several."""
    yield "#define FROM(step) if (x & 1u << (step))"
    yield "#define TO(input, from, place, to) if (in & 1u << (input)) left |= 1u << (from), entered[place] |= 1u << (to)"
    yield from (f"static uint32_t {sequence.name}[{words(sequence)}];" for sequence in all_sequences)
    yield "void bench_init(void) {"
    yield from (f"    {sequence.name}[0] = 1;" for sequence in all_sequences if sequence.awake)
    yield "}"
    yield "void scan_once(void) {"
    yield "    uint32_t in = bench_in, out = 0;"
    for sequence in all_sequences:
        yield from bits_of(sequence)
    yield "    bench_out = out;"
    yield "}"


def words(sequence):
    """How many words of bits a sequence takes."""
    return (sequence.length + 31) // 32


def bits_of(sequence):
    """The scan of one sequence. What no word has active is not looked at."""
    name, places = sequence.name, range(words(sequence))
    yield "    {"
    yield f"        uint32_t entered[{len(places)}] = {{0}};"
    for place in places:
        here = [step for step in sequence.steps() if (step - 1) // 32 == place]
        yield "        {"
        yield f"            uint32_t x = {name}[{place}], left = 0;"
        yield "            if (x) {"
        for step in here:
            behind = sequence.behind(step) - 1
            to = f"TO({sequence.trigger(step)}, {(step - 1) % 32}, {behind // 32}, {behind % 32});"
            yield f"                FROM({(step - 1) % 32}) {to}"
        yield f"                {name}[{place}] = x & ~left;"
        yield "            }"
        yield "        }"
    for place in places:
        yield f"        uint32_t x{place} = {name}[{place}];"
        yield f"        if (entered[{place}]) {name}[{place}] = x{place} |= entered[{place}];"
        lit = {}
        for step in sequence.steps():
            output = sequence.output(step)
            if output is not None and (step - 1) // 32 == place:
                lit[output] = lit.get(output, 0) | 1 << (step - 1) % 32
        if lit:
            yield f"        if (x{place}) {{"
            yield from (f"            if (x{place} & {mask:#x}u) out |= 1u << {output};" for output, mask in lit.items())
            yield "        }"
        else:
            yield f"        (void)x{place};"
    yield "    }"


def switches(all_sequences):
    """A number for each sequence, which says its active step; 0 when none is."""
    yield from (f"static uint8_t {sequence.name};" for sequence in all_sequences)
    yield "void bench_init(void) {"
    yield from (f"    {sequence.name} = 1;" for sequence in all_sequences if sequence.awake)
    yield "}"
    yield "void scan_once(void) {"
    yield "    uint32_t in = bench_in, out = 0;"
    for sequence in all_sequences:
        name = sequence.name
        yield f"    switch ({name}) {{"
        for step in sequence.steps():
            yield f"    case {step}: if (in & 1u << {sequence.trigger(step)}) {name} = {sequence.behind(step)}; break;"
        yield "    }"
        lit = [step for step in sequence.steps() if sequence.output(step) is not None]
        if lit:
            yield f"    switch ({name}) {{"
            yield from (f"    case {step}: out |= 1u << {sequence.output(step)}; break;" for step in lit)
            yield "    }"
    yield "    bench_out = out;"
    yield "}"


FORMS = {"bool": booleans, "bits": bits, "switch": switches}


def main(path, variant, sleeping="0"):
    """Writes it."""
    with open(path, "w", encoding="utf-8") as file:
        file.write(TOP + "\n".join(FORMS[variant](sequences(int(sleeping)))) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
