#include "line_switcher.h"

enum {
    S1 = 1 << 1, S2 = 1 << 2, S3 = 1 << 3, S4 = 1 << 4, S5 = 1 << 5, S6 = 1 << 6, S7 = 1 << 7, S8 = 1 << 8,
    S9 = 1 << 9, S10 = 1 << 10, S11 = 1 << 11,
};
static uint32_t X, before, since;
bool locked;
uint32_t TD_ms, TA_ms, TF_ms;

void bench_init(void) {
    X = S1;
    before = UNLOCK;
    since = bench_now_ms;
    TD_ms = 2000, TA_ms = 1000, TF_ms = 3000;
}

#define FROM(step) if (x & (step))
#define TO(condition, from, to) if (condition) left |= from, entered |= to

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since, rise = in & ~before & UNLOCK;
    uint32_t x = X, left = 0, entered = 0, out = 0;
    bool fault = in & F_B2, line_1 = (in & LINE_1) == LINE_1, line_2 = (in & LINE_2) == LINE_2;
    before = in;
    FROM(S1) { TO((in & ONDUTY) && !locked, S1, S2); TO(locked, S1, S11); }
    FROM(S2) {
        TO(!(in & ONDUTY), S2, S1);
        TO((in & ONDUTY) && !line_1 && (in & VL2) && (in & BREAKER_1), S2, S3);
        TO((in & ONDUTY) && !line_2 && (in & VL1) && (in & BREAKER_2)
           && (in & (VT2 | VL2 | BREAKER_1)) != (VL2 | BREAKER_1), S2, S4);
    }
    FROM(S3) {
        TO(fault, S3, S9);
        TO(!fault && (line_1 || !(in & VL2)), S3, S2);
        TO(!fault && !line_1 && (in & VL2) && elapsed >= TD_ms, S3, S5);
    }
    FROM(S4) {
        TO(fault, S4, S10);
        TO(!fault && (line_2 || !(in & VL1)), S4, S2);
        TO(!fault && !line_2 && (in & VL1) && elapsed >= TD_ms, S4, S6);
    }
    FROM(S5) { TO(!(in & BREAKER_1), S5, S7); TO((in & BREAKER_1) && elapsed >= TA_ms, S5, S11); }
    FROM(S6) { TO(!(in & BREAKER_2), S6, S8); TO((in & BREAKER_2) && elapsed >= TA_ms, S6, S11); }
    FROM(S7) { TO(in & BREAKER_2, S7, S2); TO(!(in & BREAKER_2) && elapsed >= TA_ms, S7, S11); }
    FROM(S8) { TO(in & BREAKER_1, S8, S2); TO(!(in & BREAKER_1) && elapsed >= TA_ms, S8, S11); }
    FROM(S9) { TO(!(in & BREAKER_1) && elapsed >= TF_ms, S9, S2); TO((in & BREAKER_1) && elapsed >= TA_ms, S9, S11); }
    FROM(S10) { TO(!(in & BREAKER_2) && elapsed >= TF_ms, S10, S2); TO((in & BREAKER_2) && elapsed >= TA_ms, S10, S11); }
    FROM(S11) { TO(rise, S11, S2); }
    if (entered) {
        X = x = (x & ~left) | entered;
        since = now;
        if (x & S2) locked = false;
        if (x & S11) locked = true;
    }
    if (x & S5) out |= BL10;
    if (x & S6) out |= BL20;
    if (x & S8) out |= BL1C;
    if (x & S7) out |= BL2C;
    bench_out = out;
}
