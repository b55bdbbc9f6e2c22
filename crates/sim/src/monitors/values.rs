//! Values of normal robots from round to round: they stay between those of the start, and come closer.

use std::sync::Arc;

use crate::law::{Law, Violation};
use crate::monitors::agreement::Agreement;
use crate::monitors::heard::Met;
use crate::monitors::rule::Rule;

/// Rounds in which what was heard in a void one may be taken up: clocks and messages may be a round late.
const VOID_ROUNDS: u32 = 3;

/// What became of the values of a run.
#[derive(Clone, Debug)]
pub(super) struct Values {
    /// The least and the greatest that they may be; `None` before the first round.
    interval: Option<[f64; 2]>,
    /// Normal robots that were there in the last round; whoever was not may bring a value of its own.
    there: Vec<bool>,
    /// For how many rounds what was heard in a void one may still come.
    void_rounds: u32,
    agreement: Agreement,
}

impl Values {
    /// For the team of `rule`.
    pub(super) fn new(rule: &Arc<Rule>) -> Self {
        Self { interval: None, there: Vec::new(), void_rounds: 0, agreement: Agreement::new(rule) }
    }

    /// Ends a round that came to `met` and left these `values` to all but those `aside`, tells of every law that is broken, and gives the spread of the
    /// values of normal robots.
    pub(super) fn end_round(
        &mut self,
        tick: u32,
        values: &[f64],
        aside: &[bool],
        met: Met,
        mut broke: impl FnMut(Law, Violation),
    ) -> f64 {
        let normal =
            || (1_u16..).zip(values).zip(aside).filter(|(_, aside)| !**aside).map(|(robot, _)| robot);
        let (low, high) = normal().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, value)| {
            (low.min(*value), high.max(*value))
        });
        self.welcome(values, aside);
        let [least, most] = self.widen([low, high], met);
        for (robot, value) in normal().filter(|(_, value)| !(least..=most).contains(*value)) {
            let demanded = if *value < least { least } else { most };
            broke(Law::Interval, Violation { tick, robots: [robot, 0], seen: *value, demanded });
        }
        let (spread, magnitude) = ((high - low).max(0.0), least.abs().max(most.abs()));
        if let Some(demanded) = self.agreement.end_round(spread, magnitude, met)
            && spread > demanded
        {
            broke(Law::Agreement, Violation { tick, robots: [0, 0], seen: spread, demanded });
        }
        spread
    }

    /// Takes in the values that robots bring that were not there in the last round.
    fn welcome(&mut self, values: &[f64], aside: &[bool]) {
        self.there.resize(aside.len(), false);
        for ((there, value), aside) in self.there.iter_mut().zip(values).zip(aside) {
            if let Some([least, most]) = self.interval.as_mut().filter(|_| !*there && !aside) {
                (*least, *most) = (value.min(*least), value.max(*most));
            }
            *there = !aside;
        }
    }

    /// The least and the greatest that values may be from now on: those of the start, and after a void round those that there
    /// are then too. A robot that forgets all returns with the value of its start, and one whose clock differs takes up what it
    /// heard a round or two later.
    fn widen(&mut self, [low, high]: [f64; 2], met: Met) -> [f64; 2] {
        let [least, most] = self.interval.get_or_insert([low, high]);
        self.void_rounds = if met.is_void { VOID_ROUNDS } else { self.void_rounds.saturating_sub(1) };
        if self.void_rounds > 0 {
            (*least, *most) = (low.min(*least), high.max(*most));
        }
        [*least, *most]
    }
}
