//! The theorem of `links` from tick to tick: who is counted on keeps its row (lem:counted), a link that is counted on stays a link
//! (thm:held, thm:cut), and who counts on enough keeps enough.

use std::sync::Arc;

use closeranks_core::num::sqrt;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::geometry::squared_distance;
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::rule::Rule;
use crate::monitors::truth::room_m;
use crate::scenario::Scenario;

/// Links that were counted on when they were no longer than R, and must have been so ever since.
#[derive(Clone, Debug)]
pub(crate) struct Held<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    rule: Arc<Rule>,
    /// For each robot the others, by number, in rising order.
    sound: Vec<Vec<u16>>,
    /// True if that is all on whom normal robots counted in the last tick.
    whole: bool,
    /// Memory for the others of one robot.
    scratch: Vec<u16>,
}

impl<const D: usize> Held<D> {
    /// For the robots of `scenario`.
    pub(crate) fn new(scenario: &Scenario, params: Params<D>, rule: &Arc<Rule>) -> Self {
        let robots = usize::from(scenario.team.robots);
        Self {
            params,
            rule: Arc::clone(rule),
            malicious: scenario.malicious_mask(),
            sound: vec![Vec::new(); robots],
            whole: false,
            scratch: Vec::new(),
        }
    }

    /// Looks at one tick. `moved` is true if all moves since the tick before obeyed the rows, and rows rested on what is
    /// true; `moves` says so of the moves that follow.
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        [moved, moves]: [bool; 2],
        verdicts: &mut Verdicts,
    ) {
        self.whole = false;
        let radius_m = self.params.kept().link.radius_m;
        let (radius_m2, away_m) = (radius_m * radius_m, self.params.kept().errors.away_m);
        for (index, counted) in frame.counted.iter().enumerate() {
            if self.malicious[index] {
                continue;
            }
            let (before, mut sound) =
                (core::mem::take(&mut self.sound[index]), core::mem::take(&mut self.scratch));
            sound.clear();
            for &number in counted.iter().filter(|number| self.binds(**number)) {
                let other = usize::from(number) - 1;
                let own = small(index + 1);
                let pair_m2 = squared_distance(&frame.references_m[index], &frame.references_m[other]);
                let violation =
                    Violation { tick, robots: [own, number], seen: sqrt(pair_m2), demanded: radius_m };
                // Who was pulled beyond R while an assumption was broken may not even be sensed.
                let room_m = room_m(&frame.cutting, &frame.references_m[index], &frame.references_m[other]);
                let is_cut = room_m <= away_m;
                let runs = !self.malicious[other] && !frame.down[other] && pair_m2 <= radius_m2 && !is_cut;
                if runs && frame.rows[other].binary_search(&own).is_err() {
                    verdicts.broke(Law::Held, violation, moved && moves);
                }
                if pair_m2 > radius_m2 || is_cut {
                    let carried = moved && before.binary_search(&number).is_ok();
                    let lacks = Violation { seen: room_m, demanded: away_m, ..violation };
                    verdicts.broke(Law::Held, if is_cut { lacks } else { violation }, carried);
                } else if moves {
                    sound.push(number);
                }
            }
            (self.sound[index], self.scratch) = (sound, before);
        }
    }

    /// Looks at a tick in which nothing is wrong with any of the links on which robots count, and moves obey the rows: some count on others than
    /// in the tick before if they have `relisted`.
    pub(crate) fn glance(&mut self, frame: &Frame<D>, relisted: bool) {
        if core::mem::replace(&mut self.whole, true) && !relisted {
            return;
        }
        let normal = self.sound.iter_mut().zip(&frame.counted).zip(&self.malicious);
        for ((sound, counted), _) in normal.filter(|(_, malicious)| !**malicious) {
            sound.clone_from(counted);
        }
    }

    /// True if a robot of this number keeps its row: all but liars that move as they like.
    fn binds(&self, number: u16) -> bool {
        !(self.rule.is_free() && self.malicious[usize::from(number) - 1])
    }

    /// True if normal robot `index` counts on enough neighbours, so that it keeps enough of those that count.
    pub(crate) fn is_kept(&self, index: usize) -> bool {
        let liars = if self.rule.is_free() { usize::from(self.rule.faults()) } else { 0 };
        self.sound[index].len() + liars >= usize::from(self.rule.keep(index))
    }
}

fn small(number: usize) -> u16 {
    u16::try_from(number).unwrap_or(u16::MAX)
}
