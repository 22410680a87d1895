#include "radial_saw.h"

static uint32_t before;
static uint8_t step;

void bench_init(void) { step = 1; before = START; }

void scan_once(void) {
    uint32_t in = bench_in, rise = in & ~before;
    before = in;
    switch (step) {
    case 1: if ((rise & START) && !(in & STOP)) step = 2; break;
    case 2: if (in & STOP) step = 1; break;
    }
    bench_out = step == 2;
}
