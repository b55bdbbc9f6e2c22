//! The program `closeranks-node`. Exit codes: 0 fine, 1 a law was broken or a process died, 2 bad input or no network.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use closeranks_node::clock::Kind;
use closeranks_node::commands::identity::{self, RosterCommand};
use closeranks_node::commands::robots::{self, Connection};
use closeranks_node::commands::{Failure, doctor};
use closeranks_node::fleet::Options;
use closeranks_node::fleet::tape::Sinks;

/// Robots that keep agreeing while some of them lie, one process each, over Zenoh
#[derive(Debug, Parser)]
#[command(name = "closeranks-node", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Runs one robot until SIGINT or SIGTERM; it stops with a zero velocity
    Run {
        /// File of the robot
        #[arg(long)]
        config: PathBuf,
    },
    /// Runs a robot that lies as a scenario says, for experiments
    Liar {
        /// File of the robot
        #[arg(long)]
        config: PathBuf,
        /// File of the scenario with its table `attack`
        #[arg(long)]
        scenario: PathBuf,
    },
    /// Runs a whole team on this machine, a process a robot, and says whether it held
    Fleet {
        /// File of the scenario, with its table `fleet`
        file: PathBuf,
        /// How long, s, instead of the time in the file
        #[arg(long)]
        duration: Option<f64>,
        /// Seed, instead of the one in the file
        #[arg(long)]
        seed: Option<u64>,
        /// Says the verdict as JSON, and draws no table
        #[arg(long)]
        json: bool,
        /// Records what happens in a new file that ends in .mcap, for Foxglove, Rerun, `ros2 bag` and `closeranks view`
        #[arg(long)]
        record: Option<PathBuf>,
        /// Writes moments as lines of JSON, for `closeranks view --live`; the verdict then goes to standard error, and no table is drawn
        #[arg(long)]
        moments: bool,
        /// Folder for keys, roster, logs and proofs; without it they are thrown away
        #[arg(short, long)]
        out: Option<PathBuf>,
    },
    /// Simulates the bodies of all robots for robots that run elsewhere
    Plant {
        /// File of the scenario
        #[arg(long)]
        scenario: PathBuf,
        /// The signed roster, with the key of a plant
        #[arg(long)]
        roster: PathBuf,
        /// Private key of the plant
        #[arg(long)]
        key: PathBuf,
        /// Whether all processes run on this machine and share its monotonic clock
        #[arg(long)]
        one_machine: bool,
        #[command(flatten)]
        connection: Connection,
    },
    /// A router that loses, delays, reorders and doubles what robots say
    Relay {
        /// File of the scenario with its table `network`
        #[arg(long)]
        scenario: PathBuf,
        #[command(flatten)]
        connection: Connection,
    },
    /// Makes, completes, signs and shows the roster of a team
    #[command(subcommand)]
    Roster(RosterCommand),
    /// Makes a private key on the robot itself and prints the public one for `roster add --key`
    Key {
        /// New file for the private key
        file: PathBuf,
    },
    /// Says who is proved two-faced by a file
    VerifyProof {
        /// File of the proof
        file: PathBuf,
        /// The roster of the team
        #[arg(long)]
        roster: PathBuf,
    },
    /// Goes through everything that a robot needs and says which step fails
    Doctor {
        /// File of the robot
        #[arg(long)]
        config: PathBuf,
    },
}

fn main() -> ExitCode {
    match execute(&Cli::parse().command) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// True if nothing is held against what was done.
fn execute(command: &Command) -> Result<bool, Failure> {
    match command {
        Command::Run { config } => robots::run(config).map(|()| true),
        Command::Liar { config, scenario } => robots::liar(config, scenario).map(|()| true),
        Command::Fleet { file, duration, seed, json, record, moments, out } => {
            let duration_s = allowed(*duration)?;
            let live = !json && !moments;
            let options = Options { duration_s, seed: *seed, folder: out.clone(), live };
            let lines = moments.then(|| Box::new(std::io::stdout()) as Box<dyn std::io::Write>);
            let sinks = Sinks { record: record.clone(), moments: lines };
            let (text, good) = robots::fleet(file, &options, sinks, *json)?;
            if *moments {
                eprintln!("{text}");
            } else {
                print(&text);
            }
            Ok(good)
        }
        Command::Plant { scenario, roster, key, one_machine, connection } => {
            let clock = if *one_machine { Kind::Machine } else { Kind::Wall };
            robots::plant(scenario, roster, key, clock, connection)
        }
        Command::Relay { scenario, connection } => robots::relay(connection, scenario).map(|()| true),
        Command::Roster(command) => identity::roster(command).map(|text| print(&text)).map(|()| true),
        Command::Key { file } => identity::key(file).map(|text| print(&text)).map(|()| true),
        Command::VerifyProof { file, roster } => {
            identity::verify_proof(file, roster).map(|text| print(&text)).map(|()| true)
        }
        Command::Doctor { config } => doctor::doctor(config, &mut |line| print(line)).map(|()| true),
    }
}

fn allowed(duration_s: Option<f64>) -> Result<Option<f64>, Failure> {
    match duration_s {
        Some(seconds) if !(0.1..=86_400.0).contains(&seconds) => {
            Err(format!("--duration is {seconds}, allowed is 0.1 to 86400 s").into())
        }
        other => Ok(other),
    }
}

#[expect(clippy::print_stdout, reason = "what the user asked for")]
fn print(text: &str) {
    println!("{text}");
}
