//! Robots that others do not sense although they are within R: what is wrong, and whether anybody can know.

use closeranks_core::num::{Vector, length, subtract};
use closeranks_core::settings::params::Params;

use crate::faults::dropouts::Dropouts;
use crate::geometry::near::small;
use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// Far more than what is rounded of a distance, as a fraction of R.
const HAIR: f64 = 1e-6;
/// Far more than what is rounded of a position, m.
const ROUNDING_M: f64 = 1e-13;

/// Who is sensed in a run, and who is overlooked.
#[derive(Clone, Debug)]
pub struct Sight<const D: usize> {
    dropouts: Dropouts,
    random: Random,
    /// R, less what offsets may be wrong, and how far a robot can go in a tick, as clocks may show it, m.
    radius_m: f64,
    move_m: f64,
    time_s: f64,
    tick: u32,
    /// How each observer sensed others last, in order of their numbers. Empty where nothing is wrong with sensing.
    last: Vec<Vec<(u16, Last<D>)>>,
    position_error_m: f64,
    /// How many robots each observer has within R in this tick.
    near: Vec<u16>,
    /// Observers that do not sense somebody within R, and those that cannot know of somebody there.
    misses: Vec<bool>,
    overlooks: Vec<bool>,
}

/// How a robot was sensed last.
#[derive(Clone, Copy, Debug)]
struct Last<const D: usize> {
    tick: u32,
    /// Where it was, m.
    place: Vector<D>,
    /// True if it was sensed elsewhere, by more than is stated.
    wrong: bool,
}

impl<const D: usize> Sight<D> {
    /// For the robots of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: &Params<D>) -> Self {
        let (dropouts, robots) = (scenario.faults.sensing.dropouts, usize::from(scenario.team.robots));
        // A fast clock shows more time than has passed.
        let stretch = 1.0 + scenario.faults.clocks.drift_max;
        // Only some controllers reckon with everybody whom they do not sense: those that promise anything.
        let reckons = params.controller().promises();
        let sight_m = params.link().radius_m * (1.0 - HAIR) - 2.0 * params.kept().errors.offset_m;
        let whole = scenario.faults.sensing.is_right();
        Self {
            dropouts,
            random: Random::new(scenario.seed, Stream::Dropouts),
            radius_m: if reckons { sight_m } else { 0.0 },
            move_m: params.reach().longest_m() * stretch,
            time_s: 0.0,
            tick: 0,
            last: if whole { Vec::new() } else { vec![Vec::new(); robots] },
            position_error_m: params.settings().errors.position_m + ROUNDING_M,
            near: vec![0; robots],
            misses: vec![false; robots],
            overlooks: vec![false; robots],
        }
    }

    /// True if everybody within R is always sensed: then nobody else need be asked for.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.last.is_empty()
    }

    /// Begins a tick.
    pub fn begin_tick(&mut self, tick: u32, time_s: f64) {
        (self.tick, self.time_s) = (tick, time_s);
        self.near.fill(0);
        self.misses.fill(false);
        self.overlooks.fill(false);
    }

    /// An observer begins anew and knows nobody.
    pub fn forget(&mut self, observer: usize) {
        self.last.get_mut(observer).into_iter().for_each(Vec::clear);
    }

    /// Whom `observer` sensed and may still know of, in order. Of others who are not within R there is nothing to ask.
    pub fn known(&self, observer: usize) -> impl Iterator<Item = u16> + '_ {
        self.last.get(observer).into_iter().flatten().map(|(index, _)| *index)
    }

    /// Nobody knows any more where the robot `index` was.
    pub fn dismiss(&mut self, index: usize) {
        self.last.iter_mut().for_each(|last| last.retain(|(known, _)| usize::from(*known) != index));
    }

    /// Whether `observer`, at `own`, senses the robot `index`, which is within R or not. Where it does, [`note`](Self::note) is
    /// to be called.
    pub fn senses(&mut self, (observer, own): (usize, &Vector<D>), index: usize, within: bool) -> bool {
        if self.last.is_empty() {
            return within;
        }
        let unseen =
            self.dropouts.unseen.is_some_and(|spell| spell.index() == index && spell.lasts(self.time_s));
        let missed = self.dropouts.missed > 0.0 && self.random.chance(self.dropouts.missed);
        let sensed = within && !unseen && !missed;
        if within {
            self.near[observer] += 1;
            self.overlooks[observer] |= self.dropouts.slots.is_some_and(|slots| self.near[observer] > slots);
        }
        if sensed {
            return true;
        }
        self.misses[observer] |= within;
        let place = self.place(observer, index);
        let last = place.ok().map(|place| self.last[observer][place].1);
        if let Some(last) = last.filter(|last| self.can_be_known(own, last)) {
            // Whoever holds it where it was not is mistaken even if it has left.
            self.overlooks[observer] |= last.wrong;
        } else {
            self.overlooks[observer] |= within;
            if let Ok(place) = place {
                self.last[observer].remove(place);
            }
        }
        false
    }

    /// Where the robot stands among those whom the observer sensed, or where it would.
    fn place(&self, observer: usize, index: usize) -> Result<usize, usize> {
        self.last[observer].binary_search_by_key(&index, |(known, _)| usize::from(*known))
    }

    /// Notes that `observer` senses the robot `index`, which is at `place`, at `sensed`.
    pub fn note(&mut self, (observer, index): (usize, usize), place: &Vector<D>, sensed: &Vector<D>) {
        let wrong = length(&subtract(place, sensed)) > self.position_error_m;
        if self.last.is_empty() {
            return;
        }
        let last = Last { tick: self.tick, place: *place, wrong };
        match self.place(observer, index) {
            Ok(place) => self.last[observer][place].1 = last,
            Err(place) => self.last[observer].insert(place, (small(index), last)),
        }
    }

    /// True if an observer at `own` can tell that a robot must still be within R from when and where it was sensed last. One that
    /// was sensed elsewhere may seem to be for longer.
    fn can_be_known(&self, own: &Vector<D>, last: &Last<D>) -> bool {
        let gone_m = f64::from(self.tick - last.tick) * self.move_m;
        let away_m = if last.wrong { 0.0 } else { length(&subtract(own, &last.place)) };
        away_m + gone_m < self.radius_m
    }

    /// True if `observer` does not sense some robot within R in this tick.
    #[must_use]
    pub fn misses(&self, observer: usize) -> bool {
        self.misses[observer]
    }

    /// True if `observer` cannot know of some robot within R in this tick.
    #[must_use]
    pub fn overlooks(&self, observer: usize) -> bool {
        self.overlooks[observer]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faults::spell::Spell;
    use crate::faults::{Faults, Sensing};
    use crate::scenario::Controller;

    fn sight(dropouts: Dropouts) -> Sight<2> {
        let faults = Faults { sensing: Sensing { dropouts, ..Sensing::default() }, ..Faults::default() };
        let scenario = Scenario { controller: Controller::Budget, faults, ..Scenario::default() };
        Sight::new(&scenario, &scenario.params().unwrap())
    }

    /// Whether robot 1 at the origin senses robot 2 at `place`.
    fn look(sight: &mut Sight<2>, tick: u32, place: Vector<2>) -> bool {
        sight.begin_tick(tick, 0.005 * f64::from(tick));
        let sensed = sight.senses((0, &[0.0; 2]), 1, true);
        if sensed {
            sight.note((0, 1), &place, &place);
        }
        sensed
    }

    #[test]
    fn who_was_well_inside_is_known_for_as_long_as_it_cannot_have_left() {
        let unseen = Some(Spell { robot: 2, from_s: 0.01, to_s: 9.0 });
        let mut sight = sight(Dropouts { unseen, ..Dropouts::default() });
        let mut overlooked = Vec::new();
        for tick in 0..100 {
            let sensed = look(&mut sight, tick, [2.5, 0.0]);
            assert_eq!(sensed, tick < 2);
            overlooked.extend(sight.overlooks(0).then_some(tick));
        }
        // 0.5 m are 47.1 longest moves of 10.6 mm, the last seen tick is 1
        assert_eq!(overlooked.first(), Some(&49));
        sight.forget(0);
        look(&mut sight, 100, [0.5, 0.0]);
        assert!(sight.overlooks(0), "who begins anew knows nobody");
    }

    #[test]
    fn slots_may_be_too_few() {
        let mut sight = sight(Dropouts { slots: Some(2), ..Dropouts::default() });
        sight.begin_tick(0, 0.0);
        let overlooks = [1, 2, 3].map(|index| {
            sight.senses((0, &[0.0; 2]), index, true);
            sight.overlooks(0)
        });
        assert_eq!(overlooks, [false, false, true]);
    }
}
