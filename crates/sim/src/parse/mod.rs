//! Scenarios written in TOML. Every field has a default, and what is not understood is refused with its place.

mod checks;
pub(crate) mod column;
pub(crate) mod common;
mod fields;
pub(crate) mod files;
mod gone;
mod lists;
mod problem;
pub(crate) mod reader;
pub(crate) mod rows;
mod section;
mod teams;
pub(crate) mod value;

pub use crate::scenario::inline::inlined;
pub use checks::ROWS_MAX;
pub use files::{FILE_MAX, Files, named};
pub use problem::Problem;

use toml::Spanned;
use toml::de::DeTable;

use crate::scenario::Scenario;

/// Longest scenario text, bytes.
pub const TEXT_MAX: usize = 1 << 20;

/// The scenario of a TOML text, or everything that is wrong with it.
///
/// A scenario that comes back can be run: parameters are in their ranges, the start exists and no two robots stand at
/// one point.
pub fn scenario(text: &str) -> Result<Scenario, Vec<Problem>> {
    scenario_with(text, &Files::default())
}

/// The scenario of a text that names `files` beside it ([`named`]).
pub fn scenario_with(text: &str, files: &Files) -> Result<Scenario, Vec<Problem>> {
    let table = table(text)?;
    if teams::are_in(table.get_ref()) {
        return teams::scenario(table.get_ref(), files);
    }
    let mut reader = reader::Reader::new(files);
    let scenario = fields::read(&mut reader, table.get_ref());
    if reader.is_clean() {
        checks::check(&mut reader, &scenario);
    }
    let problems = reader.finish();
    if problems.is_empty() { Ok(scenario) } else { Err(problems) }
}

/// True if this is the text of several teams.
#[must_use]
pub fn has_teams(text: &str) -> bool {
    table(text).is_ok_and(|table| teams::are_in(table.get_ref()))
}

/// What is not understood in a text, each field by itself: its team and its start are not looked at.
pub(crate) fn misread(text: &str, files: &Files) -> Vec<Problem> {
    let table = match table(text) {
        Ok(table) => table,
        Err(problems) => return problems,
    };
    if teams::are_in(table.get_ref()) {
        return teams::misread(table.get_ref(), files);
    }
    let mut reader = reader::Reader::new(files);
    fields::read(&mut reader, table.get_ref());
    reader.finish()
}

/// The text as TOML.
pub(crate) fn table(text: &str) -> Result<Spanned<DeTable<'_>>, Vec<Problem>> {
    let broken = |span, found| vec![Problem { span, field: String::new(), found, allowed: String::new() }];
    if text.len() > TEXT_MAX {
        let found = format!("a scenario of {} bytes, allowed is at most {TEXT_MAX}", text.len());
        return Err(broken(0..0, found));
    }
    DeTable::parse(text).map_err(|error| broken(error.span().unwrap_or(0..0), error.message().to_owned()))
}
