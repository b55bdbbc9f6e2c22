#!/usr/bin/env bash
# A closed loop through the wire form of ROS 2 with programs that are not ours (peer.py). Needs Python 3 with venv, and PyPI.
#
#     crates/node/tests/ros2/run.sh [program]     by default target/debug/closeranks-node beside Cargo.toml
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
node=$(realpath "${1:-$here/../../target/debug/closeranks-node}")
work=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
cd "$work"

python=${PYTHON:-$work/venv/bin/python}
if [ ! -x "$python" ]; then
  python3 -m venv venv
  venv/bin/pip install --quiet zenoh-ros2-sdk==0.1.8 rosbags==0.11.9
fi
port=$("$python" -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')

keys=rmw_zenoh
source "$here/robot.sh"
"$node" relay --listen "tcp/127.0.0.1:$port" --scenario team.toml &
sleep 1
"$node" doctor --config robot_1.toml
"$node" run --config robot_1.toml &
"$python" "$here/peer.py" "$port" "${SECONDS_OF_RUN:-20}"
