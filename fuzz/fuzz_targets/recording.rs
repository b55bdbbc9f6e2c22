//! libFuzzer looks for bytes that break `closeranks_checks::recording`.
#![no_main]

use libfuzzer_sys::fuzz_target;

// The library that decodes Parquet panics on some files and the reader catches it: that must not end the process. A panic
// of the check itself still does, where libfuzzer-sys catches it.
fuzz_target!(init: std::panic::set_hook(Box::new(|_| ())), |bytes: &[u8]| closeranks_checks::recording(bytes));
