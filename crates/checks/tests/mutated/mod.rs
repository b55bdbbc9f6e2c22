//! Bytes as fuzzers make them: a file of the corpus with some changes, the same for the same random numbers.

use std::fs;
use std::path::Path;

use super::seeded::Seeded;

/// The files of `fuzz/corpus/<target>` in order of their names.
pub(crate) fn corpus(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let mut paths: Vec<_> =
        fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(paths.len() >= 5, "{} is no corpus", folder.display());
    paths.into_iter().map(|path| (path.display().to_string(), fs::read(path).expect("a file"))).collect()
}

/// A file of the corpus with one to five changes; the number is that of the file.
pub(crate) fn mutated(files: &[(String, Vec<u8>)], random: &mut Seeded) -> (usize, Vec<u8>) {
    let origin = random.below(files.len());
    let mut bytes = files[origin].1.clone();
    for _ in 0..=random.below(4) {
        mutate(&mut bytes, &files[random.below(files.len())].1, random);
    }
    (origin, bytes)
}

/// One change as fuzzers make them; `donor` is another file of the corpus.
fn mutate(bytes: &mut Vec<u8>, donor: &[u8], random: &mut Seeded) {
    let byte = u8::try_from(random.below(256)).unwrap_or(0);
    let (place, length) = (random.below(bytes.len() + 1), 1 + random.below(8));
    let end = (place + length).min(bytes.len());
    match random.below(7) {
        0 => bytes.truncate(place),
        1 => drop(bytes.drain(place..end)),
        2 => bytes.insert(place, byte),
        3 => bytes[place..end].fill(byte),
        4 => bytes.extend_from_within(place..end),
        5 => {
            let start = random.below(donor.len() + 1);
            let piece = donor[start..(start + 4 * length).min(donor.len())].to_vec();
            drop(bytes.splice(place..place, piece));
        }
        _ => bytes[place..end].iter_mut().for_each(|old| *old ^= 1 << (byte & 7)),
    }
}
