//! What a run can be expected to keep, and what became of it.

use crate::consensus::Consensus;

/// Something that a run can be expected to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Law {
    /// Every normal robot has at least F′ neighbours (thm:rs_robust, thm:cbf-qp a).
    Degree,
    /// No two robots are closer than Δ_d (thm:cbf-qp b).
    Distance,
    /// Values of normal robots stay inside the interval they started in (def:consensus).
    Interval,
    /// In every round the spread of normal values shrinks by 1 − β/2 if degrees hold (thm:rs_robust, thm:contraction).
    Agreement,
    /// Every input is finite and in U_i.
    Input,
    /// h_i of normal robots is not negative (thm:cbf-qp a, thm:sensed); with free liars h_i counts normal neighbours alone
    /// (thm:free).
    Spare,
    /// No two robots come closer than Δ_d between two ticks (thm:discrete).
    Path,
    /// `budget`: in a tick no h_i loses more than its share γ, no `D − Δ_d²` more than γ_c (thm:discrete).
    Decay,
    /// `budget`: no robot calls something guaranteed that does not hold, or reports of its degree and of h what is not so where it
    /// senses exactly, and every robot says "guaranteed" again soon after
    /// everything holds.
    Mode,
    /// `budget`: a normal robot moves no farther in a tick than it wishes, and than mending its own h and its own distances
    /// takes. So a team that wishes to rest is towed by nobody (sec:recovery).
    Untowed,
    /// `links`: no link that a normal robot counts on is longer than R (thm:held), and who is counted on keeps its row
    /// (lem:counted).
    Held,
    /// No normal robot is nearer to an obstacle than allowed, between ticks too (thm:clear).
    Clear,
    /// The global composition φ of the true levels is not negative (eq:composition).
    Composition,
    /// No φ_i is negative (eq:phi_i). Not a theorem: docs/theory, sec:phi.
    Shares,
    /// Every program has a solution (seq:qp). This is not a theorem either.
    Feasible,
}

impl Law {
    /// True if it is about φ or φ_i, which `budget` does not use.
    #[must_use]
    pub fn is_about_phi(self) -> bool {
        matches!(self, Self::Composition | Self::Shares)
    }

    /// False for what only some rules of consensus keep, and `consensus` does not: nothing is promised then.
    #[must_use]
    pub fn is_kept_by(self, consensus: &Consensus) -> bool {
        match self {
            Self::Interval => consensus.keeps_interval(),
            Self::Agreement => consensus.contracts(),
            _ => true,
        }
    }

    /// True if it is looked at only under a controller that promises it: it is about what the controller says of itself.
    #[must_use]
    pub fn is_own(self) -> bool {
        matches!(self, Self::Decay | Self::Mode | Self::Untowed | Self::Held)
    }

    /// All laws, in the order of reports.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Degree,
        Self::Distance,
        Self::Interval,
        Self::Agreement,
        Self::Input,
        Self::Spare,
        Self::Path,
        Self::Decay,
        Self::Mode,
        Self::Untowed,
        Self::Held,
        Self::Clear,
        Self::Composition,
        Self::Shares,
        Self::Feasible,
    ];

    /// How many laws there are.
    pub const COUNT: usize = 15;

    /// What thm:cbf-qp and thm:rs_robust promise for `composed` from a start in their safe set. That programs have solutions
    /// (c) is counted apart: docs/theory, sec:phi.
    pub const COMPOSED: [Self; 8] = [
        Self::Degree,
        Self::Distance,
        Self::Interval,
        Self::Agreement,
        Self::Input,
        Self::Spare,
        Self::Path,
        Self::Clear,
    ];

    /// What `budget` promises where its assumptions hold.
    pub const PROMISED: [Self; 12] = [
        Self::Degree,
        Self::Distance,
        Self::Interval,
        Self::Agreement,
        Self::Input,
        Self::Spare,
        Self::Path,
        Self::Decay,
        Self::Mode,
        Self::Untowed,
        Self::Clear,
        Self::Feasible,
    ];

    /// What `links` promises where its assumptions hold.
    pub const LINKS: [Self; 12] = [
        Self::Degree,
        Self::Distance,
        Self::Interval,
        Self::Agreement,
        Self::Input,
        Self::Path,
        Self::Decay,
        Self::Mode,
        Self::Untowed,
        Self::Held,
        Self::Clear,
        Self::Feasible,
    ];

    /// What a scenario expects if it says nothing.
    pub const EXPECTED: [Self; 5] =
        [Self::Degree, Self::Distance, Self::Interval, Self::Agreement, Self::Input];

    /// Its name in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Degree => "degree",
            Self::Distance => "distance",
            Self::Interval => "interval",
            Self::Agreement => "agreement",
            Self::Input => "input",
            Self::Spare => "spare",
            Self::Path => "path",
            Self::Decay => "decay",
            Self::Mode => "mode",
            Self::Untowed => "untowed",
            Self::Held => "held",
            Self::Clear => "clear",
            Self::Composition => "composition",
            Self::Shares => "shares",
            Self::Feasible => "feasible",
        }
    }

    /// What it demands, in one line.
    #[must_use]
    pub fn demand(self) -> &'static str {
        match self {
            Self::Degree => "neighbours of a normal robot >= F'",
            Self::Distance => "distance of two robots >= distance_min_m",
            Self::Interval => "value of a normal robot inside the interval of the start",
            Self::Agreement => "spread of normal values shrinks by 1 - beta/2 a round",
            Self::Input => "input inside its box",
            Self::Spare => "h of a normal robot >= 0",
            Self::Path => "distance of two robots between ticks >= distance_min_m",
            Self::Decay => "h and distances lose no more than their fraction in a tick",
            Self::Mode => "guaranteed is said where it is true, and only there",
            Self::Untowed => "a robot moves no more than it wishes and its own needs demand",
            Self::Held => "a link that is counted on has rows, is no longer than radius_m and not cut",
            Self::Clear => "distance of a normal robot to an obstacle >= clearance_m",
            Self::Composition => "global phi >= 0",
            Self::Shares => "phi_i >= 0",
            Self::Feasible => "the program of a robot has a solution",
        }
    }
}

// Verdicts stand in the order of `ALL` and are found by the number of their law.
const _: () = {
    let mut place = 0;
    while place < Law::COUNT {
        assert!(Law::ALL[place] as usize == place, "`Law::ALL` has the order of the variants");
        place += 1;
    }
};

/// Where a law was broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// The tick in which it was broken.
    pub tick: u32,
    /// The robots, from 1; the second where the law is about a pair, 0 where it is about all.
    pub robots: [u16; 2],
    /// What was seen.
    pub seen: f64,
    /// What was demanded.
    pub demanded: f64,
}

/// What became of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Which law.
    pub law: Law,
    /// How often it was broken, counted per tick and robot, pair or team.
    pub count: u64,
    /// Where it was broken first.
    pub first: Option<Violation>,
    /// How often it was broken although everything held that it rests on: the set was safe a tick before, and no assumption
    /// was broken.
    pub covered: u64,
    /// Where that was so first.
    pub first_covered: Option<Violation>,
}

/// What became of every law, in the order of [`Law::ALL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdicts([Verdict; Law::COUNT]);

impl Default for Verdicts {
    fn default() -> Self {
        Self(Law::ALL.map(|law| Verdict { law, count: 0, first: None, covered: 0, first_covered: None }))
    }
}

impl Verdicts {
    /// Notes that `law` was broken, and whether everything held that it rests on.
    pub(crate) fn broke(&mut self, law: Law, violation: Violation, covered: bool) {
        let verdict = &mut self.0[law as usize];
        verdict.count += 1;
        verdict.first.get_or_insert(violation);
        if covered {
            verdict.covered += 1;
            verdict.first_covered.get_or_insert(violation);
        }
    }

    /// What `of` says of each law.
    pub(crate) fn together(of: impl Fn(Law) -> Verdict) -> Self {
        Self(Law::ALL.map(of))
    }

    /// The verdicts on all laws, in order.
    pub fn iter(&self) -> core::slice::Iter<'_, Verdict> {
        self.0.iter()
    }

    /// What became of one law.
    #[must_use]
    pub fn of(&self, law: Law) -> &Verdict {
        &self.0[law as usize]
    }
}

impl<'a> IntoIterator for &'a Verdicts {
    type Item = &'a Verdict;
    type IntoIter = core::slice::Iter<'a, Verdict>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
