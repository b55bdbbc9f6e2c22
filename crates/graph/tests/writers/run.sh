#!/usr/bin/env bash
# Writes random graphs with every writer of networkx and igraph and reads them back. Needs Python 3 and PyPI, or a folder with
# the packages of requirements.txt in WRITERS_VENV. A hundred graphs by default: run.sh [GRAPHS [SEED]].
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../../..
venv=${WRITERS_VENV:-$root/target/writers-venv}
if [ ! -x "$venv/bin/python" ]; then
  python3 -m venv "$venv"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$here/requirements.txt"
cargo build --quiet --manifest-path "$root/Cargo.toml" -p closeranks-graph --example read
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$venv/bin/python" "$here/writers.py" "$root/target/debug/examples/read" "$work" "${1:-100}" "${2:-1}"
