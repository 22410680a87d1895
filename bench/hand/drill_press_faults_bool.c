#include "drill_press_faults.h"

static bool X2, X3, X4, X5, X6, start_before, stop_before;
static uint32_t since;

void bench_init(void) {
    X2 = true;
    X3 = X4 = X5 = X6 = false;
    start_before = true;
    since = bench_now_ms;
}

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since;
    bool start = in & START, stop = in & STOP, up = in & UP, down = in & DOWN, rise = start && !start_before;
    start_before = start;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = stop || stop_before;
    stop_before = stop;
    if (held) {
        if (!X2) { X3 = X4 = X5 = X6 = false; X2 = true; since = now; elapsed = 0; }
    } else {
        bool late = elapsed >= 15000;
        bool t2 = X2 && rise && up, t3 = X3 && elapsed >= 2000, t4 = X4 && down, t5 = X5 && up,
             t6 = X2 && late && !up, t7 = X4 && late && !down, t8 = X5 && late && !up, t9 = X6 && rise;
        if (t2 || t6) X2 = false;
        if (t3) X3 = false;
        if (t4 || t7) X4 = false;
        if (t5 || t8) X5 = false;
        if (t9) X6 = false;
        if (t5 || t9) X2 = true;
        if (t2) X3 = true;
        if (t3) X4 = true;
        if (t4) X5 = true;
        if (t6 || t7 || t8) X6 = true;
        if (t2 || t3 || t4 || t5 || t6 || t7 || t8 || t9) { since = now; elapsed = 0; }
    }
    bench_out = (X3 || X4 || X5) | ((X2 && !up) || X5) << 1 | X4 << 2 | (X6 && elapsed < 2000) << 3;
}
