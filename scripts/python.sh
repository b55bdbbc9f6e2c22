#!/usr/bin/env bash
# The Python package as its user installs it: built into a wheel and installed in an environment of its own, tested there, its stubs
# compared with what is there, its types checked, its wheel audited. Needs Rust, Python 3.10 or later with venv, and PyPI.
#
#     scripts/python.sh [PYTHON]
set -euo pipefail
cd "$(dirname "$0")/.."
step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
interpreter=$(command -v "${1:-python3}")
"$interpreter" -m venv "$out/venv"
python="$out/venv/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check --upgrade pip

step "format and lints of the bindings"
# Always with the same interpreter, not the new one: else half of what was compiled is compiled again.
(cd bindings/python && cargo fmt --check && PYO3_PYTHON=$interpreter cargo clippy --locked --quiet --features pyo3/extension-module -- -D warnings)

step "the wheel"
"$python" -m pip wheel --quiet --no-deps --wheel-dir "$out/wheels" ./bindings/python
ls -lh "$out"/wheels
"$python" -m pip install --quiet --find-links "$out/wheels" "closeranks[test]"

step "the program, which the tests compare with"
cargo build --release --locked --quiet -p closeranks

step "tests"
# Not from the folder of the sources: what is tested is what was installed.
CLOSERANKS="${CARGO_TARGET_DIR:-$PWD/target}/release/closeranks" "$out/venv/bin/pytest" -q bindings/python/tests

step "stubs and types"
(cd "$out" && "$python" -m mypy.stubtest closeranks --mypy-config-file "$OLDPWD/bindings/python/pyproject.toml" \
  --allowlist "$OLDPWD/bindings/python/tests/stubtest.txt")
"$python" -m mypy --config-file bindings/python/pyproject.toml bindings/python/python/closeranks

step "the wheel uses the stable interface of CPython alone"
"$python" -m abi3audit --strict "$out"/wheels/closeranks-*.whl

step "all is well"
