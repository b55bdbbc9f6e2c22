#!/usr/bin/env bash
# Measures the table of docs/which.md: how wide a team ends under each controller, in one condition after another. From anywhere, with
# the program of $CLOSERANKS, or one that is built here. RUNS starts a row (60).
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ -z "${CLOSERANKS:-}" ]; then
  cargo build --release --locked --quiet -p closeranks
  CLOSERANKS=target/release/closeranks
fi
program=$(realpath "$CLOSERANKS")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Mean radius of gyration at the end, m, and how many runs violated a law, of one controller in the last sweep.
cell() {
  awk -v of="$1" '
    /gyration/ { widths = 1 }
    $1 == of && NF >= 4 && !seen { broken = $3; seen = 1 }
    $1 == of && widths && NF > 1 { width = $NF }
    END { printf "%s%s", width, (broken > 0 ? " (" broken " broken)" : "") }' out.txt
}

# A row: its name, robots, half the side of the box of the start, the tick, what is in [controller], and other tables.
row() {
  local name=$1 robots=$2 side=$3 tick=$4 controller=$5 tables=$6
  cat > case.toml <<EOF
name = "which"
duration_s = 10.0
[sweep]
controllers = ["budget", "composed", "links"]
[team]
robots = $robots
faults = 2
[clock]
tau_1_s = $tick
[start]
kind = "random"
half_side_m = $side
distance_min_m = 0.31
[controller]
$controller
$tables
EOF
  rm -rf out
  "$program" sweep case.toml --runs "${RUNS:-60}" --seed 1 -o out > out.txt || test $? -eq 1
  echo "| $name | $(cell links) | $(cell budget) | $(cell composed) |"
}

echo "| condition | links | budget | composed |"
echo "| --- | --- | --- | --- |"
row "11 robots, 5 ms" 11 1.0 0.005 "" ""
row "20 ms" 11 1.0 0.02 "" ""
row "100 ms" 11 1.0 0.1 "" ""
row "half of all messages lost" 11 1.0 0.02 "" $'[network]\nloss = 0.5'
row "messages up to 0.3 s late" 11 1.0 0.02 "" $'[network]\ndelay_max_s = 0.3'
row "positions wrong by 1 cm, stated" 11 1.0 0.02 "position_error_m = 0.01" $'[sensing]\nnoise_m = 0.01'
row "a lag of 20 ms, stated" 11 1.0 0.02 "tracking_error_m = 0.05" $'[plant]\nlag_s = 0.02'
row "assume = free" 11 1.0 0.02 'assume = "free"' ""
row "liars: other levels and lists to each" 11 1.0 0.02 "" $'[attack]\nlevel = { kind = "faces" }\nlists = { kind = "faces" }'
row "liars: least levels, never release" 11 1.0 0.02 "" $'[attack]\nlevel = { kind = "bias", bias = -20.0 }\nlists = { kind = "never" }'
row "40 robots" 40 1.4 0.02 "" ""
row "40 robots, partly in sight" 40 1.7 0.02 "" ""
row "40 robots, 100 ms" 40 1.4 0.1 "" ""
