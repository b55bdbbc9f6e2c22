//! Standard output and error: a reader that goes away ends the printing, a full disk is an error.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;

use anyhow::{Context as _, Result};

/// The first write to standard output that failed for another reason than a closed pipe.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// Prints `text`. A closed pipe ends the printing, not the program; any other failure is kept for [`finish`].
pub(crate) fn say(text: &str) {
    let mut out = io::stdout().lock();
    let written = out.write_all(printable(text).as_bytes()).and_then(|()| out.flush());
    keep(written);
}

/// Keeps why a write to standard output failed, unless its reader went away.
pub(crate) fn keep(written: io::Result<()>) {
    if let Err(error) = written
        && error.kind() != ErrorKind::BrokenPipe
    {
        FAILED.get_or_init(|| error);
    }
}

/// An error if anything that was said could not be written. To be asked once, when all is said.
pub(crate) fn finish() -> Result<()> {
    let Some(error) = FAILED.get() else { return Ok(()) };
    let error = io::Error::new(error.kind(), error.to_string());
    Err(error).context("cannot write to standard output")
}

/// Says something on standard error that is no mistake of the user's.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "note: {}", printable(text));
}

/// Prints an error with its causes. Errors that carry their own picture of the place are printed as they are.
pub(crate) fn complain(error: &anyhow::Error) {
    let mut err = io::stderr().lock();
    let text = match error.downcast_ref::<crate::source::Refused>() {
        Some(refused) => refused.to_string(),
        None => format!("error: {}\n", printable(&format!("{error:#}"))),
    };
    let _ = err.write_all(text.as_bytes());
}

/// Control characters as their escapes: the name of a file must not move the cursor or change colours.
pub(crate) fn printable(text: &str) -> Cow<'_, str> {
    let is_bad = |c: char| c.is_control() && c != '\n' && c != '\t';
    if !text.contains(is_bad) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        if is_bad(character) { safe.extend(character.escape_default()) } else { safe.push(character) }
    }
    Cow::Owned(safe)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_shown_and_not_obeyed() {
        assert_eq!(printable("a\tb\n"), "a\tb\n");
        assert_eq!(printable("\u{1b}[31mred\r"), "\\u{1b}[31mred\\r");
    }
}
