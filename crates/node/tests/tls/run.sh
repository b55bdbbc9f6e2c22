#!/usr/bin/env bash
# TLS and access control of Zenoh around a team, tried: a router that lets each robot put only what is its own, by the name in its
# certificate. Needs openssl, and a program that was built with `cargo build --release --features tls`.
#
#     crates/node/tests/tls/run.sh [program]     by default target/release/closeranks-node beside Cargo.toml
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
node=$(realpath "${1:-$here/../../target/release/closeranks-node}")
work=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
cd "$work"

source "$here/files.sh"
cat > team.toml << T
duration_s = 5.0
[team]
robots = 2
faults = 0
malicious = []
[controller]
kind = "budget"
[start]
kind = "hexagon"
[clock]
tau_1_s = 0.2
tau_2_s = 0.8
T
"$node" roster new team --parameters team.toml > new.txt
for name in robot_1 robot_2 plant; do "$node" roster add team "$name" > /dev/null; done
"$node" roster sign team
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')

# The file of robot_$1 with the certificate of $2, at endpoint $3.
robot() {
  cat > "robot_$1.toml" << T
robot = "robot_$1"
roster = "team/roster.toml"
operator = "$(sed -n 's/^operator //p' new.txt)"
key = "team/robot_$1.key"
epoch = "robot_$1.epoch"
clock = "machine"
[network]
mode = "client"
connect = ["$3"]
zenoh = "$2.json5"
[desired]
source = "scenario"
file = "team.toml"
T
}
endpoint=tls/localhost:$port
"$node" relay --scenario team.toml --listen "$endpoint" --zenoh router.json5 &
sleep 2

step() { printf '\n== %s\n' "$1"; }
fails() { if "$node" doctor --config robot_1.toml; then echo "this must fail"; exit 1; fi; }
step "robot_1 with its own certificate is let in"
robot 1 robot_1 "$endpoint"
"$node" doctor --config robot_1.toml
step "robot_1 with the certificate of robot_2 puts nothing under its name"
robot 1 robot_2 "$endpoint"
fails
step "a certificate of another authority is not let in"
robot 1 stranger "$endpoint"
fails
step "nobody is let in without TLS"
robot 1 robot_1 "tcp/localhost:$port"
fails
step "two robots and a plant run over it, and the laws hold"
robot 1 robot_1 "$endpoint"
robot 2 robot_2 "$endpoint"
"$node" run --config robot_1.toml 2> robot_1.log &
"$node" run --config robot_2.toml 2> robot_2.log &
timeout 120 "$node" plant --scenario team.toml --roster team/roster.toml --key team/plant.key --one-machine \
  --connect "$endpoint" --zenoh plant.json5
echo "TLS and access control: as expected"
