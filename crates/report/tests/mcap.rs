//! MCAP, written and read back: what a run looked like comes back to the bit, from a whole file and from the beginning of one, and no bytes
//! are too bad to be answered.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::io::Cursor;

use closeranks_report::parquet::{Metadata, write};
use closeranks_report::recording::history::{History, MOMENTS_MAX};
use closeranks_report::recording::mcap::{McapError, RunWriter, opened_by, read};
use closeranks_report::recording::read::history;
use closeranks_sim::parse;
use closeranks_sim::world::any::AnyWorld;
use closeranks_sim::world::{Options, run};

/// The recording of a scenario; without its end if it was `killed`.
fn recorded(text: &str, killed: bool) -> Vec<u8> {
    let scenario = parse::scenario(text).unwrap();
    let metadata = Metadata { scenario: text, version: "1.2.3", ..Metadata::default() };
    let mut file = Cursor::new(Vec::new());
    let mut writer = RunWriter::new(&scenario, &metadata, "closeranks run a.toml", &mut file).unwrap();
    let mut world = AnyWorld::new(&scenario, Options::default()).unwrap();
    while !world.is_over() {
        world.step();
        writer.tick(&world.snapshot().unwrap()).unwrap();
    }
    if !killed {
        writer.finish().unwrap();
    }
    file.into_inner()
}

fn by_parquet(text: &str) -> History {
    let scenario = parse::scenario(text).unwrap();
    let record = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap().record;
    let mut file = Vec::new();
    write(&record.unwrap(), &Metadata { scenario: text, ..Metadata::default() }, &mut file).unwrap();
    history(file).unwrap()
}

const SHORT: &str =
    "duration_s = 0.1\n[team]\nmalicious = [2]\n[attack]\nlevel = { kind = \"bias\", bias = 3.0 }\n";

#[test]
fn both_kinds_of_file_say_the_same() {
    for text in [SHORT, "duration_s = 0.05\n[plant]\ncrash = { robot = 5, from_s = 0.01, to_s = 0.03 }\n"] {
        let read = read(&recorded(text, false)).unwrap();
        assert_eq!(read.ticks.len(), read.columns[0].len() / read.robots);
        assert_eq!(read, by_parquet(text));
    }
}

#[test]
fn long_runs_are_thinned_alike() {
    let text = "duration_s = 31.0\ncontroller.kind = \"none\"\n[team]\nrobots = 2\nfaults = 0\nmalicious = []\n[start]\nkind = \"hexagon\"\n";
    let read = read(&recorded(text, false)).unwrap();
    assert!(
        read.ticks.len() <= MOMENTS_MAX && read.ticks[1] == 4,
        "{} {:?}",
        read.ticks.len(),
        &read.ticks[..3]
    );
    assert_eq!(read, by_parquet(text));
}

/// What a killed program leaves: whole chunks, of which the last may end within a tick.
#[test]
fn a_run_without_its_end_is_read_as_far_as_it_was_written() {
    let text = SHORT.replace("0.1", "1.0");
    let (whole, killed) = (recorded(&text, false), recorded(&text, true));
    assert!(killed.ends_with(b"\x89MCAP0\r\n") && killed.len() < whole.len());
    let (whole, killed) = (read(&whole).unwrap(), read(&killed).unwrap());
    let count = killed.ticks.len();
    assert!((10..200).contains(&count), "{count} ticks");
    assert_eq!(killed.ticks, whole.ticks[..count]);
    for (some, all) in killed.columns.iter().zip(&whole.columns) {
        assert_eq!(*some, all[..some.len()]);
    }
    let begun = recorded("duration_s = 0.0\n", true);
    assert!(matches!(read(&begun), Err(McapError::Empty)));
    assert_eq!(opened_by(&begun).as_deref(), Some("closeranks run a.toml"));
}

#[test]
fn no_bytes_are_too_bad() {
    let good = recorded(SHORT, false);
    assert!(matches!(read(b"PAR1"), Err(McapError::NotMcap)));
    assert!(matches!(read(&good[..8]), Err(McapError::NoScenario)));
    for end in (0..good.len()).step_by(997) {
        let _ = (read(&good[..end]), opened_by(&good[..end]));
    }
    for at in (0..good.len()).step_by(211) {
        let mut bytes = good.clone();
        bytes[at] ^= 0xff;
        if let Ok(history) = read(&bytes) {
            assert!(history.ticks.len() <= MOMENTS_MAX);
        }
        let _ = opened_by(&bytes);
    }
}
