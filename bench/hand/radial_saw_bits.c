#include "radial_saw.h"

/* One bit for each step: what is left, what is entered, then both at once. */
enum { S1 = 1, S2 = 2 };
static uint32_t X, before;

void bench_init(void) { X = S1; before = START; }

void scan_once(void) {
    uint32_t in = bench_in, rise = in & ~before, x = X, left = 0, entered = 0;
    before = in;
    if ((x & S1) && (rise & START) && !(in & STOP)) left |= S1, entered |= S2;
    if ((x & S2) && (in & STOP)) left |= S2, entered |= S1;
    X = x = (x & ~left) | entered;
    bench_out = (x & S2) != 0;
}
