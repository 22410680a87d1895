#include "radial_saw.h"

static bool X1, X2, start_before;

void bench_init(void) { X1 = true; X2 = false; start_before = true; }

void scan_once(void) {
    uint32_t in = bench_in;
    bool start = in & START, stop = in & STOP, rise = start && !start_before;
    start_before = start;
    bool t1 = X1 && rise && !stop;
    bool t2 = X2 && stop;
    if (t1) X1 = false;
    if (t2) X2 = false;
    if (t1) X2 = true;
    if (t2) X1 = true;
    bench_out = X2;
}
