//! What a run counts for, and how counts become scores.

use closeranks_sim::law::Law;
use closeranks_sim::output::conduct::Conduct;
use closeranks_sim::output::summary::Summary;

/// Laws of which none may be broken at any tick, whatever the controller promises.
const KEPT: [Law; 4] = [Law::Degree, Law::Distance, Law::Interval, Law::Input];

/// A finished run.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    /// The case.
    pub(super) case: &'static str,
    /// What was run in it: a controller, or a rule of consensus.
    pub(super) name: &'static str,
    /// Number of the run, which is its seed.
    pub(super) run: u64,
    /// True if nothing was broken.
    pub(super) kept: bool,
    /// Radius of gyration at the end, m.
    pub(super) width_m: f64,
    /// Rounds until normal values were within 1 of each other; none if they were not at the end.
    pub(super) rounds: Option<u32>,
    /// How normal robots moved.
    pub(super) conduct: Conduct,
}

impl Mark {
    /// What `summary` comes to.
    pub(super) fn new(case: &'static str, name: &'static str, run: u64, summary: &Summary) -> Self {
        let extremes = &summary.extremes;
        Self {
            case,
            name,
            run,
            kept: KEPT.iter().all(|law| summary.broken(*law) == 0),
            width_m: summary.gyration_m,
            rounds: extremes.rounds_to_agree.filter(|_| extremes.spread < 1.0),
            conduct: summary.conduct,
        }
    }
}

/// What some runs come to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Score {
    /// How many there are.
    pub(super) runs: u32,
    /// In how many nothing was broken.
    pub(super) kept: u32,
    /// In how many normal robots agreed inside of what they held at first.
    pub(super) agreed: u32,
    width_m: f64,
    rounds: u32,
    /// Sums over all runs, whether or not something was broken in them.
    conduct: [f64; 5],
}

impl Score {
    /// Of all `marks` for which `is_meant` holds.
    pub(super) fn of(marks: &[Mark], is_meant: impl Fn(&Mark) -> bool) -> Self {
        let mut score = Self::default();
        for mark in marks.iter().filter(|mark| is_meant(mark)) {
            score.add(mark);
        }
        score
    }

    fn add(&mut self, mark: &Mark) {
        self.runs += 1;
        let Conduct { progress_m, deviation_m_s, jerk_m_s3, blocked_s, deadlocked } = mark.conduct;
        let numbers = [progress_m, deviation_m_s, jerk_m_s3, blocked_s, f64::from(u8::from(deadlocked))];
        self.conduct.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
        if mark.kept {
            self.kept += 1;
            self.width_m += mark.width_m;
            if let Some(rounds) = mark.rounds {
                self.agreed += 1;
                self.rounds += rounds;
            }
        }
    }

    /// Mean width over all runs, m, where a run in which something was broken counts 0.
    pub(super) fn width_m(&self) -> f64 {
        self.width_m / f64::from(self.runs.max(1))
    }

    /// Means over all runs: progress in m, deviation from the wish in m/s, jerk in m/s³, time blocked in s, share of runs that ended in a
    /// deadlock.
    pub(super) fn conduct(&self) -> [f64; 5] {
        self.conduct.map(|sum| sum / f64::from(self.runs.max(1)))
    }

    /// Share of runs in which normal robots agreed.
    pub(super) fn agreed_share(&self) -> f64 {
        f64::from(self.agreed) / f64::from(self.runs.max(1))
    }

    /// Mean rounds to agree in those runs; not a number if there are none.
    pub(super) fn rounds(&self) -> f64 {
        f64::from(self.rounds) / f64::from(self.agreed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_broken_counts_nothing() {
        let conduct = Conduct { progress_m: 2.0, deadlocked: true, ..Conduct::default() };
        let mark = |run, kept, width_m, rounds| Mark {
            case: "task",
            name: "links",
            run,
            kept,
            width_m,
            rounds,
            conduct,
        };
        let marks = [mark(1, true, 2.0, Some(4)), mark(2, false, 9.0, Some(1)), mark(3, true, 1.0, None)];
        let score = Score::of(&marks, |mark| mark.case == "task");
        assert_eq!((score.runs, score.kept, score.agreed), (3, 2, 1));
        assert_eq!((score.width_m(), score.rounds()), (1.0, 4.0));
        assert_eq!(score.conduct(), [2.0, 0.0, 0.0, 0.0, 1.0]);
        assert!(Score::of(&marks, |_| false).rounds().is_nan());
        assert_eq!(Score::of(&marks, |mark| mark.run > 3).width_m(), 0.0);
    }
}
