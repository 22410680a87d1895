#include "drill_press_faults.h"

static uint32_t before, since;
static uint8_t step;

void bench_init(void) { step = 2; before = START; since = bench_now_ms; }

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since, next = step, out = 0;
    uint32_t rise = in & ~before & START;
    /* A graph is free again in the scan behind the one in which the order to hold it ends. */
    bool held = (in | before) & STOP;
    before = in;
    if (held) next = 2;
    else switch (next) {
    case 2: if (in & UP) { if (rise) next = 3; } else if (elapsed >= 15000) next = 6; break;
    case 3: if (elapsed >= 2000) next = 4; break;
    case 4: if (in & DOWN) next = 5; else if (elapsed >= 15000) next = 6; break;
    case 5: if (in & UP) next = 2; else if (elapsed >= 15000) next = 6; break;
    case 6: if (rise) next = 2; break;
    }
    if (next != step) { step = next; since = now; elapsed = 0; }
    switch (next) {
    case 2: if (!(in & UP)) out = RAISE; break;
    case 3: out = SPIN; break;
    case 4: out = SPIN | LOWER; break;
    case 5: out = SPIN | RAISE; break;
    case 6: if (elapsed < 2000) out = ALARM; break;
    }
    bench_out = out;
}
