//! One row a run and controller: which columns there are and where each comes from.

use closeranks_sim::law::{Law, Verdict};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::sweep::{Drawn, Field};

use super::rows::{Cell, Head, Kind};

/// A column with a number of a run: its name, with the unit, and where it comes from.
pub type Metric = (&'static str, fn(&Summary) -> Option<f64>);

/// Numbers of a run, each a column. A new one is a line.
pub const METRICS: &[Metric] = &[
    ("gyration_m", |run| Some(run.gyration_m)),
    ("degree_min", |run| run.extremes.degree_min.map(f64::from)),
    ("degree_min_malicious", |run| run.extremes.malicious_degree_min.map(f64::from)),
    ("malicious_below_required", |run| Some(f64::from(run.malicious_below))),
    ("h_min", |run| Some(run.extremes.h_min)),
    ("distance_min_m", |run| Some(run.extremes.distance_min_m)),
    ("phi_min", |run| Some(run.extremes.phi_min)),
    ("phi_global_min", |run| Some(run.extremes.phi_global_min)),
    ("spread_end", |run| Some(run.extremes.spread)),
    ("rounds_to_agree", |run| run.extremes.rounds_to_agree.map(f64::from)),
    ("start_inside", |run| Some(f64::from(u8::from(run.start.inside)))),
    ("start_h_min", |run| Some(run.start.h_min)),
    ("start_degree_min", |run| Some(f64::from(run.start.degree_min))),
    ("start_distance_min_m", |run| Some(run.start.distance_min_m)),
    ("distance_to_malicious_m", |run| run.liar_distance_m),
    ("links_end", |run| Some(f64::from(run.links))),
    ("speed_end_m_s", |run| Some(run.speed_end_m_s)),
    ("spreading_start_m_s", |run| Some(run.spreading_m_s[0])),
    ("spreading_end_m_s", |run| Some(run.spreading_m_s[1])),
    ("guaranteed_share", |run| Some(run.guaranteed_share)),
    ("negative_share", |run| Some(run.negative_share)),
    ("covered_share", |run| Some(run.covered_share)),
    ("recovery_s", |run| Some(run.recovery_s)),
    ("rounds", |run| Some(f64::from(run.rounds))),
    ("ticks", |run| Some(f64::from(run.ticks))),
];

/// How the names of columns begin that count how often a law was broken.
pub(crate) const BROKEN: &str = "broken_";

/// Name of the column that counts how often `law` was broken.
#[must_use]
pub fn broken(law: Law) -> String {
    format!("{BROKEN}{}", law.name())
}

/// Columns before the drawn fields.
const NAMES: [(&str, Kind); 4] =
    [("run", Kind::Whole), ("controller", Kind::Text), ("seed", Kind::Whole), ("redraws", Kind::Whole)];

/// Columns after the counts of laws.
const OUTCOME: [(&str, Kind); 8] = [
    ("violations", Kind::Whole),
    ("violated", Kind::Text),
    ("first_law", Kind::Text),
    ("first_time_s", Kind::Number),
    ("first_robot", Kind::Whole),
    ("first_other_robot", Kind::Whole),
    ("first_seen", Kind::Number),
    ("first_demanded", Kind::Number),
];

/// A finished run of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// Its number, from 0.
    pub run: u64,
    /// Draws before it that could not be run.
    pub redraws: u32,
    /// The drawn fields.
    pub drawn: &'a [Option<Drawn>],
    /// What was run.
    pub scenario: &'a Scenario,
    /// What it came to.
    pub summary: &'a Summary,
}

/// The name of the column of a drawn field: its own, with `.choose` after it where another column has that name. So is a
/// whole table `controller` that is chosen, because readers of Parquet refuse two columns of one name.
#[must_use]
pub fn column(field: &Field) -> String {
    let mut taken =
        NAMES.iter().chain(&OUTCOME).map(|(name, _)| *name).chain(METRICS.iter().map(|(name, _)| *name));
    let is_taken = taken.any(|name| name == field.path);
    if is_taken { format!("{}.choose", field.path) } else { field.path.clone() }
}

/// All columns of a sweep with these drawn fields: `run`, `controller`, `seed`, `redraws`; the fields by their names; every
/// metric; `broken_<law>`, how often each law was broken, whether or not what it rests on held; `violations`, how often those that count
/// were broken although it held; `violated`, these
/// laws separated by commas; `first_...`, the first violation. Cells are null where there is nothing to say.
#[must_use]
pub fn heads(fields: &[Field]) -> Vec<Head> {
    let named = |columns: &[(&str, Kind)]| {
        columns.iter().map(|(name, kind)| Head::new(*name, *kind)).collect::<Vec<Head>>()
    };
    let mut heads = named(&NAMES);
    heads.extend(
        fields
            .iter()
            .map(|field| Head::new(column(field), if field.number { Kind::Number } else { Kind::Text })),
    );
    heads.extend(METRICS.iter().map(|(name, _)| Head::new(*name, Kind::Number)));
    heads.extend(Law::ALL.iter().map(|law| Head::new(broken(*law), Kind::Whole)));
    heads.extend(named(&OUTCOME));
    heads
}

impl Entry<'_> {
    /// The row, a cell a column of [`heads`].
    #[must_use]
    pub fn cells(&self) -> Vec<Option<Cell>> {
        let mut cells = vec![
            whole(self.run),
            Some(text(self.scenario.controller.name())),
            whole(self.scenario.seed),
            whole(self.redraws.into()),
        ];
        cells.extend(self.drawn.iter().map(|drawn| drawn.as_ref().map(cell)));
        cells.extend(METRICS.iter().map(|(_, metric)| metric(self.summary).map(Cell::Number)));
        cells.extend(
            Law::ALL.iter().map(|law| whole(self.summary.broken(*law)).filter(|_| self.is_watched(*law))),
        );
        cells.extend(self.outcome());
        cells
    }

    /// Sweeps leave out what the controller has no use for.
    fn is_watched(&self, law: Law) -> bool {
        self.scenario.controller.watches(law)
    }

    fn outcome(&self) -> Vec<Option<Cell>> {
        let violations: Vec<Verdict> = self.summary.violations(self.scenario).collect();
        let names: Vec<&str> = violations.iter().map(|verdict| verdict.law.name()).collect();
        let violated = (!names.is_empty()).then(|| text(&names.join(",")));
        let sum = violations.iter().map(|verdict| verdict.count).sum();
        let mut cells = vec![whole(sum), violated];
        cells.extend(self.first(&violations));
        cells
    }

    fn first(&self, violations: &[Verdict]) -> Vec<Option<Cell>> {
        let firsts = violations.iter().filter_map(|verdict| Some((verdict.law, verdict.first?)));
        let Some((law, first)) = firsts.min_by_key(|(_, first)| first.tick) else { return Vec::new() };
        let robot = |number: u16| if number > 0 { whole(number.into()) } else { None };
        vec![
            Some(text(law.name())),
            Some(Cell::Number(f64::from(first.tick) * self.scenario.tick_s())),
            robot(first.robots[0]),
            robot(first.robots[1]),
            Some(Cell::Number(first.seen)),
            Some(Cell::Number(first.demanded)),
        ]
    }
}

fn whole(number: u64) -> Option<Cell> {
    i64::try_from(number).ok().map(Cell::Whole)
}

fn text(text: &str) -> Cell {
    Cell::Text(text.to_owned())
}

fn cell(drawn: &Drawn) -> Cell {
    match drawn {
        Drawn::Number(number) => Cell::Number(*number),
        Drawn::Text(text) => Cell::Text(text.clone()),
    }
}
