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

# An authority, and a certificate for each process: authority NAME, certificate NAME AUTHORITY.
authority() {
  openssl req -x509 -newkey ed25519 -nodes -keyout "$1.key" -out "$1.pem" -days 30 -subj "/CN=$1" 2> /dev/null
}
certificate() {
  printf 'subjectAltName = DNS:localhost\nextendedKeyUsage = serverAuth, clientAuth\n' > "$1.ext"
  openssl req -newkey ed25519 -nodes -keyout "$1.tls" -out "$1.csr" -subj "/CN=$1" 2> /dev/null
  openssl x509 -req -in "$1.csr" -CA "$2.pem" -CAkey "$2.key" -CAcreateserial -days 30 -extfile "$1.ext" -out "$1.pem" 2> /dev/null
  chmod 600 "$1.tls"
}
authority ours
authority theirs
for name in router robot_1 robot_2 plant; do certificate "$name" ours; done
certificate stranger theirs

# What Zenoh is told: certificates for both directions of a connection, each end showing its own.
tls() {
  cat << T
transport: { link: { tls: {
  root_ca_certificate: "$work/ours.pem", enable_mtls: true, verify_name_on_connect: true,
  listen_private_key: "$work/$1.tls", listen_certificate: "$work/$1.pem",
  connect_private_key: "$work/$1.tls", connect_certificate: "$work/$1.pem",
} } },
T
}
for name in robot_1 robot_2 plant stranger; do { echo "{"; tls "$name"; echo "}"; } > "$name.json5"; done

# Whoever has a certificate of ours may listen; a robot may put what is its own, and the plant what robots are shown.
rule() { printf '{ id: "%s", messages: ["put"], flows: ["ingress"], permission: "allow", key_exprs: [%s] },\n' "$1" "$2"; }
own() { printf '"closeranks/say/%s", "closeranks/report/%s", "closeranks/status/%s", "closeranks/evidence/*", "closeranks/proof/*", "closeranks/doctor/%s"' "$1" "$1" "$1" "$1"; }
{
  echo "{"
  tls router
  echo 'access_control: { enabled: true, default_permission: "deny", rules: ['
  rule robot_1 "$(own 1)"
  rule robot_2 "$(own 2)"
  rule plant '"closeranks/sensed/*"'
  echo '{ id: "out", messages: ["put"], flows: ["egress"], permission: "allow", key_exprs: ["closeranks/**"] },'
  echo '{ id: "listen", messages: ["declare_subscriber"], flows: ["ingress", "egress"], permission: "allow", key_exprs: ["closeranks/**"] },'
  echo '], subjects: ['
  for name in robot_1 robot_2 plant; do echo "{ id: \"$name\", cert_common_names: [\"$name\"] },"; done
  echo '], policies: ['
  for name in robot_1 robot_2 plant; do echo "{ rules: [\"$name\", \"out\", \"listen\"], subjects: [\"$name\"] },"; done
  echo '] } }'
} > router.json5

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
here=tls/localhost:$port
"$node" relay --scenario team.toml --listen "$here" --zenoh router.json5 &
sleep 2

step() { printf '\n== %s\n' "$1"; }
fails() { if "$node" doctor --config robot_1.toml; then echo "this must fail"; exit 1; fi; }
step "robot_1 with its own certificate is let in"
robot 1 robot_1 "$here"
"$node" doctor --config robot_1.toml
step "robot_1 with the certificate of robot_2 puts nothing under its name"
robot 1 robot_2 "$here"
fails
step "a certificate of another authority is not let in"
robot 1 stranger "$here"
fails
step "nobody is let in without TLS"
robot 1 robot_1 "tcp/localhost:$port"
fails
step "two robots and a plant run over it, and the laws hold"
robot 1 robot_1 "$here"
robot 2 robot_2 "$here"
"$node" run --config robot_1.toml 2> robot_1.log &
"$node" run --config robot_2.toml 2> robot_2.log &
timeout 120 "$node" plant --scenario team.toml --roster team/roster.toml --key team/plant.key --one-machine \
  --connect "$here" --zenoh plant.json5
echo "TLS and access control: as expected"
