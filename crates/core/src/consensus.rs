//! Rules of consensus: how a robot makes its new value out of its own and of those that it was told.
//!
//! | rule | new value | survives F liars if the graph is | source |
//! | --- | --- | --- | --- |
//! | `w-msr` | [`wmsr::update`]: mean without the F largest above the own and the F smallest below it | (F + 1, F + 1)-robust; (2F + 1)-robust for liars that are F around each robot | the paper; LeBlanc et al. 2013 |
//! | `trimmed-mean` | mean of the own value and of those told without the F largest and F smallest | (F + 1, F + 1)-robust | LeBlanc et al. 2012, Vaidya et al. 2012 |
//! | `median` | the middle of the own value and of those told | no such condition is known to us; each robot needs 2F neighbours to stay among honest values | |
//! | `linear` | plain mean | never: one liar leads all | eq:linear with F = 0 |
//!
//! All of them take values that are not finite for not told, sort `told` in place, and do not depend on the order in which messages
//! came. A scenario chooses one by `consensus.rule`. How fast values come closer is proved of the first two (docs/theory, sec:other-rules).

use crate::wmsr::{self, Round};

/// How a robot makes its new value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rule {
    /// The mean without the F largest of the values above the own one and the F smallest below it.
    #[default]
    WMsr,
    /// The mean of the own value and of those told without the F largest and the F smallest, wherever the own one lies.
    TrimmedMean,
    /// The middle of the own value and of those told; the mean of the two middle ones where their number is even.
    Median,
    /// The plain mean of the own value and of those told.
    Linear,
}

impl Rule {
    /// All, with their names in scenario files.
    pub const ALL: [(&'static str, Self); 4] = [
        ("w-msr", Self::WMsr),
        ("trimmed-mean", Self::TrimmedMean),
        ("median", Self::Median),
        ("linear", Self::Linear),
    ];

    /// The rule's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::WMsr => "w-msr",
            Self::TrimmedMean => "trimmed-mean",
            Self::Median => "median",
            Self::Linear => "linear",
        }
    }

    /// Which graphs it needs so that up to F liars cannot keep normal robots from agreeing, in words.
    #[must_use]
    pub fn condition(self) -> &'static str {
        match self {
            Self::WMsr | Self::TrimmedMean => "an (F+1,F+1)-robust graph",
            Self::Median => {
                "2F neighbours a robot, so that values stay among honest ones; agreement is not known"
            }
            Self::Linear => "no liars at all, and a connected graph",
        }
    }

    /// The new value from the robot's `own` one and those its neighbours `told`, of which up to `faults` are lies.
    ///
    /// `own` must be finite. The answer lies between the least and the greatest value kept.
    #[must_use]
    pub fn update(self, own: f64, told: &mut [f64], faults: u16) -> Round {
        match self {
            Self::WMsr => wmsr::update(own, told, faults),
            Self::Linear => wmsr::update(own, told, 0),
            Self::TrimmedMean => {
                let finite = wmsr::sort_finite(told);
                let each = usize::from(faults).min(finite.len().div_ceil(2));
                let above = each.min(finite.len() - each);
                wmsr::mean_of_kept(own, finite, each, above)
            }
            Self::Median => median(own, wmsr::sort_finite(told)),
        }
    }
}

/// The middle of `own` and of `sorted`.
fn median(own: f64, sorted: &[f64]) -> Round {
    let place = sorted.partition_point(|&value| value <= own);
    let at = |index: usize| match index {
        index if index == place => own,
        index if index < place => sorted[index],
        index => sorted[index - 1],
    };
    let (low, high) = (at(sorted.len() / 2), at(sorted.len().div_ceil(2)));
    let below = sorted.partition_point(|&value| value < low);
    let above = sorted.len() - sorted.partition_point(|&value| value <= high);
    let value = (0.5 * low + 0.5 * high).max(low).min(high);
    Round { value, below, above, low, high, kept: sorted.len() - below - above }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;

    fn value(rule: Rule, own: f64, told: &[f64], faults: u16) -> f64 {
        rule.update(own, &mut told.to_vec(), faults).value
    }

    #[test]
    fn names_lead_back() {
        for (name, rule) in Rule::ALL {
            assert_eq!(rule.name(), name);
            assert!(!rule.condition().is_empty());
        }
        assert_eq!(Rule::default(), Rule::WMsr);
    }

    #[test]
    fn a_table_that_a_person_can_judge() {
        let told = [9.0, 1.0, f64::NAN, 2.0, 3.0];
        let values = |own: f64, faults: u16| Rule::ALL.map(|(_, rule)| value(rule, own, &told, faults));
        // w-msr, trimmed-mean, median, linear
        assert_eq!(values(3.0, 0), [3.6, 3.6, 3.0, 3.6]);
        assert_eq!(values(3.0, 1), [8.0 / 3.0, 8.0 / 3.0, 3.0, 3.6]);
        // Far above all: w-msr discards the least alone, trimmed-mean the greatest too.
        assert_eq!(values(10.0, 1), [6.0, 5.0, 3.0, 5.0]);
        assert_eq!(values(3.0, 2), [3.0, 3.0, 3.0, 3.6]);
        assert_eq!(values(3.0, 9), [3.0, 3.0, 3.0, 3.6]);
        assert_eq!(value(Rule::Median, 1.0, &[4.0], 1), 2.5);
        assert_eq!(value(Rule::Median, 1.0, &[], 1), 1.0);
        assert_eq!(value(Rule::Median, f64::MAX, &[f64::MAX], 1), f64::MAX);
    }

    /// With at most F lies among at least 2F values told, no rule but the plain mean leaves the hull of the honest ones.
    #[test]
    fn lies_do_not_lead_out_of_the_hull_of_honest_values() {
        let mut state = 7_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u16::try_from(state >> 48).unwrap()) / 65536.0
        };
        let mut led = 0;
        for _ in 0..20_000 {
            let faults = 1 + u16::from(draw() > 0.5);
            let honest: Vec<f64> = (0..2 * faults).map(|_| draw()).collect();
            let own = draw();
            let mut told = honest.clone();
            told.extend((0..faults).map(|_| 1e3 * (draw() - 0.5)));
            let low = honest.iter().fold(own, |low, value| low.min(*value));
            let high = honest.iter().fold(own, |high, value| high.max(*value));
            for rule in [Rule::WMsr, Rule::TrimmedMean, Rule::Median] {
                let round = rule.update(own, &mut told.clone(), faults);
                assert!((low..=high).contains(&round.value), "{rule:?} {own} {told:?}");
                assert_eq!(round.below + round.above + round.kept, told.len());
            }
            led += u32::from(!(low..=high).contains(&value(Rule::Linear, own, &told, faults)));
        }
        assert!(led > 10_000);
    }
}
