#!/usr/bin/env bash
# The same certificates and access control, with sessions of PyPI `eclipse-zenoh` in the place of our processes: for machines on which the
# program was not built with `tls`. Needs openssl, and Python 3 with venv and PyPI, or PYTHON with the package.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python=${PYTHON:-$work/venv/bin/python}
if [ ! -x "$python" ]; then
  python3 -m venv venv
  venv/bin/pip install --quiet eclipse-zenoh==1.10.2
fi
source "$here/files.sh"
"$python" "$here/sessions.py"
