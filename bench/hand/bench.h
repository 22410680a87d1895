/* The words of the contract that script/bench-image describes. */
#ifndef BENCH_H
#define BENCH_H
#include <stdbool.h>
#include <stdint.h>

extern volatile uint32_t bench_in, bench_out, bench_now_ms;
#endif
