//! Where robots want to go.

use closeranks_core::num::{Vector, length};

use crate::random::{Random, Stream};
use crate::scenario::route::Route;

/// Desired motion u_{i,des}(x_i).
#[derive(Clone, Debug, PartialEq)]
pub enum Desired {
    /// The paper's section V: unit speed in four directions (six in 3D), which would break the network.
    Paper,
    /// Stay where one is.
    Hold,
    /// To the origin at unit speed, so that everybody runs into everybody.
    Gather,
    /// Away from the origin at unit speed, so that everybody pulls at everybody.
    Outward,
    /// Somewhere else every half second, at up to 1.5 times unit speed, each robot for itself.
    Wander,
    /// As is listed for each robot; one that is not listed stays where it is.
    Listed(Route),
}

impl Desired {
    /// Desired velocity of robot `number` (from 1) of `robots`, m/s.
    ///
    /// ```text
    /// v = (−1)^i · 100 e_d − x_i,   u_des = v/‖v‖
    /// ```
    ///
    /// with axis d = 1 for the first ⌊n/D⌋ robots, d = 2 for the next, and so on: for n = 11, D = 2 as printed.
    //= paper sec:sim
    #[must_use]
    pub fn desired<const D: usize>(&self, number: u16, robots: u16, position: &Vector<D>) -> Vector<D> {
        match self {
            Self::Paper => {}
            Self::Hold | Self::Wander | Self::Listed(_) => return [0.0; D],
            Self::Outward => return unit(position),
            Self::Gather => return unit(&position.map(|component| -component)),
        }
        let axis = (1..D).filter(|d| usize::from(number) > d * usize::from(robots) / D).count();
        let sign = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        let toward: Vector<D> =
            core::array::from_fn(|d| if d == axis { sign * 100.0 - position[d] } else { -position[d] });
        unit(&toward)
    }

    /// Desired velocity of robot `number` under [`Desired::Wander`], m/s. It depends on seed, robot and time alone.
    #[must_use]
    pub fn wandering<const D: usize>(seed: u64, number: u16, time_s: f64) -> Vector<D> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let leg = (2.0 * time_s) as u64;
        let mixed = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (u64::from(number) << 32) ^ leg;
        Random::new(mixed, Stream::Motion).in_ball().map(|component: f64| 1.5 * component)
    }
}

/// The vector scaled to length 1; 0 stays 0.
fn unit<const D: usize>(vector: &Vector<D>) -> Vector<D> {
    let size = length(vector);
    if size > 0.0 { vector.map(|component| component / size) } else { [0.0; D] }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper sec:sim type=test
    #[test]
    fn the_papers_eleven_robots_go_four_ways() {
        let way = |number| Desired::Paper.desired(number, 11, &[0.0, 0.0]);
        assert_eq!(way(1), [-1.0, 0.0]);
        assert_eq!(way(4), [1.0, 0.0]);
        assert_eq!(way(5), [-1.0, 0.0]);
        assert_eq!(way(6), [0.0, 1.0]);
        assert_eq!(way(11), [0.0, -1.0]);
    }

    #[test]
    fn in_three_dimensions_six_ways() {
        let way = |number| Desired::Paper.desired(number, 12, &[0.0, 0.0, 0.0]);
        assert_eq!(way(4), [1.0, 0.0, 0.0]);
        assert_eq!(way(5), [0.0, -1.0, 0.0]);
        assert_eq!(way(9), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn the_goal_itself_and_holding_ask_for_nothing() {
        assert_eq!(Desired::Paper.desired(2, 11, &[100.0, 0.0]), [0.0, 0.0]);
        assert_eq!(Desired::Hold.desired(2, 11, &[1.0, 0.0]), [0.0, 0.0]);
        assert_eq!(Desired::Gather.desired(2, 11, &[0.0, 4.0]), [0.0, -1.0]);
        assert_eq!(Desired::Outward.desired(2, 11, &[0.0, 4.0]), [0.0, 1.0]);
    }

    #[test]
    fn wandering_robots_change_their_way_twice_a_second() {
        let way = |number, time_s| Desired::wandering::<2>(7, number, time_s);
        assert_eq!(way(1, 0.0), way(1, 0.49));
        assert_ne!(way(1, 0.0), way(1, 0.5));
        assert_ne!(way(1, 0.0), way(2, 0.0));
        assert!((0..100).all(|number| length(&way(number, 3.0)) <= 1.5));
    }
}
