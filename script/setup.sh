# Sourced by the other scripts: sets up what is missing, once, and says so.
# Everything comes from the package registries, by name; nothing is left outside the checkout but the Rust target.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

TARGET=thumbv6m-none-eabi
DEFMT_PRINT_VERSION=1.2.0
ELF2UF2_VERSION=2.2.0
# Cargo's own variable moves the build directory for everybody alike.
BUILD_DIR="${CARGO_TARGET_DIR:-target}"
# The image that was built last; those that are kept for tests, by name; and the random programs of some of them.
IMAGE="$BUILD_DIR/$TARGET/release/plc"
IMAGES="$BUILD_DIR/test-images"
RANDOM_PROGRAMS="$BUILD_DIR/random-programs"

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

# install_tool PACKAGE VERSION [CARGO-ARGUMENT...]: into .tools. Not optimised: building takes longer than it ever runs.
install_tool() {
    say "building $1 $2 (once, about a minute)"
    CARGO_TARGET_DIR="$BUILD_DIR/tools" CARGO_PROFILE_RELEASE_OPT_LEVEL=0 \
        cargo install --quiet --locked --root .tools "$1" --version "$2" "${@:3}"
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
        install_tool defmt-print "$DEFMT_PRINT_VERSION"
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
        install_tool elf2uf2-rs "$ELF2UF2_VERSION" --no-default-features
    fi
}

# build_host TEST: a test of `cargo test`, and the programs that it and its neighbours run, as $BUILD_DIR/debug/NAME.
# Chosen from the whole workspace, as there: for one package alone cargo would choose other features of what all share,
# and build most of it anew.
build_host() {
    cargo test --locked --quiet --workspace --no-run --test "$1"
}

# Builds the image; prints nothing but progress. The ELF is $IMAGE. Arguments go to cargo.
build_image() {
    setup_target
    say "building the image for the Pico${PLC:+ from $PLC}"
    # The same sources give the same bytes on every machine: no path of this one in the places of panics.
    local registry="${CARGO_HOME:-$HOME/.cargo}/registry/src"
    cargo build --locked --release --target "$TARGET" --package plc --bin plc \
        --config "target.$TARGET.rustflags=[\"--remap-path-prefix=$registry=registry\"]" "$@"
}

# build_bench_image PROGRAM CPU OUT [CARGO-ARGUMENT...]: the program and the engine, bare, for counting instructions.
# The path of PROGRAM is absolute. As CPU also `m0plus_flashed`: optimised as the image is that is flashed, which is all
# in which the profiles differ, and keeping what its log tells.
build_bench_image() {
    local program=$1 cpu=$2 out=$3 target=$TARGET optimised=() log
    # Floating point in registers would be of no use: there is none in the engine.
    case $cpu in
        m0plus_flashed)
            optimised=(--config 'profile.bench-image.opt-level=2'
                --config 'profile.bench-image.package.grafcet-core.opt-level=2' --features watched)
            ;;
        m4) target=thumbv7em-none-eabi ;;
        x86) target=x86_64-unknown-none ;;
    esac
    setup_target "$target"
    log=$(mktemp)
    # Nobody moves an image to where it is run, as is usual on x86.
    if ! BENCH_PROGRAM=$program cargo build --locked --quiet --profile bench-image --target "$target" \
        --config 'target.x86_64-unknown-none.rustflags=["-Crelocation-model=static"]' \
        "${optimised[@]}" --package bench-image "${@:4}" 2>"$log"; then
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

TANK=graphs/examples/mixing_tank/plc.toml

# What the tests of the image need of this computer before the images are built: the random programs, which a test of
# the reference writes, and the soft PLC of the mixing tank. The next `cargo test` puts the switcher's in its place.
prepare_test_images() {
    # When it fails it fails among the others, too, and says why.
    cargo test --locked --quiet --workspace --test differential board:: >/dev/null &&
        rm -rf "$RANDOM_PROGRAMS" &&
        # The test writes them anew each time, maybe while images are built of them.
        cp -r "$BUILD_DIR/tmp/applications" "$RANDOM_PROGRAMS" &&
        PLC=$TANK build_host host &&
        cp "$BUILD_DIR/debug/plc" "$BUILD_DIR/debug/plc-mixing_tank"
}

# Builds the image that is flashed and keeps it as $IMAGES/plc: others come to its place.
build_first_image() {
    rm -rf "$IMAGES"
    mkdir -p "$IMAGES"
    build_image --quiet
    cp "$IMAGE" "$IMAGES/plc"
}

# Builds the images of the applications that tests use, each as $IMAGES/NAME: those of tests/emulated/applications, the
# random ones, the drilling station, and the mixing tank. The tasks of `tolerant` hang when a test tells them to.
build_test_images() {
    local wiring name features
    local station=graphs/examples/drilling_station/plc.toml
    for wiring in tests/emulated/applications/*/plc.toml "$RANDOM_PROGRAMS"/*/plc.toml "$station" "$TANK"; do
        # Quietly: what a program that has to show everything is warned of is no news.
        name=$(basename "$(dirname "$wiring")")
        features=()
        if [ "$name" = tolerant ]; then features=(--features hang); fi
        PLC=$wiring build_image --quiet "${features[@]}"
        cp "$IMAGE" "$IMAGES/$name"
    done
}
