#!/usr/bin/env bash
# Robots as processes: what CI runs for this crate, which is a workspace of its own. `./ci.sh node` in the root calls it.
set -euo pipefail
cd "$(dirname "$0")"
export RUST_BACKTRACE=1

cargo fmt --check
cargo clippy --all-targets --locked -- -D warnings
cargo test --locked
RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --locked --quiet
# Among topics of ROS 2, with programs that are not ours (Python 3 and PyPI).
tests/ros2/run.sh
echo "the robots are well"
