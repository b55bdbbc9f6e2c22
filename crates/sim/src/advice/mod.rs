//! From team, radius, speed, tick and stated errors to what is possible under `budget`: which starts, speeds, ticks and F.
//!
//! Every number is what [`closeranks_core`] says of checked settings, and of a start as [`Start`](crate::scenario::start::Start)
//! makes it. Limits are found by halving: so no inequality is written down a second time.
//!
//! | question | where |
//! | --- | --- |
//! | what is asked, and the settings of it | [`question`] |
//! | h of the robots of a start | `level` |
//! | the least, the largest and the best spacing of a patch | [`patch`] |
//! | which F for n, which n for F | [`team`] |
//! | the fastest speed and the longest tick | [`limits`] |
//! | what each stated error costs | [`cost`] |

pub mod cost;
mod halving;
mod level;
pub mod limits;
pub mod patch;
pub mod question;
pub mod team;

use closeranks_core::controller::assume::Assume;
use closeranks_core::equations::link::LinkShape;
use closeranks_core::settings::field::Field;
use closeranks_core::settings::params::ParamsError;
use closeranks_core::settings::range::Allowed;

use crate::advice::cost::Cost;
use crate::advice::limits::Limits;
use crate::advice::patch::Spacings;
use crate::advice::question::Question;
use crate::advice::team::Counts;

/// What is possible.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// If malicious robots obey their rows, and if they move as they like.
    pub fits: [Fit; 2],
    /// Which of the two was asked about: its place in `fits`.
    pub asked: usize,
    /// Speeds and ticks.
    pub limits: Limits,
    /// What each stated error costs by itself, under what was asked about: nothing stated first, all that is stated last.
    pub costs: Vec<Cost>,
}

/// What is possible under one assumption about malicious robots.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Its name in files.
    pub assume: &'static str,
    /// The shape that `budget` gives to links, which every h here is about.
    pub link: LinkShape,
    /// Who counts, and which F and n go together.
    pub counts: Counts,
    /// The spacings of a patch of a lattice.
    pub spacings: Spacings,
}

/// Why there is no advice: a setting is outside its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdviceError {
    /// Which, and what is allowed.
    pub error: ParamsError,
    /// Robots out of range could meet in a tick: how fast and for how long they may go.
    pub too_fast: Option<Limits>,
}

/// The assumptions with their names in files.
const ASSUMPTIONS: [(&str, Assume); 2] = [("obedient", Assume::Obedient), ("free", Assume::Free)];

/// Finds out what is possible.
pub fn advise(question: &Question) -> Result<Advice, AdviceError> {
    match question.scenario.dimension {
        3 => advise_in::<3>(question),
        _ => advise_in::<2>(question),
    }
    .map_err(|error| explained(question, error))
}

fn advise_in<const D: usize>(question: &Question) -> Result<Advice, ParamsError> {
    let asked = question.scenario.budget.assume;
    let fit = |(name, assume)| fit::<D>(name, &question.under(assume));
    let [obedient, free] = ASSUMPTIONS.map(fit);
    let (fits, asked) = ([obedient?, free?], usize::from(asked == Assume::Free));
    let spacing_m = fits[asked].spacings.best.map_or(fits[asked].spacings.least_m, |best| best.spacing_m);
    let costs = cost::costs::<D>(question, spacing_m)?;
    Ok(Advice { fits, asked, limits: limits::of_dimension::<D>(question), costs })
}

fn fit<const D: usize>(assume: &'static str, question: &Question) -> Result<Fit, ParamsError> {
    let params = question.settled().params::<D>()?;
    let (counts, spacings) = (Counts::new::<D>(question, &params), Spacings::new(&params));
    Ok(Fit { assume, link: *params.link(), counts, spacings })
}

/// The error, with what would be slow enough where that is the matter.
fn explained(question: &Question, error: ParamsError) -> AdviceError {
    let below_radius = Allowed::Open(0.0, question.scenario.link.radius_m);
    let too_fast = error.field == Field::DistanceMinM && error.allowed != below_radius;
    AdviceError { error, too_fast: too_fast.then(|| limits::limits(question)) }
}

impl Fit {
    /// True if a patch of the lattice is a start that is certainly inside the safe set.
    #[must_use]
    pub fn exists(&self) -> bool {
        self.spacings.best.is_some()
    }
}

impl Advice {
    /// What is possible under the assumption that was asked about.
    #[must_use]
    pub fn fit(&self) -> &Fit {
        &self.fits[self.asked]
    }
}
