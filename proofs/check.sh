#!/usr/bin/env bash
# Checks all proofs, prints what each main theorem rests on, and holds the Rust code against the proved model of W-MSR and
# the proved checker of certificates.
# From anywhere. It installs nothing. Needs Debian's
#
#     coq libcoq-mathcomp-algebra libcoq-mathcomp-zify libcoq-interval libcoq-flocq ocaml-nox
#
# with its bash (5.1 or later), and Rust for the last step (`--no-rust` leaves it out). `--write` writes the committed table anew.
set -euo pipefail
cd "$(dirname "$0")"

rust=yes write=no
for option in "$@"; do
  case "$option" in
    --no-rust) rust=no ;;
    --write) write=yes ;;
    *) echo "no option is called \`$option\`, allowed are --no-rust and --write"; exit 2 ;;
  esac
done

for program in coqc coqdep ocamlfind; do
  command -v "$program" > /dev/null || {
    echo "$program is missing: apt-get install coq libcoq-mathcomp-algebra libcoq-mathcomp-zify libcoq-interval libcoq-flocq ocaml-nox"
    exit 2
  }
done

# Everything is built beside the Rust code, so that nothing lies about here.
build=${CARGO_TARGET_DIR:-../target}/proofs
mkdir -p "$build"
build=$(cd "$build" && pwd)
rm -f "$build"/*.v
cp ./*.v ./*.ml main_theorems.txt axioms_allowed.txt "$build"
here=$PWD
cd "$build"

if grep -nE '\b(Admitted|admit|Axiom|Parameter|Conjecture|Unset Guard Checking|bypass_check)\b' ./*.v; then
  echo "nothing may be left open or assumed"; exit 1
fi

# Files are compiled side by side, each once all that it rests on is there, unless it and all that are what they were.
cores=$(nproc)
declare -A rests=() done=() running=()
while read -r file on; do
  rests[$file]=$on
done < <(coqdep -R . Closeranks ./*.v 2> /dev/null | sed -nE 's/^(\.\/)?([a-z0-9_]+)\.vo [^:]*: /\2 /p' | while read -r file on; do
  echo "$file" "$(tr ' ' '\n' <<< "$on" | grep -v '^/' | sed -nE 's/^(\.\/)?([a-z0-9_]+)\.vo$/\2/p' | tr '\n' ' ')"
done)

compile() {
  local file=$1 key
  shift
  key=$(cat "$file.v" "${@/%/.key}" | sha256sum)
  if test -f "$file.vo" && test "$key" = "$(cat "$file.key" 2> /dev/null)"; then
    echo "== $file.v has not changed"
  else
    echo "== $file.v"
    rm -f "$file.key"
    coqc -q -w none -R . Closeranks "$file.v" || { echo "$file.v does not hold"; return 1; }
    echo "$key" > "$file.key"
  fi
}

# A file that nothing keeps from being compiled, or nothing.
ready() {
  local file on
  for file in "${!rests[@]}"; do
    test -z "${done[$file]:-}${running[$file]:-}" || continue
    for on in ${rests[$file]}; do
      test -n "${done[$on]:-}" || continue 2
    done
    echo "$file"
    return
  done
}

while test "${#done[@]}" -lt "${#rests[@]}"; do
  file=$(ready)
  if test -n "$file" && test "${#running[@]}" -lt "$cores"; then
    # shellcheck disable=SC2086 # names of our own files
    compile "$file" ${rests[$file]} &
    running[$file]=$!
  elif test "${#running[@]}" -eq 0; then
    echo "files rest on each other in a circle, or on one that is not there"; exit 1
  else
    wait -n -p ended || { wait || true; echo "a file does not hold"; exit 1; }
    for file in "${!running[@]}"; do
      if test "${running[$file]}" = "$ended"; then
        done[$file]=yes
        unset "running[$file]"
      fi
    done
  fi
done

# A theorem may rest on the axioms of Coq's real numbers and on nothing else. Each core asks about some of them.
ask() {
  {
    while read -r file theorem; do
      echo "From Closeranks Require $file."
      echo "Eval compute in tt. Print Assumptions $file.$theorem."
    done < "$1.txt"
  } > "$1.v"
  coqtop -q -w none -R . Closeranks -batch -l "$1.v" > "$1.out" 2>&1 || { cat "$1.out"; return 1; }
}
rm -f asked_*
grep -vE '^(#|$)' main_theorems.txt | split -n "r/$cores" -d --additional-suffix=.txt - asked_
asked=()
for part in asked_*.txt; do
  ask "${part%.txt}" &
  asked+=($!)
done
for process in "${asked[@]}"; do
  wait "$process"
done
cat asked_*.out > assumptions.txt
rm -f asked_*.v
theorems=$(grep -cvE '^(#|$)' main_theorems.txt)
paste -d ' ' <(cat asked_*.txt) <(awk '
  /= tt/ { if (n++) print line; line = ""; next }
  /^Closed under/ { line = line " (no axioms)" }
  /^[A-Za-z_.]+ *:/ { line = line " " $1 }
  /^[A-Za-z_.]+$/ { line = line " " $1 }
  END { print line }' assumptions.txt) | sed 's/ Axioms:*//'
checked=$(grep -c '= tt' assumptions.txt)
test "$checked" -eq "$theorems" || { echo "$checked of $theorems theorems were found"; exit 1; }
answered=$(grep -cE '^(Closed under|Axioms:)' assumptions.txt)
test "$answered" -eq "$theorems" || { cat assumptions.txt; echo "$answered of $theorems theorems were answered"; exit 1; }
awk '/^Axioms:/ { inside = 1; next } /= tt|^Closed/ { inside = 0 } inside && /^[^ ]/ { print $1 }' assumptions.txt \
  | sed 's/:$//' | sort -u > axioms_used.txt
if grep -vxFf axioms_allowed.txt axioms_used.txt; then
  echo "the axioms above are not among those allowed (axioms_allowed.txt)"; exit 1
fi
echo "== $theorems theorems, axioms used by any of them: $(wc -l < axioms_used.txt), all of Coq's reals"

echo "== tables of the model"
rm -f model.mli
ocamlfind ocamlopt -w -a -package str model.ml table.ml -o table
./table small > table.txt
committed=$here/../crates/core/tests/wmsr_model/table.txt
if test "$write" = yes; then
  mkdir -p "$(dirname "$committed")" && cp table.txt "$committed"
fi
cmp table.txt "$committed" || { echo "the model no longer writes the committed table: see --write"; exit 1; }
if test "$rust" = yes; then
  ./table large 200000 > large.txt
  CLOSERANKS_WMSR_TABLE="$build/large.txt" cargo test --quiet --locked --manifest-path "$here/../Cargo.toml" \
    -p closeranks-core --test wmsr_model -- --nocapture
fi

echo "== certificates"
rm -f evidence_checker.mli
ocamlfind ocamlopt -w -a evidence_checker.ml certificate.ml -o certificate
if test "$rust" = yes; then
  CLOSERANKS_CERTIFICATES="$build/certificates.txt" cargo test --quiet --locked --manifest-path "$here/../Cargo.toml" \
    -p closeranks-graph --test evidence
  ./certificate --stream certificates.txt
  # Two checkers that agree on everything would agree on nothing if no difference were seen.
  sed '0,/verdict no/s//verdict yes/' certificates.txt > changed.txt
  if ./certificate --stream changed.txt > /dev/null; then echo "a wrong verdict was not seen"; exit 1; fi
fi
echo "all proofs hold"
