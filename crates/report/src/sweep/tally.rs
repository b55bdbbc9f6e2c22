//! Counts over all rows of a sweep.

use std::collections::BTreeMap;

use closeranks_sim::scenario::Controller;
use closeranks_sim::sweep::Field;

use super::entry::{BROKEN, column};
use super::rows::{Rows, Values};

/// Violating runs of each controller that are shown.
const SHOWN: usize = 3;

/// Columns with the robots of a violation.
const ROBOTS: [&str; 2] = ["first_robot", "first_other_robot"];

/// A field with more values than this is not counted by value.
const FEW: usize = 24;

/// What one controller came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Share {
    /// Runs.
    pub runs: u64,
    /// Runs in which a law was violated.
    pub violating: u64,
    /// Runs in which each law was violated, by its name.
    pub laws: BTreeMap<String, u64>,
    /// Runs in which each law that was looked at was broken at all, whether or not anything promised it.
    pub broken: BTreeMap<String, u64>,
    /// Sum of the radii of gyration at the end, in the order of rows, m.
    pub gyration_sum_m: f64,
    /// Least and greatest of them, m.
    pub gyration_m: Option<[f64; 2]>,
}

/// Runs, and violating runs.
pub type Count = [u64; 2];

/// Counts of a field: by value, then by controller.
pub type ByValue = BTreeMap<String, BTreeMap<String, Count>>;

/// A violating run.
#[derive(Clone, Debug, PartialEq)]
pub struct Violating {
    /// Its number, from 0.
    pub run: i64,
    /// Under which controller.
    pub controller: String,
    /// The law that was violated first.
    pub law: String,
    /// When, s.
    pub time_s: Option<f64>,
    /// The robot or the two robots it is about.
    pub robots: Vec<i64>,
    /// What was seen.
    pub seen: Option<f64>,
    /// What was demanded.
    pub demanded: Option<f64>,
}

/// Counts over rows, which come in the order of runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// By controller.
    pub controllers: BTreeMap<String, Share>,
    /// By field of few values, where no more than 24 were seen.
    pub fields: BTreeMap<String, Option<ByValue>>,
    /// The first violating runs of each controller.
    pub violating: Vec<Violating>,
    /// Runs.
    pub runs: u64,
    /// Draws that could not be run.
    pub redraws: u64,
    last: Option<i64>,
}

impl Share {
    /// Mean radius of gyration at the end, m.
    #[must_use]
    pub fn gyration_mean_m(&self) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "sweeps are far below 2^53 runs")]
        let runs = self.runs as f64;
        (self.runs > 0).then_some(self.gyration_sum_m / runs)
    }

    fn add(&mut self, violated: Option<&str>, gyration: Option<f64>) {
        self.runs += 1;
        self.violating += u64::from(violated.is_some());
        for law in violated.into_iter().flat_map(|laws| laws.split(',')) {
            *self.laws.entry(law.to_owned()).or_default() += 1;
        }
        if let Some(gyration) = gyration {
            self.gyration_sum_m += gyration;
            let [least, greatest] = self.gyration_m.unwrap_or([gyration; 2]);
            self.gyration_m = Some([least.min(gyration), greatest.max(gyration)]);
        }
    }
}

impl Tally {
    /// Columns that [`Tally::add`] needs besides the fields.
    pub const COLUMNS: [&'static str; 11] = [
        "run",
        "controller",
        "redraws",
        "violated",
        "gyration_m",
        "first_law",
        "first_time_s",
        "first_robot",
        "first_other_robot",
        "first_seen",
        "first_demanded",
    ];

    /// Nothing counted yet; of `fields` those with few values are.
    #[must_use]
    pub fn new(fields: &[Field]) -> Self {
        let few = fields.iter().filter(|field| field.few);
        let fields = few.map(|field| (column(field), Some(ByValue::new())));
        Self { fields: fields.collect(), ..Self::default() }
    }

    /// Adds rows.
    pub fn add(&mut self, rows: &Rows) {
        let (runs, redraws) = (rows.whole("run"), rows.whole("redraws"));
        let (controllers, violated) = (rows.text("controller"), rows.text("violated"));
        let gyrations = rows.number("gyration_m");
        for row in 0..rows.count() {
            let name = controllers[row].as_deref().unwrap_or_default();
            let violated = violated[row].as_deref();
            if self.last != runs[row] {
                self.last = runs[row];
                self.runs += 1;
                self.redraws += redraws[row].and_then(|redraws| u64::try_from(redraws).ok()).unwrap_or(0);
            }
            self.controllers.entry(name.to_owned()).or_default().add(violated, gyrations[row]);
            self.note(rows, row, name);
        }
        self.add_broken(rows);
        for (path, values) in &mut self.fields {
            count(values, rows, path);
        }
    }

    fn add_broken(&mut self, rows: &Rows) {
        let columns = rows.heads().iter().zip(rows.columns());
        for (head, column) in columns.filter(|(head, _)| head.name.starts_with(BROKEN)) {
            let Values::Whole(column) = column else { continue };
            let law = &head.name[BROKEN.len()..];
            for (count, name) in column.iter().zip(rows.text("controller")) {
                let Some(count) = count else { continue }; // nobody looked
                let share = self.controllers.entry(name.clone().unwrap_or_default()).or_default();
                *share.broken.entry(law.to_owned()).or_default() += u64::from(*count > 0);
            }
        }
    }

    /// Keeps the first violating runs.
    fn note(&mut self, rows: &Rows, row: usize, controller: &str) {
        let Some(law) = rows.text("first_law")[row].clone() else { return };
        let known = self.violating.iter().filter(|one| one.controller == controller).count();
        if known < SHOWN {
            self.violating.push(Violating {
                run: rows.whole("run")[row].unwrap_or(0),
                controller: controller.to_owned(),
                law,
                time_s: rows.number("first_time_s")[row],
                robots: ROBOTS.iter().filter_map(|column| rows.whole(column)[row]).collect(),
                seen: rows.number("first_seen")[row],
                demanded: rows.number("first_demanded")[row],
            });
        }
    }
}

/// True if sweeps hold the controller `name` to the law.
#[must_use]
pub fn promises(name: &str, law: &str) -> bool {
    let laws = Controller::named(name).map_or(&[][..], |controller| controller.row().promises);
    laws.iter().any(|promised| promised.name() == law)
}

/// Counts the values of one field, until there are too many.
fn count(field: &mut Option<ByValue>, rows: &Rows, path: &str) {
    let (controllers, violated) = (rows.text("controller"), rows.text("violated"));
    for row in 0..rows.count() {
        let Some(values) = field else { return };
        let Some(value) = shown(rows, path, row) else { continue };
        let by_controller = values.entry(value).or_default();
        let count = by_controller.entry(controllers[row].clone().unwrap_or_default()).or_default();
        count[0] += 1;
        count[1] += u64::from(violated[row].is_some());
        if values.len() > FEW {
            *field = None;
        }
    }
}

fn shown(rows: &Rows, path: &str, row: usize) -> Option<String> {
    let place = rows.heads().iter().position(|head| head.name == path)?;
    match &rows.columns()[place] {
        Values::Text(column) => column[row].clone(),
        Values::Number(column) => column[row].map(|number| number.to_string()),
        Values::Whole(column) => column[row].map(|whole| whole.to_string()),
    }
}
