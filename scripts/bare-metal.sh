#!/usr/bin/env bash
# Builds `closeranks-core` and a small program around one robot (bare-metal/) for a microcontroller, and says how large that is.
#
# The target is thumbv7em-none-eabihf: ARM Cortex-M4 and M7 with a floating-point unit. No rustup target is downloaded. The
# compiler and the sources of its `core` must be of one version, and Debian has them both (bookworm, from its security archive):
#
#     apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22
#
# Another pair is used if CARGO and RUSTC name it and its sources lie in its sysroot (for rustup, the component rust-src).
set -euo pipefail
cd "$(dirname "$0")/../bare-metal"

target=thumbv7em-none-eabihf
export CARGO=${CARGO:-/usr/bin/cargo} RUSTC=${RUSTC:-/usr/bin/rustc}
export RUSTC_BOOTSTRAP=1 # `-Z build-std` is not stable
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/../target/bare-metal}
install="On Debian 12: apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22"

missing() {
  echo "bare-metal: $1 is missing, so nothing was built." >&2
  echo "$install" >&2
  exit 3
}

command -v "$CARGO" > /dev/null || missing "cargo ($CARGO)"
command -v "$RUSTC" > /dev/null || missing "rustc ($RUSTC)"
sysroot=$("$RUSTC" --print sysroot)
test -e "$sysroot/lib/rustlib/src/rust/library/core/src/lib.rs" || missing "the source of core under $sysroot/lib/rustlib/src"
{ command -v rust-lld || find "$sysroot/lib/rustlib" -name rust-lld | grep .; } > /dev/null || missing "the linker rust-lld"
command -v readelf > /dev/null || missing "readelf (package binutils)"

"$RUSTC" --version
"$CARGO" build --release --locked --target "$target" -Z build-std=core

# Sums the sizes of sections by what a board keeps them in: code and constants in flash, variables in memory.
readelf -S -W "$CARGO_TARGET_DIR/$target/release/closeranks-bare-metal" | awk '
  function bytes(hex, i, sum) {
    sum = 0
    for (i = 1; i <= length(hex); i++) sum = 16 * sum + index("0123456789abcdef", substr(hex, i, 1)) - 1
    return sum
  }
  sub(/^ *\[ *[0-9]+\] /, "") && $7 ~ /A/ {
    if ($7 ~ /X/) code += bytes($5)
    else if ($7 ~ /W/) variables += bytes($5)
    else if ($1 !~ /^\.ARM/) constants += bytes($5)
  }
  END { printf "code %d bytes, constants %d bytes, static variables %d bytes\n", code, constants, variables }'
