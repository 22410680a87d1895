#include "drill_press_faults.h"

enum { S2 = 1, S3 = 2, S4 = 4, S5 = 8, S6 = 16 };
static uint32_t X, before, since;

void bench_init(void) { X = S2; before = START; since = bench_now_ms; }

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since, rise = in & ~before & START;
    uint32_t x = X, left = 0, entered = 0, out = 0;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = (in | before) & STOP;
    before = in;
    if (held) {
        if (!(x & S2)) left = ~0u, entered = S2;
    } else {
        if (x & S2) {
            if (rise && (in & UP)) left |= S2, entered |= S3;
            if (elapsed >= 15000 && !(in & UP)) left |= S2, entered |= S6;
        }
        if (x & S3) {
            if (elapsed >= 2000) left |= S3, entered |= S4;
        }
        if (x & S4) {
            if (in & DOWN) left |= S4, entered |= S5;
            if (elapsed >= 15000 && !(in & DOWN)) left |= S4, entered |= S6;
        }
        if (x & S5) {
            if (in & UP) left |= S5, entered |= S2;
            if (elapsed >= 15000 && !(in & UP)) left |= S5, entered |= S6;
        }
        if (x & S6) {
            if (rise) left |= S6, entered |= S2;
        }
    }
    if (entered) { X = x = (x & ~left) | entered; since = now; elapsed = 0; }
    if (x & (S3 | S4 | S5)) out |= SPIN;
    if ((x & S5) || ((x & S2) && !(in & UP))) out |= RAISE;
    if (x & S4) out |= LOWER;
    if ((x & S6) && elapsed < 2000) out |= ALARM;
    bench_out = out;
}
