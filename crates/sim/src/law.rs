//! What a run can be expected to keep, and what became of it.

/// Something that a run can be expected to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Law {
    /// Every normal robot has at least F′ neighbours (thm:rs_robust, thm:cbf-qp a).
    Degree,
    /// No two robots are closer than Δ_d (thm:cbf-qp b).
    Distance,
    /// Values of normal robots stay inside the interval they started in (def:consensus).
    Interval,
    /// In every round the spread of normal values shrinks by 1 − β/2 if degrees hold (thm:rs_robust, Theorem A).
    Agreement,
    /// Every input is finite and in U_i.
    Input,
    /// The global composition φ of the true levels is not negative (eq:composition).
    Composition,
    /// No φ_i is negative (eq:phi_i). Not a theorem: METHOD.md 2.2.
    Shares,
    /// Every program has a solution (seq:qp). Not a theorem either.
    Feasible,
}

impl Law {
    /// All, in the order of reports.
    pub const ALL: [Self; 8] = [
        Self::Degree,
        Self::Distance,
        Self::Interval,
        Self::Agreement,
        Self::Input,
        Self::Composition,
        Self::Shares,
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
            Self::Composition => "global phi >= 0",
            Self::Shares => "phi_i >= 0",
            Self::Feasible => "the program of a robot has a solution",
        }
    }
}

/// Where a law was broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// Tick.
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
    /// Which.
    pub law: Law,
    /// How often it was broken, counted per tick and robot, pair or team.
    pub count: u64,
    /// Where first.
    pub first: Option<Violation>,
}
