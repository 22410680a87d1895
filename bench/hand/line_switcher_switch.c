#include "line_switcher.h"

static uint32_t before, since;
static uint8_t step;
bool locked;
uint32_t TD_ms, TA_ms, TF_ms;

void bench_init(void) {
    step = 1;
    before = UNLOCK;
    since = bench_now_ms;
    TD_ms = 2000, TA_ms = 1000, TF_ms = 3000;
}

#define LINE_1_LOST ((in & LINE_1) != LINE_1)
#define LINE_2_LOST ((in & LINE_2) != LINE_2)

void scan_once(void) {
    static const uint8_t outputs[12] = {[5] = BL10, [6] = BL20, [7] = BL2C, [8] = BL1C};
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since, next = step, rise = in & ~before & UNLOCK;
    before = in;
    switch (next) {
    case 1: if (locked) next = 11; else if (in & ONDUTY) next = 2; break;
    case 2:
        if (!(in & ONDUTY)) next = 1;
        else if (LINE_1_LOST && (in & VL2) && (in & BREAKER_1)) next = 3;
        else if (LINE_2_LOST && (in & VL1) && (in & BREAKER_2)) next = 4;
        break;
    case 3:
        if (in & F_B2) next = 9;
        else if (!LINE_1_LOST || !(in & VL2)) next = 2;
        else if (elapsed >= TD_ms) next = 5;
        break;
    case 4:
        if (in & F_B2) next = 10;
        else if (!LINE_2_LOST || !(in & VL1)) next = 2;
        else if (elapsed >= TD_ms) next = 6;
        break;
    case 5: if (!(in & BREAKER_1)) next = 7; else if (elapsed >= TA_ms) next = 11; break;
    case 6: if (!(in & BREAKER_2)) next = 8; else if (elapsed >= TA_ms) next = 11; break;
    case 7: if (in & BREAKER_2) next = 2; else if (elapsed >= TA_ms) next = 11; break;
    case 8: if (in & BREAKER_1) next = 2; else if (elapsed >= TA_ms) next = 11; break;
    case 9: if (elapsed >= (in & BREAKER_1 ? TA_ms : TF_ms)) next = in & BREAKER_1 ? 11 : 2; break;
    case 10: if (elapsed >= (in & BREAKER_2 ? TA_ms : TF_ms)) next = in & BREAKER_2 ? 11 : 2; break;
    case 11: if (rise) next = 2; break;
    }
    if (next != step) {
        step = next;
        since = now;
        if (next == 2) locked = false;
        if (next == 11) locked = true;
    }
    bench_out = outputs[next];
}
