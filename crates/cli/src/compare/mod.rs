//! `closeranks compare FILE`: the same scenario and seed under several controllers, side by side.

mod saved;

use std::path::PathBuf;

use anyhow::{Result, anyhow, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use closeranks_report::comparison::comparison;
use closeranks_report::table::{Line, text};
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::any::AnyWorld;
use closeranks_sim::world::{Options, Run};
use rayon::prelude::*;
use serde_json::Value;

use crate::as_run::as_run;
use crate::folder::Folder;
use crate::results::recorder::Recorder;
use crate::results::tape::{self, Tape, Target};
use crate::{json, output, progress, sentences, source};

/// Reads a controller by its name in scenario files.
pub(crate) fn controller() -> impl TypedValueParser<Value = Controller> {
    let names = Controller::ALL
        .iter()
        .map(|controller| PossibleValue::new(controller.name()).help(controller.row().about));
    PossibleValuesParser::new(names)
        .try_map(|name| Controller::named(&name).ok_or("no controller has that name"))
}

/// A finished run.
struct Done {
    /// Named after its controller.
    scenario: Scenario,
    /// The scenario as it was run, TOML.
    source: String,
    run: Run,
    wall_s: f64,
    /// What a robot-step takes, µs: [`step_us`].
    step_us: f64,
    /// Where it was recorded.
    recorded: Option<PathBuf>,
}

/// Ticks that are timed, and how often.
const TIMED: (u32, usize) = (100, 5);

/// Time of a tick over the robots in it, µs: the median of a few short runs, of which nothing is recorded. It is measured here and now, and
/// holds whatever the simulation does of a tick: sensing, messages, liars and monitors too.
fn step_us(scenario: &Scenario) -> Result<f64> {
    let (ticks, times) = TIMED;
    let ticks = ticks.min(scenario.ticks().saturating_add(1));
    let time = || -> Result<f64> {
        let mut world = AnyWorld::new(scenario, Options { without_phi: true, ..Options::default() })?;
        let ((), time) = progress::timed(|| (0..ticks).for_each(|_| world.step()));
        Ok(time.as_secs_f64() * 1e6 / (f64::from(ticks) * f64::from(scenario.team.robots)))
    };
    let mut all = (0..times).map(|_| time()).collect::<Result<Vec<f64>>>()?;
    all.sort_by(f64::total_cmp);
    Ok(all[times / 2])
}

/// Runs the scenario once a controller; false when a law that it expects was broken under one of them.
pub(crate) fn compare(arguments: &crate::Compare) -> Result<bool> {
    let (scenario, source) = source::scenario(&arguments.file)?;
    let scenario = Scenario { seed: arguments.seed.unwrap_or(scenario.seed), ..scenario };
    let repeated = |index: usize| arguments.controllers[..index].contains(&arguments.controllers[index]);
    if (0..arguments.controllers.len()).any(repeated) {
        let names: Vec<&str> = Controller::ALL.iter().map(|controller| controller.name()).collect();
        bail!("`--controllers` names one twice; allowed is each of {} once", names.join(", "));
    }
    let mut folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    let mut todo = Vec::new();
    for controller in &arguments.controllers {
        let record = arguments.record.as_deref();
        let target = record.map(|file| Target::of(file, controller.name())).transpose()?;
        todo.push((Todo::new(&scenario, &source, *controller, folder.as_mut())?, target));
    }
    let todo = todo.into_iter().map(|(todo, target)| todo.recorded(target.as_ref()));
    let todo = todo.collect::<Result<Vec<Todo>>>()?;
    let bar =
        progress::bar(arguments.controllers.len() as u64, arguments.speech.quiet || arguments.speech.json);
    let runs = todo.into_par_iter().map(|todo| {
        let done = todo.run();
        bar.inc(1);
        done
    });
    let mut runs = runs.collect::<Result<Vec<Done>>>()?;
    if !arguments.speech.quiet {
        for done in &mut runs {
            done.step_us = step_us(&done.scenario)?;
        }
    }
    bar.finish_and_clear();
    say(arguments, &runs);
    if let (Some(folder), Some(target)) = (folder, &arguments.output) {
        let files = saved::save(folder, &scenario, &runs)?;
        if !arguments.speech.quiet && !arguments.speech.json {
            output::say(&format!("\nwritten to {}: {files}\n", target.display()));
        }
    }
    if !arguments.speech.quiet && !arguments.speech.json {
        tape::say(runs.iter().filter_map(|done| done.recorded.as_deref()));
    }
    Ok(runs.iter().all(|done| done.run.summary.failures(&done.scenario).next().is_none()))
}

/// A run that is to be done.
struct Todo {
    scenario: Scenario,
    source: String,
    recorder: Option<Recorder>,
    tape: Option<Tape>,
}

impl Todo {
    fn new(
        scenario: &Scenario,
        source: &str,
        controller: Controller,
        folder: Option<&mut Folder>,
    ) -> Result<Self> {
        let source = as_run(source, &scenario.clone().under(controller));
        let named = Scenario { name: controller.name().to_owned(), ..scenario.clone() };
        let scenario = named.under(controller);
        let names = ["", "-rounds"].map(|end| format!("{}{end}.parquet", controller.name()));
        let names = names.each_ref().map(String::as_str);
        let recorder = folder.map(|folder| Recorder::new(folder, names, &scenario, &source)).transpose()?;
        Ok(Self { scenario, source, recorder, tape: None })
    }

    /// Begins its recording, if there is to be one; all are checked before any begins.
    fn recorded(self, target: Option<&Target>) -> Result<Self> {
        let tape = target.map(|target| Tape::new(target, &self.scenario, &self.source)).transpose()?;
        Ok(Self { tape, ..self })
    }

    fn run(self) -> Result<Done> {
        let Self { scenario, source, recorder, mut tape } = self;
        let options = Options { robustness: true, ..Options::default() };
        let (run, time) = progress::timed(|| match recorder {
            Some(recorder) => recorder.run(&scenario, &mut |_| (), &mut tape::record(&mut tape)),
            None => tape::run(&scenario, options, &mut |_| (), &mut tape::record(&mut tape)),
        });
        let run = run.map_err(|error| {
            can_run(&scenario).map_or(anyhow!("{error}"), |names| anyhow!("{error}; {names}"))
        })?;
        let recorded = tape.map(Tape::finish).transpose()?;
        Ok(Done { run, source, scenario, wall_s: time.as_secs_f64(), step_us: f64::NAN, recorded })
    }
}

/// Which controllers can run a scenario that one of them can't; `None` if no other one can either.
fn can_run(scenario: &Scenario) -> Option<String> {
    let runs = |controller: &&Controller| {
        AnyWorld::new(&scenario.clone().under(**controller), Options::default()).is_ok()
    };
    let names: Vec<&str> = Controller::ALL.iter().filter(runs).map(|controller| controller.name()).collect();
    (!names.is_empty()).then(|| format!("`--controllers` can name {}", names.join(", ")))
}

impl Done {
    fn line(&self) -> Line<'_> {
        let Self { scenario, run, wall_s, .. } = self;
        Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s: Some(*wall_s) }
    }
}

fn lines(runs: &[Done]) -> Vec<Line<'_>> {
    runs.iter().map(Done::line).collect()
}

fn say(arguments: &crate::Compare, runs: &[Done]) {
    if arguments.speech.json {
        let all: Vec<_> = runs.iter().map(object).collect();
        output::say(&json::text(&serde_json::json!({ "runs": all })));
    } else if !arguments.speech.quiet {
        let steps_us: Vec<f64> = runs.iter().map(|done| done.step_us).collect();
        output::say(&text(&comparison(&lines(runs), Some(&steps_us))));
        output::say(NOTE);
        for done in runs {
            let laws = sentences::laws(&done.scenario, &done.run.summary);
            output::say(&format!(
                "\n{}\n{}\n{laws}",
                done.scenario.name,
                sentences::start(&done.scenario, &done.run.summary)
            ));
            for note in sentences::notes(&done.scenario, &done.run.summary) {
                output::say(&format!("\n{note}"));
            }
        }
    }
}

/// What the heads of the table do not say.
const NOTE: &str = "
degree, h, progress, off wish (deviation from the desired velocity), blocked and
jerk are of normal robots; robot-step is the time of a simulated tick over its
robots, measured here and now: compare it within this table alone
";

/// The numbers of a controller.
fn object(done: &Done) -> Value {
    let mut object = json::run(&done.scenario, &done.run, done.wall_s);
    let row = done.scenario.controller.row();
    object["controller"] = row.name.into();
    object["needs_to_know"] = row.needs.into();
    object["robot_step_us"] = serde_json::json!(done.step_us);
    object
}
