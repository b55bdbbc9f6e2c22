//! `closeranks view [FILE]`: the page, served on this machine or written as a static site.

mod moments;
mod serve;
mod site;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use closeranks_report::recording::{self, history::History};
use closeranks_sim::scenario::Scenario;

use crate::folder::Folder;
use crate::{output, source};
use moments::Feed;
use site::{Moments, Shown, Site};

/// Shown by `closeranks view --help`.
pub(crate) const HELP: &str = "\
Examples:

    closeranks view                                  the page: four acts, from one liar to a team of your own
    closeranks view scenarios/inside-overstating.toml    its sandbox opens with this scenario
    closeranks view out/run.parquet                  the recorded run to look at, and its scenario in the sandbox
    closeranks view run.mcap                         the same of a recording for robotics tools
    fleet | closeranks view --live                   a run that others compute, while it goes on: lines of JSON (docs/files.md)
    closeranks view --export site                    files for any web server

The page is a folder of four files that this program holds; it asks for nothing outside of it. It is served to this machine
alone, until Ctrl-C.";

/// Robots that the page shows at most, as its module says too.
const ROBOTS_MAX: u16 = 200;
/// Longest recording that is read, bytes.
const RECORDING_MAX: usize = 1 << 30;
/// What Parquet and MCAP files begin with.
const PARQUET: [u8; 4] = *b"PAR1";
const MCAP: [u8; 4] = *b"\x89MCA";

/// What is shown, and where.
#[derive(Args, Debug)]
pub(crate) struct View {
    /// Scenario, a TOML file, or a recorded run, Parquet or MCAP; `-` reads a scenario from standard input. Without it the page
    /// opens at its beginning.
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Write a static site to DIR, for any web server, instead of serving it.
    #[arg(long, value_name = "DIR", conflicts_with = "port")]
    export: Option<PathBuf>,
    /// Show moments that come as lines of JSON on standard input, while they come.
    #[arg(long, conflicts_with_all = ["file", "export"])]
    live: bool,
    /// Port on this machine; 0 is one that is free.
    #[arg(long, default_value_t = 0)]
    port: u16,
}

/// Serves the page until the program is ended, or writes it.
pub(crate) fn view(arguments: &View) -> Result<bool> {
    if arguments.live {
        return live(arguments.port);
    }
    let shown = arguments.file.as_deref().map(shown).transpose()?.unwrap_or_default();
    let site = Site::new(shown);
    match &arguments.export {
        Some(target) => export(target, site)?,
        None => serve::serve(&site, None, arguments.port)?,
    }
    Ok(true)
}

/// Shows what comes on standard input.
fn live(port: u16) -> Result<bool> {
    let (feed, source) = (Feed::default(), std::io::stdin());
    let (scenario, text) = feed.begin(&mut source.lock())?;
    check("the live source", &scenario)?;
    let site = Site::new(Shown { scenario: Some(text), moments: Moments::Live });
    let live = serve::Live { feed: &feed, source: &source, robots: scenario.team.robots };
    serve::serve(&site, Some(&live), port)?;
    Ok(true)
}

fn export(target: &Path, site: Site) -> Result<()> {
    let mut folder = Folder::new(target)?;
    let names: Vec<&str> = site.files().iter().map(|file| file.name).collect();
    let told = format!("written to {}: {}\n", target.display(), names.join(", "));
    site.into_files().into_iter().for_each(|file| folder.add(file.name, file.bytes));
    folder.write()?;
    output::say(&told);
    Ok(())
}

/// What a file is: a scenario, or a recorded run.
fn shown(file: &Path) -> Result<Shown> {
    let name = source::name(file);
    let Some(read) = reader(file) else {
        let (scenario, text) = source::scenario(file)?;
        check(&name, &scenario)?;
        return Ok(Shown { scenario: Some(text), ..Shown::default() });
    };
    let bytes = source::bytes(file, "recording", RECORDING_MAX)?;
    let history = read(bytes).with_context(|| format!("cannot read the recording `{name}`"))?;
    let (scenario, text) = source::read(&format!("the scenario in {name}"), history.scenario.clone())?;
    check(&name, &scenario)?;
    if usize::from(scenario.team.robots) != history.robots {
        bail!("`{name}` has {} robots, and its scenario {}", history.robots, scenario.team.robots);
    }
    Ok(Shown { scenario: Some(text), moments: Moments::Recorded(history.lines()) })
}

type Reader = fn(Vec<u8>) -> Result<History>;

/// How a recorded run is read, by what its file begins with; none of a file that is something else.
fn reader(file: &Path) -> Option<Reader> {
    use std::io::Read as _;
    if file == Path::new("-") {
        return None;
    }
    let mut first = [0; 4];
    std::fs::File::open(file).ok()?.read_exact(&mut first).ok()?;
    match first {
        PARQUET => Some(|bytes| Ok(recording::read::history(bytes)?)),
        MCAP => Some(|bytes| Ok(recording::mcap::read(&bytes)?)),
        _ => None,
    }
}

/// Refuses what the page cannot show.
fn check(name: &str, scenario: &Scenario) -> Result<()> {
    if scenario.dimension != 2 {
        bail!("`dimension` of `{name}` is {}, allowed on the page is 2", scenario.dimension);
    }
    if scenario.team.robots > ROBOTS_MAX {
        bail!(
            "`team.robots` of `{name}` is {}, allowed on the page is at most {ROBOTS_MAX}",
            scenario.team.robots
        );
    }
    Ok(())
}
