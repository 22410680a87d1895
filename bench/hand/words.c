#include "bench.h"

volatile uint32_t bench_in, bench_out, bench_now_ms;
