//! Many scenarios out of one text, in which values are drawn anew for every run.
//!
//! ```toml
//! [sweep]
//! controllers = ["budget", "composed"]       # every drawn scenario is run under each, with the same seed
//!
//! [team]
//! robots = { draw = [4, 12] }                # a whole number, both ends included
//!
//! [link]
//! q2 = { draw = [0.1, 0.9] }                 # a number; with `log = true` even in the logarithm
//!
//! [attack]
//! level = { choose = [{ kind = "none" }, { kind = "bias", bias = { draw = [-4.0, 4.0] } }], weights = [1, 3] }
//! ```
//!
//! At the top, `choose` takes one of several tables of tables, so that what belongs together is drawn together:
//!
//! ```toml
//! choose = [{ }, { link = { radius_m = 1e-3 }, controller = { distance_min_m = 1e-4 } }]
//! weights = [9, 1]
//! ```
//!
//! A run is a function of text, seed of the sweep and its number alone. Draws are made in the alphabetical order of fields,
//! after the seed of the scenario, which is always drawn. What cannot be run is drawn again from the same stream. A part of a choice that
//! no draw could ever run is a mistake of the text, which is not read then.

mod branches;
mod drawing;
mod reading;
mod tree;

use core::ops::Range;
use std::collections::BTreeMap;

use toml::Value;
use toml::de::{DeTable, DeValue};

use crate::parse::value::one_of;
use crate::parse::{self, Files, Problem};
use crate::random::Random;
use crate::scenario::{Controller, Scenario};
pub use drawing::Drawn;
use reading::Reading;
pub use tree::Field;
use tree::Root;

/// A run that could not be drawn in so many tries counts as one that cannot be drawn.
pub const TRIES: u32 = 1_000;

/// Seeds of scenarios are below this, so that every reader of numbers takes them for whole.
const SEEDS: u64 = 1 << 53;

/// A text with draws, read.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    root: Root,
    controllers: Vec<Controller>,
    places: BTreeMap<String, Range<usize>>,
    fields: Vec<Field>,
    files: Files,
}

/// A drawn run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The scenario under each controller, in alphabetical order, with its plain text.
    pub scenarios: Vec<(Scenario, String)>,
    /// What each of [`Plan::fields`] has in this run; `None` where the chosen branch does not have the field.
    pub drawn: Vec<Option<Drawn>>,
    /// How many draws before this one could not be run.
    pub redraws: u32,
}

impl Run {
    /// The text of the scenario under `controller`. If the run has none under it, it is the first one's text with this
    /// controller in it, which perhaps cannot be run.
    #[must_use]
    pub fn under(&self, controller: Controller) -> String {
        let has_it = |(scenario, _): &&(Scenario, String)| scenario.controller == controller;
        if let Some((_, text)) = self.scenarios.iter().find(has_it) {
            return text.clone();
        }
        let values = self.scenarios.first().and_then(|(_, text)| text.parse().ok()).unwrap_or_default();
        with_controller(&values, controller).to_string()
    }
}

/// Whether `text` is TOML that draws: such a text is for [`Plan::read`], not for [`parse::scenario`].
#[must_use]
pub fn is_drawn(text: &str) -> bool {
    parse::table(text).is_ok_and(|table| reading::is_drawn(table.get_ref()))
}

impl Plan {
    /// Reads a text with draws, or says everything that is malformed in them.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        Self::read_with(text, &Files::default())
    }

    /// Reads a text with draws that names `files` beside it. Scenarios that are drawn have their rows in their own texts.
    pub fn read_with(text: &str, files: &Files) -> Result<Self, Vec<Problem>> {
        let table = parse::table(text)?;
        let mut reading = Reading::default();
        let root = reading.root(table.get_ref());
        let controllers = controllers(&mut reading, table.get_ref());
        let fields = root.fields();
        forbid(&mut reading, &fields, "seed", "left out: the seed of every run is drawn");
        if !controllers.is_empty() {
            forbid(&mut reading, &fields, "controller.kind", "a fixed one beside `sweep.controllers`");
        }
        reading.problems.sort_by_key(|problem| problem.span.start);
        if !reading.problems.is_empty() {
            return Err(reading.problems);
        }
        let (fields, files) = (fields.into_values().collect(), files.clone());
        let plan = Self { root, controllers, places: reading.places, fields, files };
        let problems = plan.never_read();
        if problems.is_empty() { Ok(plan) } else { Err(problems) }
    }

    /// Every drawn field, in alphabetical order.
    #[must_use]
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// Controllers of the table `sweep`, in alphabetical order; empty if every scenario keeps its own.
    #[must_use]
    pub fn controllers(&self) -> &[Controller] {
        &self.controllers
    }

    /// The run with number `run`, counted from 0, of the sweep with `seed`.
    ///
    /// Fails if none of 1,000 draws could be run; the problems are those of the last, at their places in the text.
    pub fn draw(&self, seed: u64, run: u64) -> Result<Run, Vec<Problem>> {
        let mut random = Random::of_run(seed, run);
        let mut problems = Vec::new();
        for redraws in 0..TRIES {
            let scenario_seed = random.below(SEEDS);
            let (mut values, mut drawn) = drawing::draw(&self.root, &mut random);
            values.insert("seed".into(), Value::Integer(scenario_seed.cast_signed()));
            match self.scenarios(&values) {
                Ok(scenarios) => {
                    let drawn = self.fields.iter().map(|field| drawn.remove(&field.path)).collect();
                    return Ok(Run { scenarios, drawn, redraws });
                }
                Err(found) => problems = found,
            }
        }
        for problem in &mut problems {
            problem.span = self.place(&problem.field);
        }
        Err(problems)
    }

    /// The scenario under each controller. If one of them cannot be run, none is.
    fn scenarios(&self, values: &toml::Table) -> Result<Vec<(Scenario, String)>, Vec<Problem>> {
        let read = |values: &toml::Table| {
            let text = values.to_string();
            let scenario = parse::scenario_with(&text, &self.files)?;
            Ok((scenario, parse::inlined(&text, &self.files)))
        };
        if self.controllers.is_empty() {
            return Ok(vec![read(values)?]);
        }
        let under = |controller: &Controller| read(&with_controller(values, *controller));
        self.controllers.iter().map(under).collect()
    }

    /// Where a field stands, or the nearest table around it.
    fn place(&self, field: &str) -> Range<usize> {
        let mut path = field;
        loop {
            if let Some(place) = self.places.get(path) {
                return place.clone();
            }
            let Some(end) = path.rfind(['.', '[']) else { return 0..0 };
            path = &path[..end];
        }
    }
}

fn with_controller(values: &toml::Table, controller: Controller) -> toml::Table {
    let mut values = values.clone();
    let table = values.entry("controller").or_insert_with(|| Value::Table(toml::Table::new()));
    if let Value::Table(table) = table {
        table.insert("kind".into(), Value::String(controller.name().into()));
    }
    values
}

/// The controllers that the table `sweep` names, in alphabetical order.
fn controllers(reading: &mut Reading, root: &DeTable<'_>) -> Vec<Controller> {
    let Some(value) = root.get("sweep") else { return Vec::new() };
    let DeValue::Table(table) = value.get_ref() else {
        reading.refuse("sweep", value, "a table");
        return Vec::new();
    };
    reading.close("sweep", table, &["controllers"]);
    let Some(list) = table.get("controllers") else { return Vec::new() };
    let of = |item: &DeValue<'_>| item.as_str().and_then(Controller::named);
    let items = list.get_ref().as_array().into_iter().flat_map(|items| items.iter());
    let found: Option<Vec<Controller>> = items.map(|item| of(item.get_ref())).collect();
    let mut found = found.unwrap_or_default();
    found.sort_unstable_by_key(|controller| controller.name());
    let repeated = found.windows(2).any(|pair| pair[0] == pair[1]);
    if found.is_empty() || repeated {
        let names = one_of(Controller::ALL.iter().map(|controller| controller.name()));
        reading.refuse("sweep.controllers", list, &format!("a list of {names}, each at most once"));
    }
    found
}

/// Refuses that `field` is drawn.
fn forbid(reading: &mut Reading, fields: &BTreeMap<String, Field>, field: &str, allowed: &str) {
    if fields.contains_key(field) {
        let span = reading.places.get(field).cloned().unwrap_or(0..0);
        let (found, allowed) = ("drawn".to_owned(), allowed.to_owned());
        reading.problems.push(Problem { span, field: field.to_owned(), found, allowed });
    }
}
