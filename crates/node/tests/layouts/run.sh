#!/usr/bin/env bash
# Three layouts of a network, as far as one machine has them: hosts are network namespaces of Linux, so this needs root and `ip`.
#
#     crates/node/tests/layouts/run.sh [program]     by default target/release/closeranks-node beside Cargo.toml
#
# 1. One laptop: two robots, a plant and a router on it.
# 2. Two hosts on one network, each with a router; the routers are linked by one endpoint, and robots know only their own.
# 3. Two hosts that reach each other only through a third one that forwards, at addresses of a network of their own, as behind a VPN. Nothing
#    is encrypted here: what a VPN adds is time.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
node=$(realpath "${1:-$here/../../target/release/closeranks-node}")
work=$(mktemp -d)
names="cr_a_$$ cr_b_$$ cr_c_$$"
read -r a b c <<< "$names"
clean() {
  kill $(jobs -p) 2> /dev/null || true
  wait 2> /dev/null || true
  for name in $names; do ip netns del "$name" 2> /dev/null || true; done
  rm -rf "$work"
}
trap clean EXIT
cd "$work"

for name in $names; do
  ip netns add "$name"
  ip -n "$name" link set lo up
done
# a and b on one network; and each on one with c, which forwards between them.
link() { # host, address, host, address, prefix of the interfaces
  ip link add "$5a" netns "$1" type veth peer name "$5b" netns "$3"
  ip -n "$1" addr add "$2/24" dev "$5a"
  ip -n "$3" addr add "$4/24" dev "$5b"
  ip -n "$1" link set "$5a" up
  ip -n "$3" link set "$5b" up
}
link "$a" 10.77.1.1 "$b" 10.77.1.2 ab
link "$a" 10.77.2.1 "$c" 10.77.2.9 ac
link "$b" 10.77.3.1 "$c" 10.77.3.9 bc
ip netns exec "$c" sh -c 'echo 1 > /proc/sys/net/ipv4/ip_forward'
ip -n "$a" route add 10.77.3.0/24 via 10.77.2.9
ip -n "$b" route add 10.77.2.0/24 via 10.77.3.9

cat > team.toml << T
duration_s = ${SECONDS_OF_RUN:-10.0}
[team]
robots = 2
faults = 0
malicious = []
[controller]
kind = "budget"
[start]
kind = "hexagon"
[clock]
tau_1_s = 0.1
tau_2_s = 0.4
T
"$node" roster new team --parameters team.toml > new.txt
for name in robot_1 robot_2 plant; do "$node" roster add team "$name" > /dev/null; done
"$node" roster sign team

robot() { # number, endpoint
  cat > "robot_$1.toml" << T
robot = "robot_$1"
roster = "team/roster.toml"
operator = "$(sed -n 's/^operator //p' new.txt)"
key = "team/robot_$1.key"
epoch = "robot_$1.epoch"
clock = "machine"
[network]
mode = "client"
connect = ["$2"]
[desired]
source = "scenario"
file = "team.toml"
T
}
router() { # host, and the endpoint of another router, if there is one
  if [ -n "${ROUTER:-}" ]; then
    ip netns exec "$1" "$ROUTER" --no-multicast-scouting --listen tcp/0.0.0.0:7447 ${2:+--connect "$2"} > "router_$1.log" 2>&1 &
  else
    ip netns exec "$1" "$node" relay --scenario team.toml --listen tcp/0.0.0.0:7447 ${2:+--connect "$2"} &
  fi
  routers+=($!)
  sleep 2
}
layout() { # name, host of robot 1 and of the plant, host of robot 2, endpoint at which the router of the first host is for the second
  printf '\n== %s\n' "$1"
  local routers=() robots=()
  router "$2"
  if [ "$2" != "$3" ]; then router "$3" "$4"; fi
  robot 1 tcp/127.0.0.1:7447
  robot 2 tcp/127.0.0.1:7447
  ip netns exec "$3" "$node" doctor --config robot_2.toml
  ip netns exec "$2" "$node" run --config robot_1.toml 2> robot_1.log & robots+=($!)
  ip netns exec "$3" "$node" run --config robot_2.toml 2> robot_2.log & robots+=($!)
  ip netns exec "$2" timeout 120 "$node" plant --scenario team.toml --roster team/roster.toml --key team/plant.key --one-machine \
    --connect tcp/127.0.0.1:7447
  kill -TERM "${robots[@]}"
  wait "${robots[@]}" || true
  for number in 1 2; do echo "robot_$number, $(grep figures "robot_$number.log")"; done
  kill -TERM "${routers[@]}"
  wait "${routers[@]}" || true
}
layout "one laptop" "$a" "$a" -
layout "two hosts, a router on each" "$a" "$b" tcp/10.77.1.1:7447
layout "two hosts behind a third one that forwards" "$a" "$b" tcp/10.77.2.1:7447
echo
echo "all three layouts: the laws held"
