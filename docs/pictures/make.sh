#!/usr/bin/env bash
# Makes the pictures of README and docs again. `make.sh --check` changes nothing and fails, with their names, if any is stale.
# `make.sh campaign FOLDER` takes campaign-laws.png over from the folder of a finished sweep (docs/reliability.md has the command): it
# is about the commit that is named there, so it does not become stale. The program is built, or taken from $CLOSERANKS.
# robustness-performance.svg shows measured times: crates/graph/benches/compare/compare.py draws it.
# swarm.png is overview.png of `closeranks run scenarios/swarm.toml -o swarm`, made smaller: it takes too long to be made here.
# swarm-cost.svg shows counted instructions: crates/sim/benches/swarm.py draws it.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD

case "${1:-}" in
  "" | --check) ;;
  campaign)
    folder=${2:?"the folder of a finished sweep is missing"}
    grep -qF 'name = \"campaign\"' "$folder/sweep.json" ||
      { echo "$folder holds no sweep of scenarios/campaign.toml" >&2; exit 2; }
    cp "$folder/laws.png" docs/pictures/campaign-laws.png
    exit
    ;;
  *) echo "usage: $0 [--check | campaign FOLDER]" >&2; exit 2 ;;
esac
if [ -n "${CLOSERANKS:-}" ]; then
  program=$(realpath "$CLOSERANKS")
else
  cargo build --release --locked --quiet -p closeranks
  program=$root/target/release/closeranks
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ln -s "$root/scenarios" scenarios
mkdir made

# Exit code 1 is an answer here: a law is broken, or the network does not survive.
answer() { "$@" || test $? -eq 1; }

answer "$program" paper -q -o paper
cp paper/inside-figure1.png made/figure1.png
"$program" graph tight 10 2 | answer "$program" check - -q -o tight
cp tight/graph.svg made/tight.svg
"$program" graph elemental 1 | answer "$program" check - -q -o elemental
cp elemental/graph.svg made/elemental.svg
answer "$program" run scenarios/inside-overstating.toml -q -o moving
cp moving/animation.svg made/animation.svg
answer "$program" run scenarios/teams.toml -q -o teams
cp teams/overview.svg made/teams.svg
answer "$program" run scenarios/unfiltered.toml -q -o run
answer "$program" check run/run.parquet -q -o unfiltered
cp unfiltered/robustness.svg made/unfiltered-robustness.svg
(cd "$root" && cargo run --release --locked --quiet -p closeranks-report --example ranks) > made/ranks.svg

stale=0
for picture in made/*; do
  name=$(basename "$picture")
  kept=$root/docs/pictures/$name
  if cmp -s "$picture" "$kept"; then
    continue
  elif [ "${1:-}" = --check ]; then
    echo "docs/pictures/$name is stale: docs/pictures/make.sh makes it again"
    stale=1
  else
    cp "$picture" "$kept"
    echo "docs/pictures/$name: made again"
  fi
done
exit "$stale"
