//! `closeranks bench`: a benchmark with a name and a version, for controllers and for rules of consensus.

mod cases;
mod scores;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use closeranks_report::content::Table;
use closeranks_report::sweep::file::Writer;
use closeranks_report::sweep::rows::{Cell, Head, Kind, Rows};
use closeranks_report::table::{number, text};
use closeranks_sim::scenario::{Consensus, Controller, Rule, Scenario};
use closeranks_sim::world::{self, Options};
use closeranks_sweep::PROGRAM;
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use crate::bench::cases::{Case, VERSION};
use crate::bench::scores::{Mark, Score};
use crate::folder::Folder;
use crate::{Speech, compare, json, output, progress};

/// Longer help.
pub(crate) const HELP: &str = "\
Every controller runs every case from the same starts (seed 1, 2, ...). A run counts its radius of gyration at the end, and 0 if at any
tick a normal robot had too few neighbours, two robots were too close, or a value or a velocity left its bounds. The score of a
controller is the mean over all cases, in metres: how far a team gets without breaking anything.

Every rule of consensus runs against every lie about values. A run counts 1 if normal robots agree inside of what they held at
first.

    closeranks bench                                  # all controllers and rules
    closeranks bench --controllers links,budget       # these alone
    closeranks bench -o out                           # and bench.parquet (one row a run), bench.json

The cases are scenarios/bench/*.toml. Numbers of one version can be compared; the same bits everywhere. How to enter a controller or
a rule of one's own: docs/comparison.md.

Exit codes: 0 fine, 2 bad input.";

#[derive(Args, Debug)]
pub(crate) struct Bench {
    /// Which controllers, separated by commas; by default all.
    #[arg(long, value_parser = compare::controller(), value_delimiter = ',')]
    controllers: Vec<Controller>,
    /// Runs of each case.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    runs: u64,
    /// Folder for bench.parquet and bench.json; without it only the tables are printed.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    speech: Speech,
}

/// Something that is run in every case of its kind.
type Entrant = (&'static str, fn(Scenario, &'static str) -> Scenario);

/// Runs all cases and says the scores.
pub(crate) fn bench(arguments: &Bench) -> Result<bool> {
    let folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    let listed = &arguments.controllers[..];
    let named = listed.first().map_or(Controller::ALL, |_| listed);
    let controllers: Vec<Entrant> = named.iter().map(|one| (one.name(), under as _)).collect();
    let rules: Vec<Entrant> = Rule::ALL.iter().map(|(name, _)| (*name, by_rule as _)).collect();
    let (tasks, lies) = (cases::for_controllers()?, cases::for_rules()?);
    let runs = arguments.runs * (tasks.len() * controllers.len() + lies.len() * rules.len()) as u64;
    let bar = progress::runs(runs, 0, arguments.speech.quiet || arguments.speech.json);
    let run = |cases: &[Case], entrants: &[Entrant]| run_all(cases, entrants, arguments.runs, &|| bar.inc(1));
    let marks = [run(&tasks, &controllers)?, run(&lies, &rules)?];
    bar.finish_and_clear();
    let sheets = [Sheet::new(&tasks, &controllers, &marks[0]), Sheet::new(&lies, &rules, &marks[1])];
    let numbers = numbers(arguments.runs, &sheets);
    say(arguments, &sheets, &numbers);
    if let Some(folder) = folder {
        save(folder, &marks, &numbers)?;
    }
    Ok(true)
}

fn under(scenario: Scenario, name: &'static str) -> Scenario {
    let controller = Controller::named(name);
    controller.map_or(scenario.clone(), |controller| scenario.under(controller))
}

fn by_rule(scenario: Scenario, name: &'static str) -> Scenario {
    let rule = Rule::ALL.iter().find(|(known, _)| *known == name);
    let Some((_, rule)) = rule else { return scenario };
    // Leaders are as many as percolation asks for, liars among them; given trusts are right.
    let leaders = (1..=2 * scenario.team.faults + 1).collect();
    let trust = scenario.malicious_mask().into_iter().map(|lies| if lies { 0.0 } else { 1.0 }).collect();
    Scenario { consensus: Consensus { leaders, trust, ..(*rule).into() }, ..scenario }
}

/// One mark a case, run and entrant, in this order for every number of threads.
fn run_all(cases: &[Case], entrants: &[Entrant], runs: u64, done: &(dyn Fn() + Sync)) -> Result<Vec<Mark>> {
    let all = cases.iter().flat_map(|case| (1..=runs).map(move |run| (case, run)));
    let todo: Vec<(&Case, u64, &Entrant)> =
        all.flat_map(|(case, run)| entrants.iter().map(move |one| (case, run, one))).collect();
    let marks = todo.into_par_iter().map(|(case, run, (name, enter))| {
        let scenario = enter(case.run(run), name);
        let options = Options { without_phi: true, ..Options::default() };
        let finished = world::run(&scenario, options, &mut |_| ())?;
        done();
        Ok(Mark::new(case.name, name, run, &finished.summary))
    });
    marks.collect()
}

/// The scores of one kind of entrants.
struct Sheet<'a> {
    cases: &'a [Case],
    entrants: &'a [Entrant],
    marks: &'a [Mark],
}

impl<'a> Sheet<'a> {
    fn new(cases: &'a [Case], entrants: &'a [Entrant], marks: &'a [Mark]) -> Self {
        Self { cases, entrants, marks }
    }

    fn score(&self, case: &Case, name: &str) -> Score {
        Score::of(self.marks, |mark| mark.case == case.name && mark.name == name)
    }

    /// A cell a case, and their mean in front, for each entrant; the best first.
    fn table(&self, head: &str, digits: usize, number_of: impl Fn(&Score) -> f64) -> Table {
        let mut lines: Vec<(&str, Vec<f64>)> = Vec::new();
        for (name, _) in self.entrants {
            let cells: Vec<f64> = self.cases.iter().map(|case| number_of(&self.score(case, name))).collect();
            lines.push((name, cells));
        }
        lines.sort_by(|one, other| mean(&other.1).total_cmp(&mean(&one.1)));
        let heads = [head, "score"].into_iter().chain(self.cases.iter().map(|case| case.name));
        let rows = lines.into_iter().map(|(name, cells)| {
            let numbers = core::iter::once(mean(&cells)).chain(cells.iter().copied());
            let numbers = numbers.map(|cell| number(cell, digits));
            core::iter::once(name.to_owned()).chain(numbers).collect()
        });
        Table { heads: heads.map(str::to_owned).collect(), rows: rows.collect() }
    }

    /// How robots moved under each entrant in the first case, in the order of entrants.
    fn conduct(&self, head: &str) -> Table {
        let heads = [head, "progress", "deviation", "jerk", "blocked", "deadlock"];
        let first = self.cases.first();
        let rows = self.entrants.iter().map(|(name, _)| {
            let means = first.map_or([f64::NAN; 5], |case| self.score(case, name).conduct());
            let cells = means.into_iter().zip([2, 3, 0, 2, 2]).map(|(mean, digits)| number(mean, digits));
            core::iter::once((*name).to_owned()).chain(cells).collect()
        });
        Table { heads: heads.map(str::to_owned).to_vec(), rows: rows.collect() }
    }

    fn json(&self) -> Value {
        let entrants = self.entrants.iter().map(|(name, _)| {
            let cases = self.cases.iter().map(|case| {
                let score = self.score(case, name);
                let [progress_m, deviation_m_s, jerk_m_s3, blocked_s, deadlocked] = score.conduct();
                let numbers = json!({
                    "runs": score.runs, "kept": score.kept, "agreed": score.agreed,
                    "width_m": score.width_m(), "progress_m": progress_m,
                    "deviation_m_s": deviation_m_s, "jerk_m_s3": jerk_m_s3, "blocked_s": blocked_s, "deadlocked_share": deadlocked,
                    "rounds": Some(score.rounds()).filter(|rounds| rounds.is_finite()),
                });
                (case.name.to_owned(), numbers)
            });
            ((*name).to_owned(), Value::Object(cases.collect()))
        });
        Value::Object(entrants.collect::<Map<_, _>>())
    }
}

fn mean(numbers: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful")]
    let count = numbers.len() as f64;
    numbers.iter().sum::<f64>() / count
}

fn numbers(runs: u64, [controllers, rules]: &[Sheet<'_>; 2]) -> Value {
    json!({
        "bench": VERSION, "runs": runs, "version": PROGRAM.version, "commit": PROGRAM.commit,
        "controllers": controllers.json(), "rules": rules.json(),
    })
}

fn say(arguments: &Bench, [controllers, rules]: &[Sheet<'_>; 2], numbers: &Value) {
    if arguments.speech.json {
        return output::say(&json::text(numbers));
    }
    if arguments.speech.quiet {
        return;
    }
    let (widths, agreed) =
        (controllers.table("controller", 3, Score::width_m), rules.table("rule", 2, Score::agreed_share));
    output::say(&format!(
        "closeranks bench {VERSION}, {} runs of each case\n\n\
         Width at the end, m, mean; a run in which anything was broken counts 0:\n\n{}\n\
         In `task`, whatever was broken: progress along the wish (m), deviation from it (m/s), jerk (m/s^3), time blocked (s), share of\n\
         runs that end with everybody blocked:\n\n{}\n\
         Share of runs in which normal robots agree inside of what they held, against lies:\n\n{}",
        arguments.runs,
        text(&widths),
        text(&controllers.conduct("controller")),
        text(&agreed)
    ));
}

/// Writes one row a run, and the scores.
fn save(mut folder: Folder, marks: &[Vec<Mark>; 2], numbers: &Value) -> Result<()> {
    let heads = [
        ("kind", Kind::Text),
        ("case", Kind::Text),
        ("name", Kind::Text),
        ("run", Kind::Whole),
        ("kept", Kind::Whole),
        ("width_m", Kind::Number),
        ("rounds_to_agree", Kind::Whole),
    ];
    let heads = heads.map(|(name, kind)| Head::new(name, kind));
    let mut rows = Rows::empty(&heads);
    for (kind, marks) in ["controller", "rule"].into_iter().zip(marks) {
        for mark in marks {
            rows.push(cells(kind, mark));
        }
    }
    let mut writer = Writer::new(Vec::new(), &heads, &[("bench", VERSION.to_string())])?;
    writer.add(rows)?;
    folder.add("bench.parquet", writer.finish()?);
    folder.add("bench.json", json::text(numbers));
    folder.write()
}

fn cells(kind: &str, mark: &Mark) -> Vec<Option<Cell>> {
    let whole = |number: u64| i64::try_from(number).ok().map(Cell::Whole);
    vec![
        Some(Cell::Text(kind.to_owned())),
        Some(Cell::Text(mark.case.to_owned())),
        Some(Cell::Text(mark.name.to_owned())),
        whole(mark.run),
        whole(u64::from(mark.kept)),
        Some(Cell::Number(mark.width_m)),
        mark.rounds.and_then(|rounds| whole(rounds.into())),
    ]
}
