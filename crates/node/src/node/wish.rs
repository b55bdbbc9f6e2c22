//! Where a robot wants to go.

use core::time::Duration;

use closeranks_core::Instant;
use closeranks_sim::frame::Frame;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::want;

use crate::node::run::Wish;

/// A robot that wants to stay where it is.
pub struct Hold;

impl<const D: usize> Wish<D> for Hold {
    fn arrived(&mut self, _now: Instant, _bytes: &[u8]) {}

    fn desired(&mut self, _now: Instant, _own_m: &[f64; D]) -> [f64; D] {
        [0.0; D]
    }
}

/// A robot that moves as a scenario says. The time of its motion begins when the robot is asked first.
pub struct Listed<const D: usize> {
    scenario: Scenario,
    index: usize,
    frame: Frame<D>,
    began: Option<Instant>,
}

impl<const D: usize> Listed<D> {
    /// The motion of robot `number` in `scenario`.
    #[must_use]
    pub fn new(scenario: Scenario, number: u16) -> Self {
        let robots = usize::from(scenario.team.robots);
        let frame = Frame::new(vec![[0.0; D]; robots], vec![0.0; robots]);
        Self { scenario, index: usize::from(number.saturating_sub(1)), frame, began: None }
    }
}

impl<const D: usize> Wish<D> for Listed<D> {
    fn arrived(&mut self, _now: Instant, _bytes: &[u8]) {}

    fn desired(&mut self, now: Instant, own_m: &[f64; D]) -> [f64; D] {
        if !own_m.iter().all(|component| component.is_finite()) {
            return [f64::NAN; D];
        }
        let since = now.since(*self.began.get_or_insert(now));
        let ticks = since.as_nanos() / self.scenario.clock.level_period.as_nanos().max(1);
        self.frame.positions_m.fill(*own_m);
        want(&self.scenario, u32::try_from(ticks).unwrap_or(u32::MAX), &mut self.frame);
        self.frame.desired_m_s.get(self.index).copied().unwrap_or([f64::NAN; D])
    }
}

/// A robot that follows what is put on its key.
pub struct Key<const D: usize> {
    timeout: Duration,
    newest: Option<(Instant, [f64; D])>,
    refused: u64,
}

impl<const D: usize> Key<D> {
    /// Nothing older than `timeout` is followed; with 0 everything is.
    #[must_use]
    pub fn new(timeout: Duration) -> Self {
        Self { timeout, newest: None, refused: 0 }
    }

    /// How many arrivals were no velocity.
    #[must_use]
    pub fn refused(&self) -> u64 {
        self.refused
    }
}

impl<const D: usize> Wish<D> for Key<D> {
    fn arrived(&mut self, now: Instant, bytes: &[u8]) {
        let numbers: Option<Vec<f64>> =
            if bytes.len() <= 256 { serde_json::from_slice(bytes).ok() } else { None };
        match numbers.and_then(|numbers| <[f64; D]>::try_from(numbers).ok()) {
            Some(velocity) if velocity.iter().all(|component| component.is_finite()) => {
                self.newest = Some((now, velocity));
            }
            _ => self.refused += 1,
        }
    }

    fn desired(&mut self, now: Instant, _own_m: &[f64; D]) -> [f64; D] {
        let young = |at: Instant| self.timeout.is_zero() || now.since(at) <= self.timeout;
        self.newest.filter(|(at, _)| young(*at)).map_or([f64::NAN; D], |(_, velocity)| velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_old_or_no_velocity_is_not_followed() {
        let mut wish = Key::<2>::new(Duration::from_millis(500));
        let at = |ms: u64| Instant::from_nanos(ms * 1_000_000);
        assert!(wish.desired(at(0), &[0.0; 2])[0].is_nan());
        wish.arrived(at(0), b"[0.5, -1]");
        for wrong in [&b"[1]"[..], b"[1,2,3]", b"[null,1]", b"[1e999,0]", b"x", &[b'['; 300]] {
            wish.arrived(at(1), wrong);
        }
        assert_eq!((wish.desired(at(500), &[0.0; 2]), wish.refused()), ([0.5, -1.0], 6));
        assert!(wish.desired(at(501), &[0.0; 2])[0].is_nan());
    }

    #[test]
    fn a_scenario_moves_a_robot_as_in_the_simulator() {
        let mut wish = Listed::<2>::new(Scenario::default(), 1);
        assert!(wish.desired(Instant::START, &[f64::NAN; 2])[0].is_nan(), "nobody knows where it is");
        let velocity = wish.desired(Instant::START, &[0.5, 0.0]);
        assert!((velocity[0].hypot(velocity[1]) - 1.0).abs() < 1e-9, "the paper's unit speed: {velocity:?}");
    }
}
