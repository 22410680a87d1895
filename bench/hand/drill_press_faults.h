/* Places as graphs/examples/drill_press_faults declares them. */
#include "bench.h"

enum { START = 1, STOP = 2, UP = 4, DOWN = 8 };
enum { SPIN = 1, RAISE = 2, LOWER = 4, ALARM = 8 };
