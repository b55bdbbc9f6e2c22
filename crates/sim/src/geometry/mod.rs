//! Distances of pairs of robots.

pub(crate) mod around;
pub(crate) mod crowd;
mod grid;
pub(crate) mod near;

use closeranks_core::num::{Vector, add_scaled, cut, dot, subtract};

/// `‖x − y‖²`, m².
#[must_use]
pub fn squared_distance<const D: usize>(x: &Vector<D>, y: &Vector<D>) -> f64 {
    let offset = subtract(x, y);
    dot(&offset, &offset)
}

/// Square of the least distance while an offset goes straight from `start` to `end`, m². No branches: for many worlds at once.
#[inline]
pub(crate) fn nearest_m2<const D: usize>(start: &Vector<D>, end: &Vector<D>) -> f64 {
    let step = subtract(end, start);
    let (length_m2, end_m2) = (dot(&step, &step), dot(end, end));
    let share = cut(-dot(start, &step) / length_m2, 0.0, 1.0);
    let nearest = add_scaled(start, share, &step);
    let nearest_m2 = dot(&nearest, &nearest);
    if nearest_m2 < end_m2 { nearest_m2 } else { end_m2 }
}

/// Puts the squared distance of every pair, m², into `pairs_m2`: that of robots `first < second` at place
/// `second (second − 1)/2 + first`.
pub(crate) fn fill_pairs<const D: usize>(positions_m: &[Vector<D>], pairs_m2: &mut Vec<f64>) {
    let robots = positions_m.len();
    pairs_m2.resize(robots * robots.saturating_sub(1) / 2, 0.0);
    let mut rest = &mut pairs_m2[..];
    for (second, x) in positions_m.iter().enumerate() {
        let (line, later) = core::mem::take(&mut rest).split_at_mut(second);
        for (pair_m2, y) in line.iter_mut().zip(positions_m) {
            *pair_m2 = squared_distance(x, y);
        }
        rest = later;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_in_the_order_of_their_second_robot() {
        let mut pairs = vec![9.0; 7];
        fill_pairs(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [6.0, 0.0]], &mut pairs);
        assert_eq!(pairs, [1.0, 9.0, 4.0, 36.0, 25.0, 9.0]);
    }

    #[test]
    fn robots_that_pass_each_other_between_ticks_are_seen() {
        assert_eq!(nearest_m2(&[-1.0, 0.25], &[1.0, 0.25]), 0.0625);
        assert_eq!(nearest_m2(&[1.0, 0.0], &[2.0, 0.0]), 1.0);
        assert_eq!(nearest_m2(&[2.0, 0.0], &[2.0, 0.0]), 4.0);
    }
}
