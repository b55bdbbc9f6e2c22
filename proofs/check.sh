#!/usr/bin/env bash
# Checks all proofs, prints what each main theorem rests on, and holds the Rust code against the proved model of W-MSR and
# the proved checker of certificates.
# From anywhere. It installs nothing. Needs Debian's
#
#     coq libcoq-mathcomp-algebra libcoq-mathcomp-zify libcoq-interval libcoq-flocq ocaml-nox
#
# and Rust for the last step (`--no-rust` leaves it out). `--write` writes the committed table anew.
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

# A file is compiled unless it and all that it rests on are what they were.
for file in $(coqdep -sort -R . Closeranks ./*.v 2> /dev/null); do
  file=${file#./}; file=${file%.vo}; file=${file%.v}
  keys=$(coqdep -R . Closeranks "$file.v" 2> /dev/null | sed -n "s/^$file\.vo [^:]*: //p" | tr ' ' '\n' \
    | grep -vE '^/' | sed -n 's/\.vo$/.key/p')
  # shellcheck disable=SC2086 # names of our own files
  key=$(cat "$file.v" $keys | sha256sum)
  if test -f "$file.vo" && test "$key" = "$(cat "$file.key" 2> /dev/null)"; then
    echo "== $file.v has not changed"
  else
    echo "== $file.v"
    rm -f "$file.key"
    coqc -q -w none -R . Closeranks "$file.v"
    echo "$key" > "$file.key"
  fi
done

# A theorem may rest on the axioms of Coq's real numbers and on nothing else.
{
  while read -r file theorem; do
    case "$file" in "" | \#*) continue ;; esac
    echo "From Closeranks Require $file."
    echo "Eval compute in tt. Print Assumptions $file.$theorem."
  done < main_theorems.txt
} > assumptions_of_all.v
coqtop -q -w none -R . Closeranks -batch -l assumptions_of_all.v > assumptions.txt 2>&1 || { cat assumptions.txt; exit 1; }
rm assumptions_of_all.v
theorems=$(grep -cvE '^(#|$)' main_theorems.txt)
paste -d ' ' <(grep -vE '^(#|$)' main_theorems.txt) <(awk '
  /= tt/ { if (n++) print line; line = ""; next }
  /^Closed under/ { line = line " (no axioms)" }
  /^[A-Za-z_.]+ *:/ { line = line " " $1 }
  /^[A-Za-z_.]+$/ { line = line " " $1 }
  END { print line }' assumptions.txt) | sed 's/ Axioms:*//' | tee main_assumptions.txt
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
