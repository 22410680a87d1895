/* Places as graphs/examples/drilling_station declares them. */
#include "bench.h"

enum { START = 1, STOP = 2, CLOSED = 4, UP1 = 8, DOWN1 = 16, UP2 = 32, DOWN2 = 64, BOTH_UP = UP1 | UP2 };
enum { CLAMP = 1, SPIN1 = 2, RAISE1 = 4, LOWER1 = 8, SPIN2 = 16, RAISE2 = 32, LOWER2 = 64, ALARM = 128 };
