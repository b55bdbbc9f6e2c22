//! The `closeranks` program.
//!
//! Exit codes: 0 fine, 1 a law that was expected to hold was broken, 2 bad input.

mod advise;
mod bench;
mod check;
mod compare;
mod folder;
mod invocation;
mod live;
mod maker;
mod output;
mod paper;
mod progress;
mod results;
mod run;
mod source;
mod sweep;
mod threads;
mod view;
mod wrap;

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Args, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use closeranks_report::sentences;
use closeranks_sim::scenario::Controller;
use results::{as_run, json, pages};

/// Keeps a team of robots agreeing while some of them lie.
#[derive(Debug, Parser)]
#[command(name = "closeranks", version, long_version = closeranks_sweep::VERSION)]
#[command(arg_required_else_help = true, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 fine, 1 a law that was expected to hold was broken, 2 bad input.\n\
                          Start with: closeranks paper";

const RUN_HELP: &str = "\
A scenario is a TOML file in which every field has a default, so an empty file is the paper's own experiment:

    # understating.toml
    seed = 7

    [team]
    robots = 11
    faults = 2            # F: how many liars W-MSR and the controller are prepared for
    malicious = [1, 2]    # who lies

    [attack]
    level = { kind = \"bias\", bias = -2.5 }

    closeranks run understating.toml            # the table and what became of each law
    closeranks run understating.toml -o out     # and figures, every tick as Parquet, a page
    closeranks run understating.toml --json | jq .laws.degree
    closeranks run campaign.toml --draw 17 --sweep-seed 1           # repeats run 17 of a sweep exactly
    closeranks run campaign.toml --draw 17 --print > plain.toml     # its plain scenario

All fields with their ranges: scenarios/everything.toml. More to start from: scenarios/README.md.

Exit codes: 0 fine, 1 a law that the scenario expects was broken, 2 bad input.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Run the paper's section V: three scenarios from two starts, table, claims, figures, data.
    ///
    /// Writes figures (SVG, PNG) for each start, every tick and round as Parquet, the scenarios and report.html.
    Paper(Paper),
    /// Run one scenario from a TOML file.
    #[command(after_long_help = RUN_HELP)]
    Run(Run),
    /// Run one scenario under several controllers, same seed, side by side.
    Compare(Compare),
    /// Run thousands of scenarios drawn from one file: one row a run, counts with confidence bounds.
    #[command(after_long_help = sweep::HELP, after_help = "Examples: closeranks sweep --help")]
    Sweep(sweep::Sweep),
    /// Score every controller and every rule of consensus on fixed cases.
    #[command(after_long_help = bench::HELP, after_help = "Examples: closeranks bench --help")]
    Bench(bench::Bench),
    /// Say what is possible for a team: starts, speeds, ticks, F, and what stated errors cost.
    #[command(after_long_help = advise::HELP, after_help = "Examples: closeranks advise --help")]
    Advise(advise::Advise),
    /// Say how many liars a network survives, exactly, with a witness.
    #[command(after_long_help = check::HELP)]
    Check(check::Check),
    /// Show the page in a browser: four acts, and a sandbox that opens with a scenario.
    #[command(after_long_help = view::HELP, after_help = "Examples: closeranks view --help")]
    View(view::View),
    /// Write a graph by name to standard output.
    #[command(after_long_help = maker::HELP, after_help = "Examples: closeranks graph --help")]
    Graph(maker::Make),
}

/// What is said on standard output.
#[derive(Args, Clone, Copy, Debug)]
struct Speech {
    /// Print the numbers as JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Args, Debug)]
struct Paper {
    /// Folder to write to; what the same command wrote there is replaced.
    #[arg(short, long, value_name = "DIR", default_value = "closeranks-out")]
    output: PathBuf,
    /// Record every tick as messages of ROS 2 in FILE.mcap, for Foxglove, Rerun and ros2 bag; each scenario has its name put into that of its file.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Seed of initial values and of what liars say.
    #[arg(long, default_value_t = 1, value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    speech: Speech,
}

#[derive(Args, Debug)]
struct Run {
    /// Scenario, a TOML file; `-` reads standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Folder for figures, data and page; without it only the table is printed.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Record every tick as messages of ROS 2 in FILE.mcap, for Foxglove, Rerun and ros2 bag.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Use this seed instead of the file's.
    #[arg(long, conflicts_with = "draw", value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Use this controller instead of the file's.
    #[arg(long, value_parser = compare::controller(), value_name = "NAME")]
    controller: Option<Controller>,
    /// Of a file that draws values, run number K of the sweep (from 0).
    #[arg(long, value_name = "K", value_parser = invocation::seed, allow_negative_numbers = true)]
    draw: Option<u64>,
    /// Seed of that sweep [default: 1].
    #[arg(long, value_name = "S", requires = "draw", value_parser = invocation::seed, allow_negative_numbers = true)]
    sweep_seed: Option<u64>,
    /// Draw the run in the terminal while it goes on.
    #[arg(long, conflicts_with_all = ["json", "quiet", "print"])]
    live: bool,
    /// How fast: seconds of the run in a second.
    #[arg(long, value_name = "X", requires = "live", default_value_t = 1.0, value_parser = speed)]
    speed: f64,
    /// Print the drawn scenario as plain TOML instead of running it.
    #[arg(long, requires = "draw")]
    print: bool,
    #[command(flatten)]
    speech: Speech,
}

#[derive(Args, Debug)]
struct Compare {
    /// Scenario, a TOML file; `-` reads standard input. Its own controller is replaced.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Which controllers, separated by commas.
    #[arg(long, value_parser = compare::controller(), value_delimiter = ',', default_value = "composed,budget")]
    controllers: Vec<Controller>,
    /// Folder for figures, data and page; without it only the table is printed.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Record every tick as messages of ROS 2 in FILE.mcap, for Foxglove, Rerun and ros2 bag; each controller has its name put into that of its file.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Use this seed instead of the file's.
    #[arg(long, value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: Option<u64>,
    #[command(flatten)]
    speech: Speech,
}

/// Reads how fast a run is shown.
fn speed(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok().filter(|speed| (0.01..=1000.0).contains(speed));
    number.ok_or("allowed is a number from 0.01 to 1000")
}

fn main() -> ExitCode {
    let command = invocation::with_overwrite(Arguments::command());
    let done = match command.clone().try_get_matches() {
        Ok(matches) => {
            invocation::note(&command, &matches);
            Arguments::from_arg_matches(&matches)
                .map_err(Into::into)
                .and_then(|arguments| start(&arguments.command))
        }
        Err(error) => return usage(&error),
    };
    match done.and_then(|good| output::finish().map(|()| good)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => refuse(&error),
    }
}

fn start(command: &Command) -> Result<bool> {
    match command {
        Command::Paper(arguments) => paper::paper(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Compare(arguments) => compare::compare(arguments),
        Command::Sweep(arguments) => sweep::sweep(arguments),
        Command::Bench(arguments) => bench::bench(arguments),
        Command::Advise(arguments) => advise::advise(arguments),
        Command::Check(arguments) => check::check(arguments),
        Command::View(arguments) => view::view(arguments),
        Command::Graph(arguments) => maker::make(arguments),
    }
}

fn refuse(error: &anyhow::Error) -> ExitCode {
    output::complain(error);
    ExitCode::from(2)
}

/// Shows help, the version, or what is wrong with the command line.
fn usage(error: &clap::Error) -> ExitCode {
    output::keep(error.print());
    match output::finish() {
        Ok(()) => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2)),
        Err(error) => refuse(&error),
    }
}
