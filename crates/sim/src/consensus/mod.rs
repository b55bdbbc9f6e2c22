//! Consensus as a scenario says it: which rule, of how many numbers, and the rules that need more than a robot of
//! [`closeranks_core`] tells.
//!
//! | rule | new value | survives F liars if the graph is | source |
//! | --- | --- | --- | --- |
//! | `w-msr`, `trimmed-mean`, `median`, `linear` | [`closeranks_core::consensus`] | see there | see there |
//! | `sw-msr` | W-MSR over the newest value of everybody heard in the last `window` rounds ([`sliding`]) | (2F + 1)-robust jointly over every window | Saldaña et al. 2017 |
//! | `arc-p` | `ẏ = gain Σ (kept − y)` without the F largest and F smallest ([`arc_p`]) | F + ⌊n/2⌋ neighbours a robot are enough | LeBlanc and Koutsoukos 2012 |
//! | `bp-msr` | W-MSR among those that percolation from leaders reaches ([`percolating`]) | strongly (2F + 1)-robust from the leaders | arXiv 2510.01144 |
//! | `two-hop` | W-MSR over values that came over at most two hops ([`two_hop`]) | (F + 1, F + 1)-robust with two hops | Yuan and Ishii 2021 |
//! | `trust` | mean weighted by trusts that are given ([`trust`]) | connected among those trusted, who are all honest | after Yemini et al. 2022 |
//!
//! *Where values live.* A message of the core holds one number, and stays as it is. A robot of the core runs its own rule on it. The
//! rules of this folder, and values of two or three numbers under any rule, are run by the world ([`exchange`]): the engine says whose
//! messages each robot has in a round, whatever the network did to them, and what these messages would say is held beside
//! them. So a lost message is lost for every rule, and robots on real machines (`closeranks-node`) have the first four alone.
//!
//! *Several numbers* are updated one by one (`combine = "coordinates"`: values stay in the box of the normal ones at the start), or
//! at once by a point that is safe from any F of those told (`combine = "safe-point"`, in the plane: they stay in the
//! hull; [`safe_point`]). In three dimensions there is no safe point here: coordinates are what there is.
//!
//! A new rule is a file with an [`Update`], a variant of [`Rule`] and its row in [`rule`].

pub mod arc_p;
pub mod exchange;
pub mod one_round;
pub mod orientation;
pub mod percolating;
mod read;
pub mod rule;
pub mod safe_point;
pub mod sliding;
pub mod trust;
pub mod two_hop;

use core::fmt::Debug;

pub use rule::{Needs, Rule};

/// How a team agrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Consensus {
    /// The rule.
    pub rule: Rule,
    /// Numbers in a value, 1 to 3.
    pub dimension: usize,
    /// How a robot makes one value of several with more than one number.
    pub combine: Combine,
    /// `sw-msr`: how many rounds a value is remembered for, at least 1.
    pub window: u16,
    /// `arc-p`: how fast a value follows, 1/s.
    pub gain_per_s: f64,
    /// `bp-msr`: the leaders by number, from 1, ascending. All hold the value at which the first of them starts.
    pub leaders: Vec<u16>,
    /// `trust`: how far each robot is trusted by all others, 0 to 1, one number a robot.
    pub trust: Vec<f64>,
}

/// How a robot combines values of several numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Combine {
    /// Each number by itself, by the rule.
    #[default]
    Coordinates,
    /// By a point in the hull of any that are left when F are taken away.
    SafePoint,
}

impl Default for Consensus {
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            dimension: 1,
            combine: Combine::default(),
            window: 5,
            gain_per_s: 1.0,
            leaders: Vec::new(),
            trust: Vec::new(),
        }
    }
}

impl From<Rule> for Consensus {
    fn from(rule: Rule) -> Self {
        Self { rule, ..Self::default() }
    }
}

impl Consensus {
    /// True if robots of the core run the rule themselves.
    #[must_use]
    pub fn is_of_robots(&self) -> bool {
        self.dimension == 1 && self.rule.of_robots().is_some()
    }

    /// True if values of normal robots stay between those that normal robots started with (in their box or hull), whatever F liars tell.
    #[must_use]
    pub fn keeps_interval(&self) -> bool {
        self.combine == Combine::SafePoint || self.rule.row().keeps_interval
    }

    /// True if a theorem says how fast values come closer: `w-msr` and `trimmed-mean`, number by number (docs/theory, sec:other-rules,
    /// which also says why not the others).
    #[must_use]
    pub fn contracts(&self) -> bool {
        self.combine == Combine::Coordinates && matches!(self.rule, Rule::WMsr | Rule::TrimmedMean)
    }
}

/// What everybody was told in a round, of one number of the values.
#[derive(Clone, Copy, Debug)]
pub struct Told<'a> {
    /// F.
    pub faults: u16,
    /// What each robot holds.
    pub own: &'a [f64],
    /// Whom each robot heard, by index, ascending, and what it was told by it.
    pub heard: &'a [Vec<(u16, f64)>],
    /// Who lies. Only for what liars do beyond telling false values: no robot knows.
    pub malicious: &'a [bool],
    /// How long the round took, s; a tick for rules of continuous time.
    pub elapsed_s: f64,
}

/// A rule of consensus for a whole team, one number a robot.
pub trait Update: Debug + Send + Sync {
    /// New values of all robots from what was told.
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]);

    /// True if values change in every tick and not once a round.
    fn is_continuous(&self) -> bool {
        false
    }

    /// Changes what robots hold before the first round.
    fn begin(&mut self, _values: &mut [f64]) {}

    /// The robot forgets all that it was told: it starts again.
    fn forget(&mut self, _robot: usize) {}
}
