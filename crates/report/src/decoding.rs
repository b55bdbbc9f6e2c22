//! Calls of the library that decodes Parquet, which panics on some broken files.

use core::cell::Cell;
use core::panic::AssertUnwindSafe;
use std::panic::{catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// True while a file is decoded on this thread.
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// What `decode` gives, or `None` if it panics.
///
/// Such a panic says that a file is broken, and whoever asked for the file is told so. The message of the panic would tell him nothing, so it is not
/// printed. All other panics are printed as before.
pub(crate) fn decoded<T>(decode: impl FnOnce() -> T) -> Option<T> {
    static QUIET: Once = Once::new();
    QUIET.call_once(be_quiet_while_decoding);
    let before = DECODING.replace(true);
    // What a panic left half done is dropped here or not looked at again.
    let result = catch_unwind(AssertUnwindSafe(decode));
    DECODING.set(before);
    result.ok()
}

fn be_quiet_while_decoding() {
    let print = take_hook();
    set_hook(Box::new(move |panic| {
        if !DECODING.get() {
            print(panic);
        }
    }));
}

#[cfg(test)]
mod tests {
    use core::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn only_panics_of_decoders_are_not_printed() {
        static PRINTED: AtomicUsize = AtomicUsize::new(0);
        set_hook(Box::new(|_| {
            PRINTED.fetch_add(1, Ordering::Relaxed);
        }));
        let printed = || PRINTED.load(Ordering::Relaxed);
        assert_eq!(decoded(|| 7), Some(7));
        assert_eq!(decoded(|| assert!(printed() > 0, "of a decoder")), None);
        assert_eq!(printed(), 0);
        assert!(catch_unwind(|| assert!(printed() > 0, "of anything else")).is_err());
        assert_eq!(printed(), 1);
    }
}
