//! Standard output and error, without a panic when the reader goes away.

use std::io::Write;

/// Prints `text` as it is. A closed pipe ends the printing, not the program.
pub(crate) fn say(text: &str) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Prints an error with its causes. Errors that carry their own picture of the place are printed as they are.
pub(crate) fn complain(error: &anyhow::Error) {
    let mut err = std::io::stderr().lock();
    let text = match error.downcast_ref::<crate::source::Refused>() {
        Some(refused) => refused.to_string(),
        None => format!("error: {error:#}\n"),
    };
    let _ = err.write_all(text.as_bytes());
}
