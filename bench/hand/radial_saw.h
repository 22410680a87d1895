/* Places as graphs/examples/radial_saw declares them. */
#include "bench.h"

enum { START = 1, STOP = 2 };
