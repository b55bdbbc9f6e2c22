#!/usr/bin/env bash
# `run --live` in terminals of tmux: wide, narrow, too small, and resized while it runs. Needs tmux. `run.sh FOLDER` leaves what
# was on the screens there, to be looked at.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
command -v tmux > /dev/null || { echo "live/run.sh: tmux is missing (apt-get install tmux)" >&2; exit 3; }
cargo build --quiet --locked --manifest-path "$root/Cargo.toml" -p closeranks
work=$(mktemp -d)
shown=${1:-$work}
mkdir -p "$shown"
# A server of its own, so that nobody's sessions are touched.
socket=$work/tmux
trap 'tmux -S "$socket" kill-server 2> /dev/null || true; rm -rf "$work"' EXIT
export LC_ALL=C.UTF-8
printf 'duration_s = 2.0\nname = "tour"\n[team]\nmalicious = [1, 2]\n' > "$work/tour.toml"

# Starts the program in a terminal of COLUMNS x ROWS; it says `ended CODE` when it is over.
start() { # name, columns, rows, words...
  local name=$1 columns=$2 rows=$3
  shift 3
  tmux -S "$socket" -u -f /dev/null new-session -d -s "$name" -x "$columns" -y "$rows" \
    "cd '$work' && '$root/target/debug/closeranks' $*; echo \"ended \$?\"; tmux -S '$socket' wait-for -S '$name'; exec cat"
}
screen() { tmux -S "$socket" capture-pane -p -t "$1" -S - | tee "$shown/$1.txt"; }
has() { # name, text
  grep -qF -- "$2" "$shown/$1.txt" || { echo "the screen $1 lacks: $2" >&2; cat "$shown/$1.txt" >&2; exit 1; }
}
lacks() {
  if grep -qF -- "$2" "$shown/$1.txt"; then echo "the screen $1 should not have: $2" >&2; cat "$shown/$1.txt" >&2; exit 1; fi
}

start wide 120 40 run tour.toml --live --speed 4
start narrow 48 24 run tour.toml --live --speed 4
start small 28 8 run tour.toml --live --speed 20
start resized 120 40 run tour.toml --live --speed 1
# Once the first picture is there, the terminal becomes narrow under it.
until tmux -S "$socket" capture-pane -p -t resized | grep -q 'tour'; do :; done
tmux -S "$socket" resize-window -t resized -x 60 -y 24
for name in wide narrow small resized; do
  tmux -S "$socket" wait-for "$name"
  screen "$name" > /dev/null
  has "$name" "ended 0"
done

for name in wide narrow; do
  has "$name" "tour  composed  t = 2.00 s of 2 s"
  has "$name" "■1"
  has "$name" "■2"
  has "$name" "●11"
  # Pictures replace each other: there is one of them, and the table of the run below it.
  test "$(grep -c '^tour  composed' "$shown/$name.txt")" = 1 || { echo "$name: more than one picture" >&2; exit 1; }
  has "$name" "digest: "
done
has wide "honest robots: fewest neighbours"
has wide "robot  near h"
lacks narrow "robot  near h"
has small "28 x 8 is too small"
# What was on the screen before it became narrow is history; what came after has no table.
sed -n '/^tour  composed  t = 2.00 s/,$p' "$shown/resized.txt" > "$shown/after.txt"
has after "●11"
lacks after "robot  near h"
# A pipe is no terminal.
if "$root/target/debug/closeranks" run "$work/tour.toml" --live 2> "$work/refused" | cat; then
  echo "a pipe was not refused" >&2
  exit 1
fi
grep -qF 'draws in a terminal, and standard output is none' "$work/refused"
echo "run --live: wide, narrow, small, resized and refused"
