//! What becomes of velocities: robots lag, miss ticks, crash and return.

use closeranks_core::num::{Vector, add_scaled, length, subtract};

use crate::faults::spell::Spell;
use crate::parse::common::{DELAY, FRACTION, set};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// What is wrong with the robots themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plant {
    /// Time constant of a first-order lag between velocity and motion, s.
    pub lag_s: f64,
    /// Probability that a robot misses a tick.
    pub missed: f64,
    /// Whether a robot that misses a tick goes on with its last velocity instead of standing still.
    pub goes_on: bool,
    /// A robot that stands still, silent and deaf for a while.
    pub crash: Option<Spell>,
    /// Whether it has forgotten everything when it returns.
    pub forgets: bool,
}

impl Plant {
    /// Reads the table `plant` of a scenario text for a team of so many robots.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        let mut plant = Self::default();
        set(&mut plant.lag_s, reader.number(section, "lag_s", DELAY));
        set(&mut plant.missed, reader.number(section, "missed", FRACTION));
        let held = [("stops", false), ("goes-on", true)];
        set(&mut plant.goes_on, reader.word(section, "when_missed", &held));
        plant.crash = Spell::read(reader, section, "crash", robots);
        let memory = [("keeps", false), ("forgets", true)];
        set(&mut plant.forgets, reader.word(section, "memory", &memory));
        plant
    }
}

/// Robots as bodies.
#[derive(Clone, Debug)]
pub struct Bodies<const D: usize> {
    plant: Plant,
    random: Random,
    tick_s: f64,
    /// `exp(−T/lag)`.
    stays: f64,
    moving_m_s: Vec<Vector<D>>,
    /// Where velocities have taken each, m.
    references_m: Vec<Vector<D>>,
    down: Vec<bool>,
    /// Whether the crash lasted in the tick before, and whether it lasts in this one.
    crash: [bool; 2],
}

impl<const D: usize> Bodies<D> {
    /// The bodies of `scenario` at `positions_m`.
    #[must_use]
    pub fn new(scenario: &Scenario, positions_m: &[Vector<D>]) -> Self {
        let (plant, tick_s) = (scenario.trouble.plant, scenario.tick_s());
        let stays = if plant.lag_s > 0.0 { closeranks_core::num::exp(-tick_s / plant.lag_s) } else { 0.0 };
        Self {
            plant,
            random: Random::new(scenario.seed, Stream::Plant),
            tick_s,
            stays,
            moving_m_s: vec![[0.0; D]; positions_m.len()],
            references_m: positions_m.to_vec(),
            down: vec![false; positions_m.len()],
            crash: [false; 2],
        }
    }

    /// Decides who misses this tick.
    pub fn begin_tick(&mut self, time_s: f64) {
        self.crash = [self.crash[1], self.plant.crash.is_some_and(|spell| spell.lasts(time_s))];
        for index in 0..self.down.len() {
            self.down[index] =
                self.crashed(index) || (self.plant.missed > 0.0 && self.random.chance(self.plant.missed));
        }
    }

    fn crashes(&self, index: usize) -> bool {
        self.plant.crash.is_some_and(|spell| spell.index() == index)
    }

    /// True while the crash of this robot lasts.
    fn crashed(&self, index: usize) -> bool {
        self.crash[1] && self.crashes(index)
    }

    /// True for a robot that does nothing in this tick.
    #[must_use]
    pub fn down(&self, index: usize) -> bool {
        self.down[index]
    }

    /// True for a robot that returns in this tick from a crash after which it has forgotten everything.
    #[must_use]
    pub fn reborn(&self, index: usize) -> bool {
        self.plant.forgets && self.crash == [true, false] && self.crashes(index)
    }

    /// Velocity of a robot that misses a tick, when its last one was `last`.
    #[must_use]
    pub fn without_command(&self, index: usize, last: Vector<D>) -> Vector<D> {
        if self.plant.goes_on && !self.crashed(index) { last } else { [0.0; D] }
    }

    /// True when some robot goes on without having looked.
    #[must_use]
    pub fn blind(&self) -> bool {
        self.plant.goes_on && self.down.iter().any(|down| *down)
    }

    /// Moves everybody by a tick.
    ///
    /// ```text
    /// lag: ẇ = (u − w)/τ, so  x += T u + τ (1 − e^(−T/τ)) (w − u),   w = u + e^(−T/τ) (w − u)
    /// ```
    pub fn integrate(&mut self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        for (index, (position, velocity)) in positions_m.iter_mut().zip(velocities_m_s).enumerate() {
            *position = add_scaled(position, self.tick_s, velocity);
            if self.stays > 0.0 {
                let behind = subtract(&self.moving_m_s[index], velocity);
                *position = add_scaled(position, self.plant.lag_s * (1.0 - self.stays), &behind);
                self.moving_m_s[index] = add_scaled(velocity, self.stays, &behind);
            }
            let reference = &mut self.references_m[index];
            *reference =
                if self.stays > 0.0 { add_scaled(reference, self.tick_s, velocity) } else { *position };
        }
    }

    /// Where its velocities have taken each robot, m.
    #[must_use]
    pub fn references_m(&self) -> &[Vector<D>] {
        &self.references_m
    }

    /// Greatest distance of a robot from where its velocities have taken it, m.
    #[must_use]
    pub fn away_m(&self, positions_m: &[Vector<D>]) -> f64 {
        let away = self.references_m.iter().zip(positions_m).map(|(x, y)| length(&subtract(x, y)));
        away.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_is_at_most_its_time_constant_times_the_speed() {
        let mut scenario = Scenario { robots: 1, ..Scenario::default() };
        scenario.trouble.plant.lag_s = 0.1;
        let mut positions = [[0.0, 0.0]];
        let mut bodies = Bodies::new(&scenario, &positions);
        for _ in 0..400 {
            bodies.integrate(&mut positions, &[[1.0, 0.0]]);
        }
        assert!((bodies.references_m()[0][0] - 2.0).abs() < 1e-12);
        assert!((bodies.away_m(&positions) - 0.1).abs() < 1e-8, "{}", bodies.away_m(&positions));
        for _ in 0..400 {
            bodies.integrate(&mut positions, &[[-1.0, 0.0]]);
            assert!(bodies.away_m(&positions) <= 0.1 + 1e-12);
        }
    }

    #[test]
    fn robots_crash_and_miss_ticks() {
        let mut scenario = Scenario::default();
        scenario.trouble.plant = Plant {
            crash: Some(Spell { robot: 2, from_s: 0.1, to_s: 0.2 }),
            forgets: true,
            ..Plant::default()
        };
        let mut bodies = Bodies::<2>::new(&scenario, &[[0.0; 2]; 11]);
        let seen = [0.05, 0.1, 0.195, 0.2, 0.205].map(|time_s| {
            bodies.begin_tick(time_s);
            (bodies.down(1), bodies.reborn(1))
        });
        let (up, down) = ((false, false), (true, false));
        assert_eq!(seen, [up, down, down, (false, true), up]);
        assert!(!bodies.reborn(0));
        scenario.trouble.plant = Plant { missed: 0.3, goes_on: true, ..Plant::default() };
        let mut bodies = Bodies::<2>::new(&scenario, &[[0.0; 2]; 11]);
        let missed: usize = (0..100)
            .map(|_| {
                bodies.begin_tick(0.0);
                usize::from(bodies.down(4))
            })
            .sum();
        assert!((15..45).contains(&missed));
        assert_eq!(bodies.without_command(4, [1.0, 2.0]), [1.0, 2.0]);
    }

    /// A crash may end at a time that ticks meet but for the last place: k T and (k − 1) T + T are not one number.
    #[test]
    fn whoever_forgets_begins_anew_once() {
        for (tick_s, to_s) in [(0.005, 0.1), (0.01, 0.07), (0.1, 0.7), (0.007, 0.63)] {
            let mut scenario = Scenario::default();
            let crash = Some(Spell { robot: 2, from_s: 0.02, to_s });
            scenario.trouble.plant = Plant { crash, forgets: true, ..Plant::default() };
            let mut bodies = Bodies::<2>::new(&scenario, &[[0.0; 2]; 11]);
            let births = (0..400).filter(|tick| {
                bodies.begin_tick(f64::from(*tick) * tick_s);
                bodies.reborn(1)
            });
            assert_eq!(births.count(), 1, "{tick_s} s, {to_s} s");
        }
    }
}
