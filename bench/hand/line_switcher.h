/* Places as graphs/line_switcher.grafcet declares them. */
#include "bench.h"

enum {
    ONDUTY = 1, UNLOCK = 2, VL1 = 4, VL2 = 8, VT2 = 16, VT3 = 32, F_B2 = 64, BREAKER_1 = 128, BREAKER_2 = 256,
};
enum { BL10 = 1, BL20 = 2, BL1C = 4, BL2C = 8 };
/* A line is at work when it and its transformer have voltage. */
enum { LINE_1 = VL1 | VT2, LINE_2 = VL2 | VT3 };
