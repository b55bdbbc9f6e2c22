#!/usr/bin/env bash
# What CI runs, and what a developer runs before a commit. From the root of the repository, with Rust and a C compiler.
#
#     ./ci.sh              all that needs nothing else
#     ./ci.sh writers      graphs from every writer of networkx and igraph, read back (Python 3 and PyPI)
#     ./ci.sh recordings   recordings of runs, read by three libraries of others (Python 3.11 or later and PyPI)
#     ./ci.sh live         `run --live` in terminals (tmux)
#     ./ci.sh proofs       the theorems of docs/theory, checked by Coq (Debian's packages; proofs/check.sh)
#     ./ci.sh node         robots as processes over Zenoh (crates/node, a workspace of its own with 200 more crates; Python 3 and PyPI)
#     ./ci.sh python       the Python package: wheel, tests, stubs, audit (Python 3.10 or later and PyPI; scripts/python.sh)
#     ./ci.sh python-torch its examples that need torch (the same and 6 GB of disk; scripts/python-torch.sh)
#     ./ci.sh bare-metal   the core on a microcontroller, emulated (Debian's packages; scripts/bare-metal.sh)
#     ./ci.sh web          the page: built anew, compared with the committed one, tried in a browser (bindings/web/README.md)
set -euo pipefail
cd "$(dirname "$0")"
export RUST_BACKTRACE=1

step() { printf '\n== %s\n' "$1"; }

case "${1:-}" in
  "") ;;
  writers)
    step "graphs written by other libraries"
    exec crates/graph/tests/writers/run.sh
    ;;
  recordings)
    step "recordings, read by libraries of others"
    exec crates/cli/tests/mcap/run.sh
    ;;
  live)
    step "runs in a terminal"
    exec crates/cli/tests/live/run.sh
    ;;
  proofs)
    step "theorems, checked by a machine"
    exec proofs/check.sh
    ;;
  node)
    step "robots as processes"
    exec crates/node/ci.sh
    ;;
  python)
    exec scripts/python.sh
    ;;
  python-torch)
    exec scripts/python-torch.sh
    ;;
  bare-metal)
    step "the core on a microcontroller"
    exec scripts/bare-metal.sh
    ;;
  web)
    step "the page is what its sources give"
    bindings/web/build.sh --check
    step "the program that serves it"
    cargo build --locked -p closeranks
    step "the page in a browser"
    cd bindings/web/page
    exec node --test test/model.test.mjs test/page.test.mjs
    ;;
  *)
    echo "no stage is called \`$1\`, allowed are writers, recordings, live, proofs, node, python, python-torch, web, bare-metal, or none"
    exit 2
    ;;
esac

step "format"
cargo fmt --all --check

step "lints"
cargo clippy --workspace --all-targets --locked -- -D warnings

step "the digest of the data set"
(cd docs/data && sha256sum --quiet --check robustness.csv.sha256)

step "tests (the README's command)"
cargo test --workspace

step "documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked --quiet

step "the program, as its user runs it (the README's other command)"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cargo run --release --locked -- paper -o "$out/paper"
test -s "$out/paper/report.html"
cargo run --release --locked --quiet -- run scenarios/random.toml --seed 7 -o "$out/run"
if cargo run --release --locked --quiet -- run scenarios/no-such-file.toml; then
  echo "a missing file must be refused"; exit 1
else
  test $? -eq 2
fi

step "the pictures in docs are those that this program draws"
CLOSERANKS=target/release/closeranks docs/pictures/make.sh --check

step "a campaign of 2,000 runs, other ones for every commit"
seed=$((16#$(git rev-parse --short=8 HEAD 2> /dev/null || echo 1)))
cargo run --release --locked --quiet -- sweep scenarios/campaign.toml --runs 2000 --seed "$seed" -o "$out/campaign"

step "packages of the libraries"
cargo package -p closeranks-core -p closeranks-graph -p closeranks-sim -p closeranks-mcap -p closeranks-report --no-verify --allow-dirty --quiet

step "benches are built, not timed"
cargo test --release --locked --benches --quiet -p closeranks-core -p closeranks-sim

if command -v cargo-deny > /dev/null; then
  step "licences"
  cargo deny check licenses bans sources
fi

echo
echo "all is well"
