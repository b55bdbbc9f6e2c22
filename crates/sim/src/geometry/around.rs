//! Who is near whom, from the side of each robot.

use closeranks_core::num::Vector;

use crate::geometry::near::{Near, small};

/// For each robot those within a radius, in order of their numbers. Memory and time grow with the number of such pairs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Around {
    near: Near,
    others: Vec<Vec<u16>>,
}

impl Around {
    /// Looks at robots at `positions_m`.
    pub(crate) fn look<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) {
        self.near.look(positions_m, radius_m);
        self.others.resize(positions_m.len(), Vec::new());
        self.others.iter_mut().for_each(Vec::clear);
        for second in 0..positions_m.len() {
            let (firsts, _) = self.near.before(second, positions_m, radius_m);
            self.others[second].extend_from_slice(firsts);
            for first in firsts {
                self.others[usize::from(*first)].push(small(second));
            }
        }
    }

    /// Those around one robot, in order.
    pub(crate) fn of(&self, robot: usize) -> &[u16] {
        &self.others[robot]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::squared_distance;
    use crate::scenario::start::Start;

    #[test]
    fn those_around_are_in_order_and_all_there() {
        for robots in [9, 300] {
            let positions_m = Start::Hexagon { spacing_m: 0.6 }.positions::<2>(robots, 1).unwrap();
            let mut around = Around::default();
            around.look(&positions_m, 1.3);
            for (robot, own) in positions_m.iter().enumerate() {
                let near = |other: &usize| squared_distance(own, &positions_m[*other]) <= 1.3 * 1.3;
                let expected = (0..positions_m.len()).filter(|other| *other != robot && near(other));
                assert!(around.of(robot).iter().map(|other| usize::from(*other)).eq(expected));
            }
        }
    }
}
