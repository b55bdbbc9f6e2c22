#!/usr/bin/env bash
# Recordings of runs (`--record FILE.mcap`), read by three libraries that are not ours and compared with the run's Parquet. Needs Python
# 3.11 or later and PyPI.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../../..
venv=${RECORDINGS_VENV:-$root/target/recordings-venv}
if [ ! -x "$venv/bin/python" ]; then
  python3 -m venv "$venv"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$here/requirements.txt"
cargo build --quiet --locked --manifest-path "$root/Cargo.toml" -p closeranks
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Rerun asks at its first start whether it may count users, and writes down the answer: not in the home of whoever runs this.
export HOME=$work
"$venv/bin/rerun" analytics disable > "$work/analytics.log" 2>&1
PATH="$venv/bin:$PATH" "$venv/bin/python" "$here/check.py" "$root/target/debug/closeranks" "$work"
