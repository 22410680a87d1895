//! libFuzzer over one target, which the environment names: `script/fuzz` builds and runs this.

#![no_main]

use std::sync::LazyLock;

use grafcet_fuzz::target::Target;
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("FUZZ_TARGET").unwrap_or_default();
    Target::named(&name).unwrap_or_else(|| panic!("FUZZ_TARGET names no target: `{name}`"))
});

static SEEDS: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| TARGET.seeds());

fuzz_target!(|input: &[u8]| TARGET.run(input));

// Mostly whole words are changed, so that much of what comes is nearly a program; now and then single bytes are.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut random = fastrand::Rng::with_seed(u64::from(seed));
    if random.u8(0..4) == 0 {
        return fuzzer_mutate(data, size, max_size);
    }
    let other = random.choice(&*SEEDS).map_or(&[][..], Vec::as_slice);
    let mutated = TARGET.mutated(&data[..size], other, &mut random);
    let size = mutated.len().min(max_size);
    data[..size].copy_from_slice(&mutated[..size]);
    size
});
