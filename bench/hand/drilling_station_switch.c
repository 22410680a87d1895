#include "drilling_station.h"

/* Step 0: the drill is not at work. */
typedef struct { uint8_t step; uint32_t since; } drill;
static drill d1, d2;
static uint8_t step;
static bool clamp;
static uint32_t before, since;
uint32_t spin_up1_ms, spin_up2_ms;

/* While the drills are at work. */
enum { DRILLING = 3 };

void bench_init(void) {
    step = 1;
    before = START;
    since = bench_now_ms;
    spin_up1_ms = spin_up2_ms = 2000;
}

/* `in` has up in bit 0 and down in bit 1. The answer: bits 0 to 2 SPIN, RAISE, LOWER; bit 7 ALARM. */
static uint32_t drill_scan(drill *d, uint32_t in, uint32_t rise, uint32_t spin_up, uint32_t now) {
    uint8_t next = d->step;
    uint32_t elapsed = now - d->since;
    switch (next) {
    case 3: if (elapsed >= spin_up) next = 4; break;
    case 4: if (in & 2) next = 5; else if (elapsed >= 15000) next = 6; break;
    case 5: if (in & 1) next = 7; else if (elapsed >= 15000) next = 6; break;
    case 6: if (rise) next = 7; break;
    }
    if (next != d->step) { d->step = next; d->since = now; elapsed = 0; }
    switch (next) {
    case 3: return 1;
    case 4: return 1 | 4;
    case 5: return 1 | 2;
    case 6: return elapsed < 2000 ? ALARM : 0;
    }
    return 0;
}

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, out = 0, rise = in & ~before & START;
    bool both_up = (in & BOTH_UP) == BOTH_UP, started = false;
    uint8_t next = step;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = (in | before) & STOP;
    before = in;
    if (held) next = 1;
    else switch (next) {
    case 1: if (both_up) { if (rise) next = 2; } else if (now - since >= 15000) next = 20; break;
    case 2: if (in & CLOSED) { next = DRILLING; started = true; } break;
    case DRILLING: if (d1.step == 7 && d2.step == 7) next = 1; break;
    case 20: if (rise) next = 1; break;
    }
    if (next != step) { step = next; since = now; }
    switch (next) {
    case 1:
        if (both_up) clamp = false;
        out = (in & UP1 ? 0 : RAISE1) | (in & UP2 ? 0 : RAISE2);
        break;
    case 2: clamp = true; break;
    case DRILLING: {
        if (started) { d1.step = d2.step = 3; d1.since = d2.since = now; out = SPIN1 | SPIN2; break; }
        uint32_t one = drill_scan(&d1, in >> 3, rise, spin_up1_ms, now);
        uint32_t two = drill_scan(&d2, in >> 5, rise, spin_up2_ms, now);
        out = (one & 7) << 1 | (two & 7) << 4 | ((one | two) & ALARM);
        break;
    }
    case 20: if (now - since < 2000) out = ALARM; break;
    }
    bench_out = out | clamp;
}
