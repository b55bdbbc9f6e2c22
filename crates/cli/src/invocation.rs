//! The command line: read once, and written down in one spelling, so that its output is known again later.

use std::path::Path;
use std::sync::OnceLock;

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
pub(crate) use closeranks_sweep::outcome::quoted;

/// What runs, and whether it may replace what another command wrote.
#[derive(Debug)]
struct Invocation {
    name: String,
    overwrite: bool,
}

static INVOCATION: OnceLock<Invocation> = OnceLock::new();

/// Commands whose results go to a folder that a later run may replace.
const WRITERS: [&str; 5] = ["paper", "run", "compare", "check", "view"];

/// Arguments that say where results go and how they are told, not what they are.
const UNTELLING: [&str; 8] = ["output", "record", "export", "overwrite", "quiet", "json", "live", "speed"];

/// Adds `--overwrite` to every command that writes a folder and may replace.
pub(crate) fn with_overwrite(command: Command) -> Command {
    WRITERS.into_iter().fold(command, |command, name| {
        let overwrite = Arg::new("overwrite").long("overwrite").action(ArgAction::SetTrue);
        let overwrite = overwrite.help("Replace what another command of closeranks wrote there");
        command.mut_subcommand(name, |command| command.arg(overwrite))
    })
}

/// Notes what was asked for. To be called once, before anything else.
pub(crate) fn note(command: &Command, matches: &ArgMatches) {
    let Some((name, matches)) = matches.subcommand() else { return };
    let Some(command) = command.find_subcommand(name) else { return };
    let words = command.get_arguments().filter_map(|argument| word(argument, matches));
    let words: Vec<String> = [format!("closeranks {name}")].into_iter().chain(words).collect();
    let overwrite = WRITERS.contains(&name) && matches.try_get_one("overwrite").ok().flatten() == Some(&true);
    INVOCATION.get_or_init(|| Invocation { name: words.join(" "), overwrite });
}

/// The command in one spelling, such as `closeranks run /home/ada/a.toml --seed 5`: results of one name are alike.
pub(crate) fn name() -> &'static str {
    INVOCATION.get().map_or("closeranks", |invocation| &invocation.name)
}

/// True if `--overwrite` was given.
pub(crate) fn may_overwrite() -> bool {
    INVOCATION.get().is_some_and(|invocation| invocation.overwrite)
}

/// An argument as it would be typed; none if it was not, or if it does not change the results.
fn word(argument: &Arg, matches: &ArgMatches) -> Option<String> {
    let id = argument.get_id().as_str();
    if UNTELLING.contains(&id) || matches.value_source(id) != Some(ValueSource::CommandLine) {
        return None;
    }
    let values = matches.get_raw(id).into_iter().flatten().map(|value| value.to_string_lossy());
    match argument.get_long() {
        Some(long) if matches!(argument.get_action(), ArgAction::SetTrue) => Some(format!("--{long}")),
        Some(long) => Some(format!("--{long} {}", quoted(&values.collect::<Vec<_>>().join(",")))),
        None => Some(values.map(|value| quoted(&whole_path(&value))).collect::<Vec<_>>().join(" ")),
    }
}

/// Makes a path absolute, so that a file has one name from whichever folder the program is called.
fn whole_path(value: &str) -> String {
    if value == "-" {
        return value.to_owned();
    }
    std::path::absolute(Path::new(value)).map_or(value.to_owned(), |path| path.to_string_lossy().into_owned())
}

/// The largest seed: what TOML can say, so that a seed is one number in files, on the command line and in JSON.
const SEED_MAX: u64 = i64::MAX.cast_unsigned();

/// Reads a seed.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|seed| *seed <= SEED_MAX);
    number.ok_or_else(|| format!("allowed is a whole number, 0 to {SEED_MAX}"))
}
