//! The `closeranks` program.
fn main() {}
