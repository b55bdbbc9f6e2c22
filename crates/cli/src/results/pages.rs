//! What the pages of several commands have in common.

use anyhow::Result;
use closeranks_report::content::{Figure, Link, Listing};
use closeranks_report::numbers::Program;
use closeranks_report::parquet::write;
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::recording::rounds::write_rounds;
use closeranks_report::robustness::{RobustnessSeries, points};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Run, TeamRun};
use closeranks_sweep::PROGRAM;
use rayon::prelude::*;

use crate::folder::Folder;
use crate::results::recorder::metadata;

/// What the figure of exact robustness says, and why it may be below what degrees guarantee.
pub(crate) const ROBUSTNESS: &str = "Exact robustness of the network in every consensus round: largest r for which it is r-robust, \
    and largest F for which it is (F+1, F+1)-robust. All robots count here, malicious ones too, so F_max may fall below what the \
    degrees of normal robots guarantee.";

/// What the figure of formations shows.
pub(crate) const FORMATIONS: &str = "Normal robots are blue circles, malicious ones orange squares; dotted lines are links, orange \
    ones involve a malicious robot. A purple ring: closer to another robot than is allowed.";

/// What the figure of paths shows.
pub(crate) const PATHS: &str = "The way of every robot from its start (small circle), and the least distance of two robots over time; \
    the shaded region is closer than is allowed.";

/// What the figure of a run of many robots shows.
pub(crate) const SWARM: &str = "Start and end: normal robots, coloured by rank if they have one, and malicious ones in orange. Below, values \
    and numbers of neighbours of normal robots over time: all of them, the middle half, and the median.";

/// What the figure of barriers and values shows.
pub(crate) const SERIES: &str = "h_i of every robot, with its number, of the weight that its controller gives to links: normal robots must stay above 0. Values y_i; where they agree \
    early the small panel shows how; what malicious robots say is in orange behind.";

/// The last line of a page.
pub(crate) fn footer(command: &str) -> String {
    let Program { version, commit } = PROGRAM;
    format!("closeranks {version}, commit {commit}: closeranks {command}")
}

/// A figure.
pub(crate) fn figure(caption: &str, svg: String) -> Figure {
    Figure { caption: caption.to_owned(), svg }
}

/// A scenario to be copied.
pub(crate) fn scenario(caption: &str, text: &str) -> Listing {
    Listing { caption: caption.to_owned(), text: text.to_owned() }
}

/// Exact robustness over a run; none if nobody searched, as in teams of more than 128.
pub(crate) fn robustness_of<'a>(
    title: &'a str,
    scenario: &'a Scenario,
    run: &Run,
) -> Option<RobustnessSeries<'a>> {
    let points = points(&run.rounds, scenario.tick_s());
    (!points.is_empty()).then_some(RobustnessSeries { title, faults: scenario.team.faults, points })
}

/// One figure has these curves: the robustness of every round of a run, with a curve for each of several teams.
pub(crate) fn robustness_of_all<'a>(
    title: &'a str,
    scenario: &'a Scenario,
    run: &Run,
) -> Vec<RobustnessSeries<'a>> {
    if scenario.teams.is_empty() {
        return robustness_of(title, scenario, run).into_iter().collect();
    }
    let of = |(team, came): (&'a Scenario, &TeamRun)| {
        let points = points(&came.rounds, scenario.tick_s());
        (!points.is_empty()).then_some(RobustnessSeries {
            title: &team.name,
            faults: team.team.faults,
            points,
        })
    };
    scenario.teams.iter().zip(&run.teams).filter_map(of).collect()
}

/// Adds each figure as SVG and as PNG, and says so.
pub(crate) fn add_figures(
    folder: &mut Folder,
    figures: &[(&str, &str)],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Link>> {
    let pictures = figures.par_iter().map(|(_, svg)| {
        let picture = png(svg, SCALE_200_DPI);
        done();
        picture
    });
    let pictures: Vec<_> = pictures.collect();
    let mut links = Vec::new();
    for ((name, svg), picture) in figures.iter().zip(pictures) {
        folder.add(format!("{name}.svg"), svg.as_bytes());
        folder.add(format!("{name}.png"), picture?);
        links.push(Link::new(format!("{name}.svg"), "this figure to be scaled"));
        links.push(Link::new(format!("{name}.png"), "and for slides, 200 dots an inch"));
    }
    Ok(links)
}

/// Adds the scenario, and unless a recorder wrote them already every tick and every round of a run under the names `stem`, and says
/// what is in them.
pub(crate) fn add_data(
    folder: &mut Folder,
    stem: [&str; 3],
    text: &str,
    scenario: &Scenario,
    run: &Run,
) -> Result<Vec<Link>> {
    let [scenario_file, ticks_file, rounds_file] = stem;
    let metadata = metadata(text, scenario);
    folder.add(scenario_file, text);
    let mut links = vec![Link::new(scenario_file, "the scenario as it was run: closeranks run repeats it")];
    if let Some(record) = &run.record {
        if !folder.has(ticks_file) {
            let mut ticks = Vec::new();
            write(record, &metadata, &mut ticks)?;
            folder.add(ticks_file, ticks);
        }
        links.push(Link::new(ticks_file, "every tick: positions, inputs, degrees, levels, h, phi_i, values"));
    }
    if !run.rounds.is_empty() {
        if !folder.has(rounds_file) {
            let mut rounds = Vec::new();
            write_rounds(&run.rounds, scenario.tick_s(), &metadata, &mut rounds)?;
            folder.add(rounds_file, rounds);
        }
        links.push(Link::new(
            rounds_file,
            "every consensus round: largest r and F, least degree, spread of values",
        ));
    }
    Ok(links)
}

/// The names of links in one line.
pub(crate) fn names(links: &[Link]) -> String {
    links.iter().map(|link| link.file.as_str()).collect::<Vec<_>>().join(", ")
}
