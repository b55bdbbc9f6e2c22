#!/usr/bin/env bash
# Builds the page into bindings/web/site, which is committed and lies in the program, so that whoever builds the program needs
# none of this:
#
#     bindings/web/build.sh            builds it
#     bindings/web/build.sh --check    builds it elsewhere and says whether the committed one is the same, byte for byte
#
# The simulator becomes WebAssembly without a target that is downloaded. Debian has a compiler and the sources of its standard library
# in one version (bookworm, from its security archive); Node builds the rest:
#
#     apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22 nodejs npm
#
# The bytes of the module depend on that compiler, which `compiler.txt` names. With another version --check compares all but the module.
# Exit codes: 0 all is well, 1 the build failed or the committed page is stale, 3 something is missing.
set -euo pipefail
cd "$(dirname "$0")"

target=wasm32-unknown-unknown
root=$(cd ../.. && pwd)
export CARGO=${CARGO:-/usr/bin/cargo} RUSTC=${RUSTC:-/usr/bin/rustc}
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target/web}
# Where things lie on this machine is not part of the module, nor on which line: a comment more does not change its bytes.
registry=${CARGO_HOME:-$HOME/.cargo}/registry/src
export RUSTFLAGS="--remap-path-prefix=$root=closeranks --remap-path-prefix=$registry=registry -Zlocation-detail=none"

missing() {
  echo "build.sh: $1 is missing, so nothing was built. On Debian 12:" >&2
  echo "  apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src rust-web-llvm lld-22 nodejs npm" >&2
  exit 3
}

command -v "$CARGO" > /dev/null || missing "cargo ($CARGO)"
command -v "$RUSTC" > /dev/null || missing "rustc ($RUSTC)"
sysroot=$("$RUSTC" --print sysroot)
test -e "$sysroot/lib/rustlib/src/rust/library/std/src/lib.rs" || missing "the source of std under $sysroot/lib/rustlib/src"
command -v node > /dev/null || missing "node"
command -v npm > /dev/null || missing "npm"

version=$("$RUSTC" --version)
echo "$version"
# `-Z build-std` is not stable, hence RUSTC_BOOTSTRAP. Without its default features std prints no backtraces, which a page cannot show.
RUSTC_BOOTSTRAP=1 "$CARGO" build --profile web --locked -p closeranks-web --target "$target" \
  -Z build-std=std,panic_abort -Z build-std-features=

cd page
# A browser of npm's is never downloaded: tests take the one that is there.
test -e node_modules/.package-lock.json || PUPPETEER_SKIP_DOWNLOAD=1 npm ci --no-audit --no-fund --ignore-scripts
node_modules/.bin/tsc --noEmit -p .

site=../site
same=(diff -rq)
if [ "${1:-}" = "--check" ]; then
  site=$(mktemp -d)
  trap 'rm -rf "$site"' EXIT
  if [ "$version" != "$(cat ../compiler.txt)" ]; then
    echo "build.sh: the committed module is by $(cat ../compiler.txt), so its bytes are not compared"
    same+=(--exclude closeranks.wasm)
  fi
else
  echo "$version" > ../compiler.txt
fi
node build.mjs "$CARGO_TARGET_DIR/$target/web/closeranks_web.wasm" "$site"
ls -l "$site"
if [ "${1:-}" = "--check" ] && ! "${same[@]}" "$site" ../site; then
  echo "build.sh: bindings/web/site is not what its sources give; bindings/web/build.sh builds it" >&2
  exit 1
fi
