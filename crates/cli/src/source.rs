//! Files of users: read with a bound; scenarios refused with the line underlined.

use core::fmt;
use std::fs::File;
use std::io::{IsTerminal as _, Read as _};
use std::path::Path;

use annotate_snippets::{Group, Renderer};
use anyhow::{Context, Result, bail};
use closeranks_report::problems;
use closeranks_sim::parse::{self, FILE_MAX, Files, Problem, TEXT_MAX};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::sweep::{Plan, Run as Drawn, TRIES, is_drawn};

/// A file that was refused, with a picture of every mistake.
#[derive(Debug)]
pub(crate) struct Refused(String);

impl Refused {
    /// Draws the mistakes.
    pub(crate) fn new(report: &[Group<'_>]) -> Self {
        Self(renderer().render(report) + "\n")
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for Refused {}

/// Reads and checks a scenario; gives its text too.
pub(crate) fn scenario(file: &Path) -> Result<(Scenario, String)> {
    let text = scenario_text(file)?;
    let files = beside(file, &text);
    match parse::scenario_with(&text, &files) {
        Ok(scenario) => Ok((scenario, whole(file, &text, &files)?)),
        Err(_) if is_drawn(&text) => {
            let name = name(file);
            bail!(
                "`{name}` draws values, so it is many scenarios: run them with `closeranks sweep {name} -o DIR`, one of \
                 them with `closeranks run {name} --draw K --sweep-seed S`; add `--print` for its plain scenario"
            )
        }
        Err(problems) => bail!(refused(file, &text, &problems)),
    }
}

/// Reads a scenario that was drawn, and that messages call `name`.
pub(crate) fn read(name: &str, text: String) -> Result<(Scenario, String)> {
    match parse::scenario(&text) {
        Ok(scenario) => Ok((scenario, text)),
        Err(problems) => bail!(Refused(picture(name, &text, &problems))),
    }
}

/// Reads a scenario that may draw values; gives its text too.
pub(crate) fn plan(file: &Path) -> Result<(Plan, String)> {
    let text = scenario_text(file)?;
    let files = beside(file, &text);
    match Plan::read_with(&text, &files) {
        Ok(plan) => Ok((plan, text + &files.comments())),
        Err(problems) => bail!(refused(file, &text, &problems)),
    }
}

/// The text of a scenario. An empty file is one; an empty pipe is a program before it that failed.
fn scenario_text(file: &Path) -> Result<String> {
    let text = text(file, "scenario", TEXT_MAX)?;
    if text.is_empty() && !file.is_file() {
        bail!("the scenario `{}` is an empty pipe; allowed is TOML, at least a comment", name(file));
    }
    Ok(text)
}

/// The files that a scenario names, from the folder that it stands in.
fn beside(file: &Path, text: &str) -> Files {
    let read = |name: &String| -> Result<String, String> {
        if file == Path::new("-") {
            return Err("a scenario from standard input has no files beside it".to_owned());
        }
        let path = file.parent().unwrap_or(Path::new("")).join(name);
        self::text(&path, "file", FILE_MAX).map_err(|error| format!("{error:#}"))
    };
    parse::named(text).into_iter().map(|name| (name.clone(), read(&name))).collect()
}

/// The text with the rows of its files in it, as it goes into results.
fn whole(file: &Path, text: &str, files: &Files) -> Result<String> {
    let whole = parse::inlined(text, files);
    if whole.len() > TEXT_MAX {
        let (name, length) = (name(file), whole.len());
        bail!(
            "the scenario `{name}` with its files is too long: {length} bytes, allowed is at most {TEXT_MAX}"
        );
    }
    Ok(whole)
}

/// Run `run` of a sweep with `seed`.
pub(crate) fn draw(file: &Path, text: &str, plan: &Plan, seed: u64, run: u64) -> Result<Drawn> {
    plan.draw(seed, run).map_err(|problems| undrawable(file, text, run, &problems))
}

/// What is said of a run that cannot be drawn.
pub(crate) fn undrawable(file: &Path, text: &str, run: u64, problems: &[Problem]) -> anyhow::Error {
    let Refused(picture) = refused(file, text, problems);
    let note = format!(
        "note: none of {TRIES} draws of run {run} can be run; this is what the last was refused for\n"
    );
    Refused(picture + &note).into()
}

fn refused(file: &Path, text: &str, problems: &[Problem]) -> Refused {
    Refused(picture(&name(file), text, problems))
}

/// What messages call a file.
pub(crate) fn name(file: &Path) -> String {
    if file == Path::new("-") { "standard input".to_owned() } else { file.display().to_string() }
}

/// A `what` (scenario, graph) of at most `most` bytes from a file or from standard input, as text.
pub(crate) fn text(file: &Path, what: &str, most: usize) -> Result<String> {
    decode(bytes(file, what, most)?, what, &name(file))
}

/// Bytes as text.
pub(crate) fn decode(bytes: Vec<u8>, what: &str, name: &str) -> Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        anyhow::anyhow!("the {what} `{name}` is not text: byte {at} is not UTF-8")
    })
}

/// At most one byte more than allowed is read.
pub(crate) fn bytes(file: &Path, what: &str, most: usize) -> Result<Vec<u8>> {
    let name = name(file);
    let limit = most as u64 + 1;
    let mut bytes = Vec::new();
    let read = if file == Path::new("-") {
        std::io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else {
        let opened = File::open(file).with_context(|| format!("cannot read the {what} `{name}`"))?;
        opened.take(limit).read_to_end(&mut bytes)
    };
    read.with_context(|| format!("cannot read the {what} `{name}`"))?;
    if bytes.len() > most {
        bail!("the {what} `{name}` is too long: allowed is at most {most} bytes");
    }
    Ok(bytes)
}

fn renderer() -> Renderer {
    if std::io::stderr().is_terminal() { Renderer::styled() } else { Renderer::plain() }
}

fn picture(name: &str, text: &str, problems: &[Problem]) -> String {
    problems::picture(&renderer(), name, text, problems)
}
