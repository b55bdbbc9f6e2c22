//! Who lies, where liars are drawn: many, but few around each robot.

use closeranks_core::num::Vector;

use crate::geometry::near::Near;
use crate::parse::common::{POSITIVE, small};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// Liars that are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// How many there are at most.
    pub most: u16,
    /// How far apart liars count as neighbours of one robot, m.
    pub within_m: f64,
}

impl Local {
    /// Reads the table `malicious` of a team of so many robots, whose links reach `radius_m`: by default those within it count
    /// as neighbours.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16, radius_m: f64) -> Self {
        let most = reader.whole(section, "local", 0..u64::from(robots) + 1).map_or(0, small);
        Self { most, within_m: reader.number_or(section, "within_m", POSITIVE, radius_m) }
    }

    /// Robots by number, in order, such that at the start no robot has more than `faults` of them within the distance, itself
    /// counted: drawn one after another as long as that holds.
    pub(crate) fn draw<const D: usize>(&self, positions_m: &[Vector<D>], faults: u16, seed: u64) -> Vec<u16> {
        let around = around(positions_m, self.within_m);
        let mut order: Vec<usize> = (0..positions_m.len()).collect();
        let mut random = Random::new(seed, Stream::Liars);
        for last in (1..order.len()).rev() {
            let other = usize::try_from(random.below(last as u64 + 1)).unwrap_or(0);
            order.swap(last, other);
        }
        let (mut near, mut liars) = (vec![0; order.len()], Vec::new());
        for robot in order {
            let touched = || around[robot].iter().copied().chain([robot]);
            if liars.len() < usize::from(self.most) && touched().all(|other| near[other] < faults) {
                touched().for_each(|other| near[other] += 1);
                liars.push(u16::try_from(robot + 1).unwrap_or(u16::MAX));
            }
        }
        liars.sort_unstable();
        liars
    }
}

/// Who is within `within_m` of whom.
fn around<const D: usize>(positions_m: &[Vector<D>], within_m: f64) -> Vec<Vec<usize>> {
    let (mut near, mut around) = (Near::default(), vec![Vec::new(); positions_m.len()]);
    near.look(positions_m, within_m);
    for second in 0..positions_m.len() {
        for first in near.before(second, positions_m, within_m).0.iter().map(|first| usize::from(*first)) {
            around[second].push(first);
            around[first].push(second);
        }
    }
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::squared_distance;
    use crate::scenario::start::Start;

    #[test]
    fn many_lie_and_few_around_each_robot() {
        let positions_m = Start::Hexagon { spacing_m: 0.6 }.positions::<2>(400, 1).unwrap();
        for (faults, seed) in [(1, 1), (2, 1), (2, 9)] {
            let liars = Local { most: 60, within_m: 1.5 }.draw(&positions_m, faults, seed);
            assert!(liars.len() > 6 && liars.is_sorted_by(|one, next| one < next));
            for x in &positions_m {
                let near = |liar: &&u16| squared_distance(x, &positions_m[usize::from(**liar) - 1]) <= 2.25;
                assert!(liars.iter().filter(near).count() <= usize::from(faults));
            }
        }
        assert_eq!(Local { most: 3, within_m: 1.0 }.draw(&positions_m, 2, 1).len(), 3);
        assert!(Local { most: 3, within_m: 1.0 }.draw(&positions_m, 0, 1).is_empty());
    }
}
