//! libFuzzer looks for bytes that break `closeranks_checks::graph_as` with the format json.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| closeranks_checks::graph_as("json", bytes));
