#!/usr/bin/env bash
# Builds one robot (bare-metal/) for a microcontroller and says how large it is. With an emulator it also runs it, counts
# instructions and stack, and demands the bits that the same ticks give on this machine.
#
# The target is thumbv7em-none-eabihf: ARM Cortex-M4 and M7 with a floating-point unit. No rustup target is downloaded. The
# compiler and the sources of its `core` must be of one version, and Debian has them both (bookworm, from its security archive):
#
#     apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22 qemu-system-arm
#
# Another pair is used if CARGO and RUSTC name it and its sources lie in its sysroot (for rustup, the component rust-src).
# Exit codes: 0 all is well, 1 the build failed or the bits differ, 3 something is missing.
set -euo pipefail
cd "$(dirname "$0")/../bare-metal"

target=thumbv7em-none-eabihf
host_cargo=$(command -v cargo || true)
export CARGO=${CARGO:-/usr/bin/cargo} RUSTC=${RUSTC:-/usr/bin/rustc}
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/../target/bare-metal}
program=$CARGO_TARGET_DIR/$target/release/closeranks-bare-metal

missing() {
  echo "bare-metal: $1 is missing, so nothing was built. On Debian 12:" >&2
  echo "  apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22 qemu-system-arm" >&2
  exit 3
}

command -v "$CARGO" > /dev/null || missing "cargo ($CARGO)"
command -v "$RUSTC" > /dev/null || missing "rustc ($RUSTC)"
sysroot=$("$RUSTC" --print sysroot)
test -e "$sysroot/lib/rustlib/src/rust/library/core/src/lib.rs" || missing "the source of core under $sysroot/lib/rustlib/src"
{ command -v rust-lld || find "$sysroot/lib/rustlib" -name rust-lld | grep .; } > /dev/null || missing "the linker rust-lld"
command -v readelf > /dev/null || missing "readelf (package binutils)"

"$RUSTC" --version
# `-Z build-std` is not stable, hence RUSTC_BOOTSTRAP.
RUSTC_BOOTSTRAP=1 "$CARGO" rustc --release --locked --target "$target" -Z build-std=core --bin closeranks-bare-metal -- \
  -C link-arg=-T"$PWD/bare-metal.ld"

# Sums the sizes of sections by what a board keeps them in: code and constants in flash, variables in memory.
readelf -S -W "$program" | awk '
  function bytes(hex, i, sum) {
    sum = 0
    for (i = 1; i <= length(hex); i++) sum = 16 * sum + index("0123456789abcdef", substr(hex, i, 1)) - 1
    return sum
  }
  sub(/^ *\[ *[0-9]+\] /, "") && $7 ~ /A/ {
    if ($7 ~ /X/) code += bytes($5)
    else if ($7 ~ /W/) variables += bytes($5)
    else constants += bytes($5)
  }
  END { printf "code %d bytes, constants %d bytes, static variables %d bytes\n", code, constants, variables }'

if ! command -v qemu-system-arm > /dev/null; then
  echo "bare-metal: qemu-system-arm is missing, so the program was built and not run."
  exit 0
fi
answer=$(timeout 300 qemu-system-arm -M mps2-an386 -nographic -monitor none -icount shift=0 \
  -semihosting-config enable=on,target=native -kernel "$program" 2>&1) # semihosting writes there
echo "$answer"
unset CARGO RUSTC
here=$("${host_cargo:-/usr/bin/cargo}" run --release --locked --quiet --example host)
if [ "$here" != "$(echo "$answer" | grep '^digest')" ]; then
  echo "bare-metal: the emulated processor answers with other bits than this machine, which has $here" >&2
  exit 1
fi
echo "this machine gives the same bits"
