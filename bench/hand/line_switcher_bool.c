#include "line_switcher.h"

static bool X1, X2, X3, X4, X5, X6, X7, X8, X9, X10, X11, unlock_before;
static uint32_t since;
bool locked;
uint32_t TD_ms, TA_ms, TF_ms;

void bench_init(void) {
    X1 = unlock_before = true;
    since = bench_now_ms;
    TD_ms = 2000, TA_ms = 1000, TF_ms = 3000;
}

void scan_once(void) {
    uint32_t in = bench_in, now = bench_now_ms, elapsed = now - since;
    bool duty = in & ONDUTY, unlock = in & UNLOCK, vl1 = in & VL1, vl2 = in & VL2, vt2 = in & VT2, vt3 = in & VT3,
         fault = in & F_B2, b1 = in & BREAKER_1, b2 = in & BREAKER_2, rise = unlock && !unlock_before;
    unlock_before = unlock;
    bool t1 = X1 && duty && !locked, t2 = X2 && !duty, t3 = X2 && duty && (!vl1 || !vt2) && vl2 && b1,
         t4 = X2 && duty && (!vl2 || !vt3) && vl1 && b2 && !(!vt2 && vl2 && b1),
         t5 = X3 && fault, t6 = X3 && !fault && ((vl1 && vt2) || !vl2),
         t7 = X3 && !fault && (!vl1 || !vt2) && vl2 && elapsed >= TD_ms,
         t8 = X5 && !b1, t9 = X5 && b1 && elapsed >= TA_ms, t10 = X7 && b2, t11 = X7 && !b2 && elapsed >= TA_ms,
         t12 = X9 && !b1 && elapsed >= TF_ms, t13 = X9 && b1 && elapsed >= TA_ms,
         t14 = X4 && fault, t15 = X4 && !fault && ((vl2 && vt3) || !vl1),
         t16 = X4 && !fault && (!vl2 || !vt3) && vl1 && elapsed >= TD_ms,
         t17 = X6 && !b2, t18 = X6 && b2 && elapsed >= TA_ms, t19 = X8 && b1, t20 = X8 && !b1 && elapsed >= TA_ms,
         t21 = X10 && !b2 && elapsed >= TF_ms, t22 = X10 && b2 && elapsed >= TA_ms,
         t23 = X11 && rise, t24 = X1 && locked;
    if (t1 || t24) X1 = false;
    if (t2 || t3 || t4) X2 = false;
    if (t5 || t6 || t7) X3 = false;
    if (t14 || t15 || t16) X4 = false;
    if (t8 || t9) X5 = false;
    if (t17 || t18) X6 = false;
    if (t10 || t11) X7 = false;
    if (t19 || t20) X8 = false;
    if (t12 || t13) X9 = false;
    if (t21 || t22) X10 = false;
    if (t23) X11 = false;
    if (t2) X1 = true;
    if (t1 || t6 || t10 || t12 || t15 || t19 || t21 || t23) X2 = true;
    if (t3) X3 = true;
    if (t4) X4 = true;
    if (t7) X5 = true;
    if (t16) X6 = true;
    if (t8) X7 = true;
    if (t17) X8 = true;
    if (t5) X9 = true;
    if (t14) X10 = true;
    if (t9 || t11 || t13 || t18 || t20 || t22 || t24) X11 = true;
    if (t1 || t2 || t3 || t4 || t5 || t6 || t7 || t8 || t9 || t10 || t11 || t12 || t13 || t14 || t15 || t16 || t17
        || t18 || t19 || t20 || t21 || t22 || t23 || t24)
        since = now;
    if (X2) locked = false;
    if (X11) locked = true;
    bench_out = X5 | X6 << 1 | X8 << 2 | X7 << 3;
}
