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

cat > team.toml << 'T'
[team]
robots = 2
faults = 0
[controller]
kind = "budget"
position_error_m = 0.03
tracking_error_m = 0.03
input_min_m_s = [-0.5, -0.5]
input_max_m_s = [0.5, 0.5]
[clock]
tau_1_s = 0.1
tau_2_s = 0.4
hold_max_s = 0.15
T
"$node" roster new team --parameters team.toml > new.txt
"$node" roster add team robot_1 > /dev/null
"$node" roster add team robot_2 > /dev/null
"$node" roster sign team
cat > robot_1.toml << T
robot = "robot_1"
roster = "team/roster.toml"
operator = "$(sed -n 's/^operator //p' new.txt)"
key = "team/robot_1.key"
epoch = "robot_1.epoch"
[network]
mode = "client"
connect = ["tcp/127.0.0.1:$port"]
[plant]
kind = "ros2"
source_timeout = 0.5
[desired]
source = "ros2"
T
"$node" relay --listen "tcp/127.0.0.1:$port" --scenario team.toml &
sleep 1
"$node" doctor --config robot_1.toml
"$node" run --config robot_1.toml &
"$python" "$here/peer.py" "$port" "${SECONDS_OF_RUN:-20}"
