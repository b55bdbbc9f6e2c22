//! Ed25519 keys. A private key is a file that its owner alone can read; it is never printed.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::{OpenOptionsExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};

use ed25519_dalek::{SigningKey, VerifyingKey};

use crate::bytes::{hex, unhex};

/// What a file of a private key begins with.
const HEAD: &str = "closeranks private key, keep secret: ";
/// The bits of a file's mode that nobody but the owner may have.
const OTHERS: u32 = 0o077;

/// Why there is no key.
#[derive(Debug, thiserror::Error)]
pub enum KeyError {
    /// The file cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// Others may read or write the file.
    #[error("{path} has mode {mode:03o}, must be 600: chmod 600 {path}")]
    Mode {
        /// Which file.
        path: PathBuf,
        /// Its mode.
        mode: u32,
    },
    /// The file is not one that `roster add` or `key` wrote.
    #[error("{0} is not a private key of closeranks-node")]
    Form(PathBuf),
    /// There are no random numbers.
    #[error("the system gives no random numbers: {0}")]
    Random(getrandom::Error),
}

/// Makes a key and writes it to a new file with mode 600. An existing file is not replaced.
pub fn create(path: &Path) -> Result<SigningKey, KeyError> {
    let mut secret = [0; 32];
    getrandom::fill(&mut secret).map_err(KeyError::Random)?;
    let key = SigningKey::from_bytes(&secret);
    let text = format!("{HEAD}{}\n", hex(&secret));
    let write = || -> io::Result<()> {
        let mut file = OpenOptions::new().write(true).create_new(true).mode(0o600).open(path)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()
    };
    write().map_err(|error| KeyError::File { path: path.to_owned(), error })?;
    Ok(key)
}

/// The key in a file. A file that others may read or write is refused.
pub fn load(path: &Path) -> Result<SigningKey, KeyError> {
    let file = |error| KeyError::File { path: path.to_owned(), error };
    let mode = File::open(path).and_then(|file| file.metadata()).map_err(file)?.permissions().mode();
    if mode & OTHERS != 0 {
        return Err(KeyError::Mode { path: path.to_owned(), mode: mode & 0o777 });
    }
    let text = fs::read_to_string(path).map_err(file)?;
    let secret = text.trim_end().strip_prefix(HEAD).and_then(unhex);
    secret.map(|secret| SigningKey::from_bytes(&secret)).ok_or_else(|| KeyError::Form(path.to_owned()))
}

/// The public key that is written as 64 hexadecimal digits; `None` for other texts and for keys with which forged signatures
/// would pass.
#[must_use]
pub fn public(text: &str) -> Option<VerifyingKey> {
    let key = VerifyingKey::from_bytes(&unhex(text)?).ok()?;
    (!key.is_weak()).then_some(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_a_file_for_its_owner_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.key");
        let key = create(&path).unwrap();
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
        assert_eq!(load(&path).unwrap().to_bytes(), key.to_bytes());
        assert!(matches!(create(&path), Err(KeyError::File { .. })), "a key is not replaced");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        assert!(matches!(load(&path), Err(KeyError::Mode { mode: 0o640, .. })));
    }

    #[test]
    fn what_is_no_key_is_refused_and_not_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.key");
        create(&path).unwrap();
        fs::write(&path, "secret words").unwrap();
        let error = load(&path).unwrap_err().to_string();
        assert!(
            error.ends_with("is not a private key of closeranks-node") && !error.contains("secret words")
        );
    }

    #[test]
    fn a_weak_public_key_is_refused() {
        let mut identity = [0; 32];
        identity[0] = 1;
        assert!(public(&hex(&identity)).is_none(), "every signature would pass");
        assert!(public("xyz").is_none());
    }
}
