//! What robots sense of positions, which is not always where everybody is.

use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};

use crate::faults::dropouts::Dropouts;
use crate::faults::spell::Spell;
use crate::parse::common::NOT_NEGATIVE;
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// What is wrong with sensed positions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensing {
    /// Every sensed position, own or another's, is wrong by an error drawn evenly from a ball of this radius, m: anew for
    /// every observer and tick.
    pub noise_m: f64,
    /// For a while all robots, itself included, sense one robot where it was at the beginning of that time.
    pub frozen: Option<Spell>,
    /// For a while all robots, itself included, sense one robot so far off, m.
    pub jump: Option<(Spell, f64)>,
    /// Who is not sensed at all.
    pub dropouts: Dropouts,
}

impl Sensing {
    /// True if everybody within R is sensed where it is.
    #[must_use]
    pub fn is_right(&self) -> bool {
        *self == Self::default()
    }

    /// Reads the table `sensing` of a scenario text for a team of so many robots.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        Self {
            noise_m: reader.number_or(section, "noise_m", NOT_NEGATIVE, 0.0),
            frozen: Spell::read(reader, section, "frozen", robots),
            jump: Spell::read_with(reader, section, "jump", robots, ("by_m", NOT_NEGATIVE)),
            dropouts: Dropouts::read(reader, section, robots),
        }
    }
}

/// Sensors in use.
#[derive(Clone, Debug)]
pub struct Senses<const D: usize> {
    sensing: Sensing,
    random: Random,
    /// Where everybody seems to be before noise.
    seeming: Vec<Vector<D>>,
    frozen_at: Option<Vector<D>>,
    aside: Vector<D>,
    /// The greatest error that each robot met in this tick, m.
    errors_m: Vec<f64>,
}

impl<const D: usize> Senses<D> {
    /// The sensors of so many robots.
    #[must_use]
    pub fn new(sensing: Sensing, seed: u64, robots: u16) -> Self {
        let mut random = Random::new(seed, Stream::Sensing);
        let aside: Vector<D> = random.in_ball();
        let size = length(&aside).max(1e-9);
        Self {
            sensing,
            random,
            seeming: Vec::new(),
            frozen_at: None,
            aside: aside.map(|component| component / size),
            errors_m: vec![0.0; usize::from(robots)],
        }
    }

    /// Begins a tick with everybody at `positions`.
    pub fn begin_tick(&mut self, time_s: f64, positions: &[Vector<D>]) {
        self.seeming.clear();
        self.seeming.extend_from_slice(positions);
        self.errors_m.fill(0.0);
        if let Some(spell) = self.sensing.frozen {
            let index = spell.index();
            if spell.lasts(time_s) && !positions[index][0].is_nan() {
                self.seeming[index] = *self.frozen_at.get_or_insert(positions[index]);
            } else {
                self.frozen_at = None;
            }
        }
        if let Some((spell, by_m)) = self.sensing.jump.filter(|(spell, _)| spell.lasts(time_s)) {
            let seeming = &mut self.seeming[spell.index()];
            *seeming = add_scaled(seeming, by_m, &self.aside);
        }
    }

    /// Where `observer` senses the robot `index`, which is at `position`.
    pub fn sense(&mut self, observer: usize, index: usize, position: &Vector<D>) -> Vector<D> {
        let mut sensed = self.seeming[index];
        if self.sensing.noise_m > 0.0 {
            sensed = add_scaled(&sensed, self.sensing.noise_m, &self.random.in_ball());
        }
        if sensed != *position {
            let error_m = length(&subtract(&sensed, position));
            self.errors_m[observer] = self.errors_m[observer].max(error_m);
        }
        sensed
    }

    /// Greatest error that robot `index` met in this tick, m.
    #[must_use]
    pub fn error_m(&self, index: usize) -> f64 {
        self.errors_m[index]
    }
}

impl Random {
    /// Even in the unit ball.
    pub fn in_ball<const D: usize>(&mut self) -> Vector<D> {
        loop {
            let point: Vector<D> = core::array::from_fn(|_| self.uniform(-1.0, 1.0));
            if dot(&point, &point) <= 1.0 {
                return point;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensed(sensing: Sensing, time_s: f64, senses: &mut Senses<2>, x: f64) -> f64 {
        senses.sensing = sensing;
        senses.begin_tick(time_s, &[[x, 0.0], [9.0, 9.0]]);
        let seen = senses.sense(1, 0, &[x, 0.0]);
        let away = length(&subtract(&seen, &[x, 0.0]));
        assert_eq!(senses.error_m(1), away);
        away
    }

    #[test]
    fn noise_stays_in_its_ball_and_differs() {
        let mut senses = Senses::new(Sensing::default(), 1, 11);
        let noise = Sensing { noise_m: 0.1, ..Sensing::default() };
        let errors: Vec<f64> = (0..100).map(|_| sensed(noise, 0.0, &mut senses, 1.0)).collect();
        assert!(errors.iter().all(|error| *error <= 0.1) && errors.iter().any(|error| *error > 0.09));
    }

    #[test]
    fn a_position_freezes_or_jumps_and_comes_back() {
        let mut senses = Senses::new(Sensing::default(), 1, 11);
        let spell = Spell { robot: 1, from_s: 1.0, to_s: 2.0 };
        let frozen = Sensing { frozen: Some(spell), ..Sensing::default() };
        let jump = Sensing { jump: Some((spell, 0.5)), ..Sensing::default() };
        let at = |sensing, senses: &mut Senses<2>| {
            [0.0, 1.0, 1.5, 2.0].map(|time_s| sensed(sensing, time_s, senses, time_s))
        };
        assert_eq!(at(frozen, &mut senses), [0.0, 0.0, 0.5, 0.0]);
        let [before, begin, on, after] = at(jump, &mut senses);
        assert!((begin - 0.5).abs() < 1e-12 && (on - 0.5).abs() < 1e-12);
        assert_eq!([before, after], [0.0, 0.0]);
    }
}
