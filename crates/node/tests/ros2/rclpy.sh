#!/usr/bin/env bash
# A closed loop with ROS 2 itself: rclpy over Fast DDS (rclpy_peer.py), through a bridge, to one `closeranks-node`. Needs root (the loop runs in
# a network namespace of its own, with multicast on its loopback), Python 3.10 to 3.13 with venv, and PyPI (250 MB).
#
#     crates/node/tests/ros2/rclpy.sh [program]     by default target/release/closeranks-node beside Cargo.toml
#
# The bridge is rclpy_bridge.py, or the program in BRIDGE, which is started with the router's endpoint. With zenoh-plugin-ros2dds that is
#
#     apt-get install cmake libclang-dev && (cd crates/node/tests/ros2/bridge && cargo build)
#     BRIDGE=crates/node/tests/ros2/bridge/target/debug/bridge crates/node/tests/ros2/rclpy.sh
#
# PYTHON names an interpreter that has the packages already.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
node=$(realpath "${1:-$here/../../target/release/closeranks-node}")
BRIDGE=${BRIDGE:+$(realpath "$BRIDGE")}
export BRIDGE
if [ -z "${INSIDE:-}" ]; then
  python=${PYTHON:-}
  if [ -z "$python" ]; then
    venv=$(mktemp -d)
    trap 'rm -rf "$venv"' EXIT
    python3 -m venv "$venv"
    python=$venv/bin/python
    "$python" -m pip install --quiet "ros-kilted-rclpy[fastrtps]==9.1.2" ros-kilted-geometry-msgs ros-kilted-nav-msgs \
      ros-kilted-diagnostic-msgs ros-kilted-visualization-msgs eclipse-zenoh==1.10.2
  fi
  INSIDE=1 PYTHON=$(realpath -s "$python") unshare --net "$0" "$node"
  exit
fi
ip link set lo up
ip link set lo multicast on
ip route add 239.255.0.0/16 dev lo
export ROS_DISTRO=kilted FASTDDS_BUILTIN_TRANSPORTS=UDPv4
unset ROS_AUTOMATIC_DISCOVERY_RANGE
# The DDS of the plugin: on the loopback alone.
loopback='<Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces><AllowMulticast>true</AllowMulticast>'
export CYCLONEDDS_URI="<CycloneDDS><Domain><General>$loopback</General></Domain></CycloneDDS>"
work=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
cd "$work"
port=7447 keys=ros2dds
source "$here/robot.sh"
"$node" relay --listen "tcp/127.0.0.1:$port" --scenario team.toml &
sleep 1
if [ -n "${BRIDGE:-}" ]; then "$BRIDGE" "tcp/127.0.0.1:$port" & else "$PYTHON" "$here/rclpy_bridge.py" "$port" & fi
"$node" run --config robot_1.toml &
"$PYTHON" "$here/rclpy_peer.py" "${SECONDS_OF_RUN:-20}"
