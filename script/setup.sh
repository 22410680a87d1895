# Sourced by the other scripts: sets up what is missing, once, and says so.
# Everything comes from the package registries, by name; nothing is left outside the checkout but the Rust target.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

TARGET=thumbv6m-none-eabi
DEFMT_PRINT_VERSION=1.2.0
ELF2UF2_VERSION=2.2.0
# Cargo's own variable moves the build directory for everybody alike.
BUILD_DIR="${CARGO_TARGET_DIR:-target}"

say() { printf '%s\n' "── $*" >&2; }

need() {
    command -v "$1" >/dev/null 2>&1 && return
    printf 'error: %s is not installed\nhelp: %s\n' "$1" "$2" >&2
    exit 2
}

setup_host() {
    need cargo 'install Rust from https://rustup.rs'
}

# Of the Pico, or another one.
setup_target() {
    local target=${1:-$TARGET}
    setup_host
    need rustup 'install Rust from https://rustup.rs, which brings rustup'
    if ! rustup target list --installed | grep -qx "$target"; then
        say "adding the Rust target $target"
        rustup target add "$target"
    fi
}

# The emulated Pico: its packages, and the decoder of the image's log lines.
setup_emulator() {
    setup_target
    need node 'install Node.js 20 or newer'
    need npm 'install Node.js 20 or newer, which brings npm'
    if ! cmp -s emulator/package-lock.json emulator/node_modules/.installed-lock; then
        say "installing the emulator's packages"
        npm --prefix emulator ci --no-audit --no-fund --loglevel=error
        cp emulator/package-lock.json emulator/node_modules/.installed-lock
    fi
    if ! .tools/bin/defmt-print --version 2>/dev/null | grep -qF "$DEFMT_PRINT_VERSION"; then
        say "building defmt-print $DEFMT_PRINT_VERSION (once, about a minute)"
        CARGO_TARGET_DIR="$BUILD_DIR/tools" cargo install --quiet --locked --root .tools \
            defmt-print --version "$DEFMT_PRINT_VERSION"
    fi
}

# What counts instructions: $PYTHON has an emulated processor.
setup_counter() {
    need python3 'install Python 3.10 or newer (Debian: apt install python3 python3-venv)'
    PYTHON=.tools/counter/bin/python
    cmp -s bench/requirements.txt .tools/counter/.installed-requirements && return
    say 'installing the emulated processor (unicorn) into .tools/counter'
    if ! python3 -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))' 2>/dev/null; then
        printf 'error: python3 is older than 3.10, or has no venv\nhelp: %s\n' \
            'install Python 3.10 or newer with its venv (Debian: apt install python3-venv)' >&2
        exit 2
    fi
    python3 -m venv --clear .tools/counter
    "$PYTHON" -m pip install --quiet --disable-pip-version-check --requirement bench/requirements.txt
    cp bench/requirements.txt .tools/counter/.installed-requirements
}

# What makes of the image a file for the Pico's drive; without its serial monitor, which wants a system library.
setup_uf2() {
    setup_host
    if ! cargo install --list --root .tools 2>/dev/null | grep -qxF "elf2uf2-rs v$ELF2UF2_VERSION:"; then
        say "building elf2uf2-rs $ELF2UF2_VERSION (once, about a minute)"
        CARGO_TARGET_DIR="$BUILD_DIR/tools" cargo install --quiet --locked --root .tools --no-default-features \
            elf2uf2-rs --version "$ELF2UF2_VERSION"
    fi
}

# Builds the image; prints nothing but progress. The ELF is $IMAGE. Arguments go to cargo.
build_image() {
    setup_target
    say "building the image for the Pico${PLC:+ from $PLC}"
    # The same sources give the same bytes on every machine: no path of this one in the places of panics.
    local registry="${CARGO_HOME:-$HOME/.cargo}/registry/src"
    cargo build --locked --release --target "$TARGET" --package plc --bin plc \
        --config "target.$TARGET.rustflags=[\"--remap-path-prefix=$registry=registry\"]" "$@"
    IMAGE="$BUILD_DIR/$TARGET/release/plc"
}

# build_bench_image PROGRAM CPU OUT: the program and the engine, bare, for counting instructions. Paths are absolute.
build_bench_image() {
    local program=$1 cpu=$2 out=$3 target=$TARGET log
    # Floating point in registers would be of no use: there is none in the engine.
    case $cpu in
        m4) target=thumbv7em-none-eabi ;;
        x86) target=x86_64-unknown-none ;;
    esac
    setup_target "$target"
    log=$(mktemp)
    # Nobody moves an image to where it is run, as is usual on x86.
    if ! BENCH_PROGRAM=$program cargo build --locked --quiet --profile bench-image --target "$target" \
        --config 'target.x86_64-unknown-none.rustflags=["-Crelocation-model=static"]' \
        --package bench-image 2>"$log"; then
        # Of a wrong program only what the compiler says of it, which cargo indents.
        if grep -q '^ *--- stderr' "$log"; then
            sed '1,/^ *--- stderr/d; s/^  //' "$log" >&2
        else
            cat "$log" >&2
        fi
        rm "$log"
        return 1
    fi
    rm "$log"
    cp "$BUILD_DIR/$target/bench-image/bench-image" "$out"
}

# Builds the images of the applications that tests use, each as $IMAGES/NAME: those of tests/emulated/applications, the
# random ones, which a test of the reference writes to $RANDOM_PROGRAMS, the drilling station, and the mixing tank, whose soft
# PLC lies beside the switcher's. The tasks of `tolerant` hang when a test tells them to.
build_test_images() {
    IMAGES="$BUILD_DIR/test-images"
    RANDOM_PROGRAMS="$BUILD_DIR/tmp/applications"
    mkdir -p "$IMAGES"
    cargo test --locked --quiet --package grafcet-reference --test differential board::
    local wiring name features
    local station=graphs/examples/drilling_station/plc.toml tank=graphs/examples/mixing_tank/plc.toml
    for wiring in tests/emulated/applications/*/plc.toml "$RANDOM_PROGRAMS"/*/plc.toml "$station" "$tank"; do
        # Quietly: what a program that has to show everything is warned of is no news.
        name=$(basename "$(dirname "$wiring")")
        features=()
        if [ "$name" = tolerant ]; then features=(--features hang); fi
        PLC=$wiring build_image --quiet "${features[@]}"
        cp "$IMAGE" "$IMAGES/$name"
    done
    PLC=$tank cargo build --locked --quiet --package plc
    cp "$BUILD_DIR/debug/plc" "$BUILD_DIR/debug/plc-mixing_tank"
    # The last one stays where the other scripts look for it.
    cargo build --locked --quiet --package plc
}
