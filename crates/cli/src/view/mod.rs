//! `closeranks view [FILE]`: the page, served on this machine or written as a static site.

mod serve;
mod site;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use closeranks_report::recording;
use closeranks_sim::scenario::Scenario;

use crate::folder::Folder;
use crate::{output, source};
use site::Site;

/// Shown by `closeranks view --help`.
pub(crate) const HELP: &str = "\
Examples:

    closeranks view                                  the page: four acts, from one liar to a team of your own
    closeranks view scenarios/inside-overstating.toml    its sandbox opens with this scenario
    closeranks view out/run.parquet                  with the scenario that a recorded run carries, run again: the bits are the same
    closeranks view --export site                    files for any web server

The page is a folder of four files that this program holds; it asks for nothing outside of it. It is served to this machine
alone, until Ctrl-C.";

/// Robots that the page shows at most, as its module says too.
const ROBOTS_MAX: u16 = 200;
/// Longest recording that is read, bytes.
const RECORDING_MAX: usize = 1 << 30;
/// What Parquet files begin with.
const PARQUET: &[u8] = b"PAR1";

/// What is shown, and where.
#[derive(Args, Debug)]
pub(crate) struct View {
    /// Scenario, a TOML file, or the run.parquet of a run; `-` reads standard input. Without it the page opens at its beginning.
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Write a static site to DIR, for any web server, instead of serving it.
    #[arg(long, value_name = "DIR", conflicts_with = "port")]
    export: Option<PathBuf>,
    /// Port on this machine; 0 is one that is free.
    #[arg(long, default_value_t = 0)]
    port: u16,
}

/// Serves the page until the program is ended, or writes it.
pub(crate) fn view(arguments: &View) -> Result<bool> {
    let text = arguments.file.as_deref().map(scenario).transpose()?;
    let site = Site::new(text.as_deref());
    match &arguments.export {
        Some(target) => export(target, site)?,
        None => serve::serve(&site, arguments.port)?,
    }
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

/// The text of the scenario of a file, or of the one that a recorded run carries.
fn scenario(file: &Path) -> Result<String> {
    let name = source::name(file);
    if file == Path::new("-") || !begins_as_parquet(file) {
        let (scenario, text) = source::scenario(file)?;
        return check(&name, &scenario).map(|()| text);
    }
    let bytes = source::bytes(file, "recording", RECORDING_MAX)?;
    let read = recording::read(bytes).with_context(|| format!("cannot read the recording `{name}`"))?;
    let Some(text) = read.scenario else {
        bail!("`{name}` carries no scenario: allowed is the run.parquet that `closeranks run -o DIR` writes");
    };
    let (scenario, text) = source::read(&format!("the scenario in {name}"), text)?;
    check(&name, &scenario).map(|()| text)
}

fn begins_as_parquet(file: &Path) -> bool {
    use std::io::Read as _;
    let mut first = [0; PARQUET.len()];
    std::fs::File::open(file).is_ok_and(|mut file| file.read_exact(&mut first).is_ok() && first == *PARQUET)
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
