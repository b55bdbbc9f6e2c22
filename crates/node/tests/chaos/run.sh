#!/usr/bin/env bash
# The chaos test of docs/robots.md, once for each seed: `closeranks-node fleet scenarios/chaos.toml`. A run fails if a law was broken although
# everything held that it rests on, or if a process died that nobody killed. Prints a row a run and writes verdicts to FOLDER.
#
#     crates/node/tests/chaos/run.sh FOLDER [FIRST LAST]     by default seeds 1 to 20; needs a release build and Python 3
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
node=${NODE:-$here/../../target/release/closeranks-node}
scenario=${SCENARIO:-$here/../../../../scenarios/chaos.toml}
folder=$1 first=${2:-1} last=${3:-20}
mkdir -p "$folder"
bad=0
for seed in $(seq "$first" "$last"); do
  "$node" fleet "$scenario" --seed "$seed" --json > "$folder/$seed.json" 2> "$folder/$seed.log" || bad=$((bad + 1))
  python3 "$here/rows.py" "$folder/$seed.json"
done
python3 "$here/rows.py" --sum "$folder"/*.json
echo "$bad runs were not good"
[ "$bad" -eq 0 ]
