//! The table of rules.

use closeranks_core::consensus::Rule as OfRobots;

use super::{
    Consensus, Update, arc_p::ArcP, one_round::OneRound, percolating::Percolating, sliding::Sliding,
    trust::Trust, two_hop::TwoHop,
};

/// How robots make new values out of those that they hear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rule {
    /// [`OfRobots::WMsr`].
    #[default]
    WMsr,
    /// [`OfRobots::TrimmedMean`].
    TrimmedMean,
    /// [`OfRobots::Median`].
    Median,
    /// [`OfRobots::Linear`].
    Linear,
    /// W-MSR over a sliding window of rounds.
    SwMsr,
    /// The adversarial robust consensus protocol, in continuous time.
    ArcP,
    /// W-MSR among those that percolation from leaders reaches.
    BpMsr,
    /// W-MSR over two hops.
    TwoHop,
    /// The mean weighted by given trusts.
    Trust,
}

/// What a rule needs of the graph so that F liars cannot keep normal robots from agreeing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// (F + 1, F + 1)-robust.
    Robust,
    /// The union of the graphs of every window is (2F + 1)-robust.
    JointlyRobust,
    /// F + ⌊n/2⌋ neighbours a robot are enough; what is necessary is not known.
    Degrees,
    /// Strongly (2F + 1)-robust with respect to the leaders.
    FromLeaders,
    /// (F + 1, F + 1)-robust with two hops.
    RobustInTwoHops,
    /// Connected among those who are trusted, all of whom must be honest: the graph alone does not say.
    Trusted,
    /// No liars, and connected.
    NoLiars,
    /// Nobody knows a condition.
    Unknown,
}

/// What is known of a rule.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its name in scenario files.
    pub name: &'static str,
    /// What it needs of the graph.
    pub needs: Needs,
    /// Values stay between those that normal robots started with, whatever F liars tell.
    pub keeps_interval: bool,
    of_robots: Option<OfRobots>,
    make: fn(&Consensus, usize) -> Box<dyn Update>,
}

impl Rule {
    /// All, with their names in scenario files.
    pub const ALL: [(&'static str, Self); 9] = [
        ("w-msr", Self::WMsr),
        ("trimmed-mean", Self::TrimmedMean),
        ("median", Self::Median),
        ("linear", Self::Linear),
        ("sw-msr", Self::SwMsr),
        ("arc-p", Self::ArcP),
        ("bp-msr", Self::BpMsr),
        ("two-hop", Self::TwoHop),
        ("trust", Self::Trust),
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Which graphs it needs so that up to F liars cannot keep normal robots from agreeing, in words.
    #[must_use]
    pub fn condition(self) -> &'static str {
        self.row().needs.words()
    }

    /// True if a scenario must say more than its name: leaders, or trusts.
    #[must_use]
    pub fn asks_for_more(self) -> bool {
        matches!(self, Self::BpMsr | Self::Trust)
    }

    /// The rule as a robot of the core runs it, if it does.
    #[must_use]
    pub fn of_robots(self) -> Option<OfRobots> {
        self.row().of_robots
    }

    /// The rule as the world runs it, for a team of so many robots.
    #[must_use]
    pub fn update(self, consensus: &Consensus, robots: usize) -> Box<dyn Update> {
        (self.row().make)(consensus, robots)
    }

    /// What is known of it.
    #[must_use]
    pub fn row(self) -> Row {
        let (name, needs, keeps_interval, of_robots) = match self {
            Self::WMsr => ("w-msr", Needs::Robust, true, Some(OfRobots::WMsr)),
            Self::TrimmedMean => ("trimmed-mean", Needs::Robust, true, Some(OfRobots::TrimmedMean)),
            Self::Median => ("median", Needs::Unknown, false, Some(OfRobots::Median)),
            Self::Linear => ("linear", Needs::NoLiars, false, Some(OfRobots::Linear)),
            Self::SwMsr => ("sw-msr", Needs::JointlyRobust, true, None),
            Self::ArcP => ("arc-p", Needs::Degrees, true, None),
            Self::BpMsr => ("bp-msr", Needs::FromLeaders, true, None),
            Self::TwoHop => ("two-hop", Needs::RobustInTwoHops, true, None),
            Self::Trust => ("trust", Needs::Trusted, false, None),
        };
        Row { name, needs, keeps_interval, of_robots, make: self.maker() }
    }

    fn maker(self) -> fn(&Consensus, usize) -> Box<dyn Update> {
        match self {
            Self::SwMsr => |of, robots| Box::new(Sliding::new(of.window, robots)),
            Self::ArcP => |of, _| Box::new(ArcP::new(of.gain_per_s)),
            Self::BpMsr => |of, robots| Box::new(Percolating::new(&of.leaders, robots)),
            Self::TwoHop => |_, _| Box::new(TwoHop::default()),
            Self::Trust => |of, _| Box::new(Trust::new(&of.trust)),
            Self::WMsr | Self::TrimmedMean | Self::Median | Self::Linear => {
                |of, _| Box::new(OneRound::new(of.rule.of_robots().unwrap_or_default()))
            }
        }
    }
}

impl Needs {
    /// In words, after "needs".
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Robust => "an (F+1,F+1)-robust graph",
            Self::JointlyRobust => "graphs that are (2F+1)-robust jointly over every window",
            Self::Degrees => {
                "F + floor(n/2) neighbours a robot, which are enough; no necessary condition is known to us"
            }
            Self::FromLeaders => "a graph that is strongly (2F+1)-robust from its leaders",
            Self::RobustInTwoHops => "a graph that is (F+1,F+1)-robust with two hops",
            Self::Trusted => {
                "that those who are trusted are honest and connected, which the graph alone does not say"
            }
            Self::NoLiars => "no liars at all, and a connected graph",
            Self::Unknown => "a condition that nobody knows",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back() {
        for (name, rule) in Rule::ALL {
            assert_eq!(rule.name(), name);
            assert!(!rule.row().needs.words().is_empty());
            assert!(rule.of_robots().is_none_or(|known| known.name() == name));
        }
    }
}
