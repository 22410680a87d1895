#include "drilling_station.h"

typedef struct { bool X3, X4, X5, X6, X7; uint32_t since; } drill;
static drill d1, d2;
static bool X1, X2, X20, clamp, start_before, stop_before;
static uint32_t since;
uint32_t spin_up1_ms, spin_up2_ms;

void bench_init(void) {
    X1 = start_before = true;
    since = bench_now_ms;
    spin_up1_ms = spin_up2_ms = 2000;
}

static void stop_drill(drill *d) { d->X3 = d->X4 = d->X5 = d->X6 = d->X7 = false; }

/* Bits 0 to 2: SPIN, RAISE, LOWER; bit 7: ALARM. */
static inline uint32_t drill_scan(drill *d, bool held, bool go, bool join, bool up, bool down, bool rise,
                                  uint32_t spin_up, uint32_t now) {
    uint32_t elapsed = now - d->since;
    if (held) {
        stop_drill(d);
    } else {
        bool late = elapsed >= 15000;
        bool t3 = d->X3 && elapsed >= spin_up, t4 = d->X4 && down, t5 = d->X5 && up, t7 = d->X4 && late && !down,
             t8 = d->X5 && late && !up, t9 = d->X6 && rise;
        if (t3) d->X3 = false;
        if (t4 || t7) d->X4 = false;
        if (t5 || t8) d->X5 = false;
        if (t9) d->X6 = false;
        if (join) d->X7 = false;
        if (go) d->X3 = true;
        if (t3) d->X4 = true;
        if (t4) d->X5 = true;
        if (t7 || t8) d->X6 = true;
        if (t5 || t9) d->X7 = true;
        if (go || t3 || t4 || t5 || t7 || t8 || t9) { d->since = now; elapsed = 0; }
    }
    return (d->X3 || d->X4 || d->X5) | d->X5 << 1 | d->X4 << 2 | (d->X6 && elapsed < 2000) << 7;
}

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since;
    bool start = in & START, stop = in & STOP, up1 = in & UP1, up2 = in & UP2, rise = start && !start_before;
    start_before = start;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = stop || stop_before;
    stop_before = stop;
    bool go = false, join = false;
    if (held) {
        if (!X1) { X1 = true; since = now; }
        X2 = X20 = false;
    } else {
        bool t1 = X1 && rise && up1 && up2, t11 = X1 && elapsed >= 15000 && !(up1 && up2), t12 = X20 && rise;
        go = X2 && (in & CLOSED);
        join = d1.X7 && d2.X7;
        if (t1 || t11) X1 = false;
        if (go) X2 = false;
        if (t12) X20 = false;
        if (t12 || join) X1 = true;
        if (t1) X2 = true;
        if (t11) X20 = true;
        if (t1 || t11 || t12 || join) { since = now; elapsed = 0; }
    }
    uint32_t one = drill_scan(&d1, held, go, join, up1, in & DOWN1, rise, spin_up1_ms, now);
    uint32_t two = drill_scan(&d2, held, go, join, up2, in & DOWN2, rise, spin_up2_ms, now);
    if (X1 && up1 && up2) clamp = false;
    if (X2) clamp = true;
    bool alarm = X20 && elapsed < 2000;
    bench_out = clamp | (one & 7) << 1 | (two & 7) << 4 | ((one | two) & ALARM) | alarm << 7
        | (X1 && !up1) << 2 | (X1 && !up2) << 5;
}
