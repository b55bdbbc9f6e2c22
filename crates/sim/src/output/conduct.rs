//! How normal robots moved compared with what they wished.

use closeranks_core::num::{Vector, dot, length, sqrt, subtract};
use closeranks_core::program::InputBox;

use crate::frame::Frame;
use crate::scenario::{Limits, Scenario};

/// A robot wishes to move if its wish is at least this fast, m/s.
const WISH_MIN_M_S: f64 = 0.05;
/// It is blocked if it moves along its wish at less than this share of it.
const BLOCKED_SHARE: f64 = 0.05;
/// A team is deadlocked if everybody who wishes to move was blocked for the last so many seconds.
const DEADLOCK_S: f64 = 1.0;

/// Means over normal robots and the run. The wish is the desired velocity cut to the box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Conduct {
    /// How far a robot went along its wish, m.
    pub progress_m: f64,
    /// How far its velocity was from its wish, m/s.
    pub deviation_m_s: f64,
    /// Root mean square of the second difference of its velocity over the square of the tick, m/s³.
    pub jerk_m_s3: f64,
    /// How long it was blocked: it wished to move at 0.05 m/s or more and went along its wish at less than 5 % of it, s.
    pub blocked_s: f64,
    /// Everybody who wished to move was blocked for the whole of the last second.
    pub deadlocked: bool,
}

/// Sums over the ticks of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watch {
    /// Velocities of the last tick and of the one before, one robot after another, m/s.
    before: [Vec<f64>; 2],
    robot_ticks: u64,
    jerk_ticks: u64,
    progress: f64,
    deviation: f64,
    jerk2: f64,
    blocked: u64,
    /// Ticks in a row in which everybody who wished to move was blocked, and somebody did.
    stuck: u32,
}

impl Watch {
    /// Looks at a tick.
    pub(crate) fn watch<const D: usize>(
        &mut self,
        scenario: &Scenario,
        frame: &Frame<D>,
        malicious: &[bool],
    ) {
        let (mut wishing, mut blocked) = (0, 0);
        let limits = limits(scenario);
        let [one, two] = self.before.each_ref().map(|before| before.as_chunks::<D>().0);
        let (velocities_m_s, wishes_m_s) = (&frame.velocities_m_s[..], &frame.desired_m_s[..]);
        let robots = velocities_m_s.iter().zip(wishes_m_s).zip(malicious.iter().zip(&frame.down)).enumerate();
        for (robot, ((velocity, desired), (malicious, down))) in robots {
            if *malicious || *down {
                continue;
            }
            let wish = limits.clip(desired);
            let (speed2, along) = (dot(&wish, &wish), dot(velocity, &wish));
            self.robot_ticks += 1;
            if *velocity != wish {
                self.deviation += length(&subtract(velocity, &wish));
            }
            if speed2 > 0.0 {
                self.progress += along / sqrt(speed2);
            }
            if speed2 >= WISH_MIN_M_S * WISH_MIN_M_S {
                wishing += 1;
                blocked += u32::from(along < BLOCKED_SHARE * speed2);
            }
            if let (Some(one), Some(two)) = (one.get(robot), two.get(robot)) {
                let second: Vector<D> = core::array::from_fn(|d| velocity[d] - 2.0 * one[d] + two[d]);
                self.jerk2 += dot(&second, &second);
                self.jerk_ticks += 1;
            }
        }
        self.blocked += u64::from(blocked);
        self.stuck = if wishing > 0 && blocked == wishing { self.stuck.saturating_add(1) } else { 0 };
        self.before.swap(0, 1);
        self.before[0].clear();
        self.before[0].extend_from_slice(frame.velocities_m_s.as_flattened());
    }

    /// What it came to.
    #[expect(clippy::cast_precision_loss, reason = "ticks are far below 2^53")]
    pub(crate) fn finish(&self, scenario: &Scenario, normal: usize) -> Conduct {
        let (tick_s, robots) = (scenario.tick_s(), normal.max(1) as f64);
        let jerk = sqrt(self.jerk2 / self.jerk_ticks.max(1) as f64);
        Conduct {
            progress_m: self.progress * tick_s / robots,
            deviation_m_s: self.deviation / self.robot_ticks.max(1) as f64,
            jerk_m_s3: jerk / (tick_s * tick_s),
            blocked_s: self.blocked as f64 * tick_s / robots,
            deadlocked: f64::from(self.stuck) * tick_s >= DEADLOCK_S,
        }
    }
}

/// The velocities that a robot can be given; of a corner of which the scenario says nothing, 0.
fn limits<const D: usize>(scenario: &Scenario) -> InputBox<D> {
    let corner = |bounds: &[f64]| core::array::from_fn(|d| bounds.get(d).copied().unwrap_or(0.0));
    let Limits { input_min_m_s, input_max_m_s, speed_max_m_s, .. } = &scenario.limits;
    InputBox::of(corner(input_min_m_s), corner(input_max_m_s)).within(*speed_max_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conduct(velocities: &[[f64; 2]]) -> Conduct {
        let scenario = Scenario::default();
        let mut watch = Watch::default();
        let mut frame = Frame::<2>::new(vec![[0.0; 2]; 2], vec![0.0; 2]);
        frame.desired_m_s = vec![[9.0, 0.0]; 2];
        for velocity in velocities {
            frame.velocities_m_s = vec![*velocity, [-1.5, 0.0]];
            watch.watch(&scenario, &frame, &[false, true]);
        }
        watch.finish(&scenario, 1)
    }

    /// The wish is cut to 1.5 m/s, liars are not counted.
    #[test]
    fn what_is_told_of_simple_runs() {
        let straight = conduct(&[[1.5, 0.0]; 400]);
        assert!((straight.progress_m - 3.0).abs() < 1e-9);
        assert_eq!((straight.deviation_m_s, straight.jerk_m_s3, straight.blocked_s), (0.0, 0.0, 0.0));
        assert!(!straight.deadlocked);
        let still = conduct(&[[0.0, 0.0]; 400]);
        assert!((still.blocked_s - 2.0).abs() < 1e-9 && still.deadlocked);
        assert_eq!((still.progress_m, still.deviation_m_s), (0.0, 1.5));
        assert!(!conduct(&[[0.0, 0.0]; 100]).deadlocked);
        // 0, 1, 0, 1: the second difference is 2 in every tick.
        let shaking: Vec<[f64; 2]> = (0..100).map(|tick| [f64::from(tick % 2), 0.0]).collect();
        assert!((conduct(&shaking).jerk_m_s3 - 2.0 / 2.5e-5).abs() < 1e-3);
    }
}
