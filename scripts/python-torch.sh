#!/usr/bin/env bash
# The examples that need torch, which is some gigabytes: the filter under the bodies of VMAS, and a short training with BenchMARL. Needs Rust,
# Python 3.10 or later with venv, PyPI and 6 GB of disk.
#
#     scripts/python-torch.sh [PYTHON]
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$(command -v "${1:-python3}")" -m venv "$out/venv"
python="$out/venv/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check --upgrade pip
"$python" -m pip wheel --quiet --no-deps --wheel-dir "$out/wheels" ./bindings/python
"$python" -m pip install --quiet --no-cache-dir --find-links "$out/wheels" "closeranks[learning,torch]" pytest
MPLBACKEND=agg "$out/venv/bin/pytest" -q -rs bindings/python/tests/test_examples.py -k "vmas or benchmarl"
