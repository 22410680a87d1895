#include "drilling_station.h"

enum {
    S1 = 1, S2 = 2, S20 = 4, S3 = 1 << 3, S4 = 1 << 4, S5 = 1 << 5, S6 = 1 << 6, S7 = 1 << 7,
    S13 = 1 << 8, S14 = 1 << 9, S15 = 1 << 10, S16 = 1 << 11, S17 = 1 << 12,
};
static uint32_t X, before, since, since1, since2;
static bool clamp;
uint32_t spin_up1_ms, spin_up2_ms;

void bench_init(void) {
    X = S1;
    before = START;
    since = bench_now_ms;
    spin_up1_ms = spin_up2_ms = 2000;
}

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, rise = in & ~before & START;
    uint32_t x = X, left = 0, entered = 0, out = 0;
    uint32_t elapsed1 = now - since1, elapsed2 = now - since2;
    bool both_up = (in & BOTH_UP) == BOTH_UP;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = (in | before) & STOP;
    before = in;
    if (held) {
        left = ~(uint32_t)S1;
        if (!(x & S1)) entered = S1;
    } else {
        if (x & S1) {
            if (rise && both_up) left |= S1, entered |= S2;
            if (!both_up && now - since >= 15000) left |= S1, entered |= S20;
        }
        if (x & S20) {
            if (rise) left |= S20, entered |= S1;
        }
        if (x & S2) {
            if (in & CLOSED) left |= S2, entered |= S3 | S13;
        }
        if (x & (S3 | S4 | S5 | S6)) {
            if (x & S3) { if (elapsed1 >= spin_up1_ms) left |= S3, entered |= S4; }
            if (x & S4) { if (in & DOWN1) left |= S4, entered |= S5; else if (elapsed1 >= 15000) left |= S4, entered |= S6; }
            if (x & S5) { if (in & UP1) left |= S5, entered |= S7; else if (elapsed1 >= 15000) left |= S5, entered |= S6; }
            if (x & S6) { if (rise) left |= S6, entered |= S7; }
        }
        if (x & (S13 | S14 | S15 | S16)) {
            if (x & S13) { if (elapsed2 >= spin_up2_ms) left |= S13, entered |= S14; }
            if (x & S14) { if (in & DOWN2) left |= S14, entered |= S15; else if (elapsed2 >= 15000) left |= S14, entered |= S16; }
            if (x & S15) { if (in & UP2) left |= S15, entered |= S17; else if (elapsed2 >= 15000) left |= S15, entered |= S16; }
            if (x & S16) { if (rise) left |= S16, entered |= S17; }
        }
        if ((x & (S7 | S17)) == (S7 | S17)) left |= S7 | S17, entered |= S1;
    }
    if (entered) {
        X = x = (x & ~left) | entered;
        if (entered & (S1 | S20)) since = now;
        if (entered & (S3 | S4 | S5 | S6)) since1 = now, elapsed1 = 0;
        if (entered & (S13 | S14 | S15 | S16)) since2 = now, elapsed2 = 0;
        if (x & S2) clamp = true;
    }
    if (x & S1) {
        if (both_up) clamp = false;
        if (!(in & UP1)) out |= RAISE1;
        if (!(in & UP2)) out |= RAISE2;
    }
    if (x & (S3 | S4 | S5)) out |= SPIN1;
    if (x & S4) out |= LOWER1;
    if (x & S5) out |= RAISE1;
    if (x & (S13 | S14 | S15)) out |= SPIN2;
    if (x & S14) out |= LOWER2;
    if (x & S15) out |= RAISE2;
    if ((x & S6) && elapsed1 < 2000) out |= ALARM;
    if ((x & S16) && elapsed2 < 2000) out |= ALARM;
    if ((x & S20) && now - since < 2000) out |= ALARM;
    if (clamp) out |= CLAMP;
    bench_out = out;
}
