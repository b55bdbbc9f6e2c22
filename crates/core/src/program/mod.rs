//! The exact programs: the velocity or displacement closest to the desired one.

pub mod balls;
pub mod box_row;
pub mod one_row;

use crate::num::{Vector, cut, dot, length, sqrt};

/// The input set U_i, a box that contains 0, and what of it lies in a ball around 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputBox<const D: usize> {
    /// Least velocity per axis, m/s, finite, at most 0.
    pub min_m_s: Vector<D>,
    /// Greatest velocity per axis, m/s, finite, at least 0.
    pub max_m_s: Vector<D>,
    /// Greatest speed, m/s, positive; infinite for the box alone.
    pub speed_max_m_s: f64,
}

/// What the program found. Each of these is an answer, and none is an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The desired velocity, cut to the box, already satisfies the row.
    Free,
    /// The row changed the velocity and holds with equality.
    Active,
    /// No velocity in the box satisfies the row; the answer is the one that comes closest to it.
    Infeasible,
    /// Only under `budget`, outside the safe set: nothing gets worse, and what is broken is being mended.
    Recovering,
}

impl<const D: usize> InputBox<D> {
    /// The box alone, between these corners, m/s.
    #[must_use]
    pub const fn of(min_m_s: Vector<D>, max_m_s: Vector<D>) -> Self {
        Self { min_m_s, max_m_s, speed_max_m_s: f64::INFINITY }
    }

    /// Limits the speed too, whatever its direction, to `speed_max_m_s`.
    #[must_use]
    pub const fn within(self, speed_max_m_s: f64) -> Self {
        Self { speed_max_m_s, ..self }
    }

    /// The point of the set closest to `u`.
    ///
    /// That of box and ball is `clip(t u)` for some t in (0, 1], by the optimality conditions, and its length grows with t. Whatever
    /// is cut by the box at a t that is too small is cut at the right one too: so at most D components are fixed one after the
    /// other, and the rest follows from one root.
    //= theory sec:disc
    #[must_use]
    pub fn clip(&self, u: &Vector<D>) -> Vector<D> {
        let boxed = self.clip_to_box(u);
        if self.is_in_ball(&boxed) { boxed } else { self.shortened(u) }
    }

    #[inline]
    pub(crate) fn clip_to_box(&self, u: &Vector<D>) -> Vector<D> {
        core::array::from_fn(|d| cut(u[d], self.min_m_s[d], self.max_m_s[d]))
    }

    /// The closest point where the ball decides.
    fn shortened(&self, u: &Vector<D>) -> Vector<D> {
        let mut fixed = [false; D];
        let mut point = self.clip_to_box(u);
        for _ in 0..D {
            let part = |of: bool, v: &Vector<D>| -> f64 {
                (0..D).filter(|d| fixed[*d] == of).map(|d| v[d] * v[d]).sum()
            };
            let left = self.speed_max_m_s * self.speed_max_m_s - part(true, &point);
            let factor = sqrt(left.max(0.0) / part(false, u));
            let scaled = u.map(|component| factor * component);
            point = core::array::from_fn(|d| if fixed[d] { point[d] } else { scaled[d] });
            let cut = self.clip_to_box(&point);
            if cut == point {
                break;
            }
            for d in 0..D {
                fixed[d] |= cut[d] != point[d];
            }
            point = cut;
        }
        self.pulled_in(point)
    }

    /// Takes off what rounding has put beyond the ball.
    fn pulled_in(&self, mut point: Vector<D>) -> Vector<D> {
        let mut step = f64::EPSILON;
        while step < 1.0 && !self.is_in_ball(&point) {
            point = point.map(|component| component - step * component);
            step *= 2.0;
        }
        if self.is_in_ball(&point) { point } else { [0.0; D] }
    }

    fn is_in_ball(&self, u: &Vector<D>) -> bool {
        self.speed_max_m_s.is_infinite() || length(u) <= self.speed_max_m_s
    }

    /// True when `u` is inside, borders included.
    #[must_use]
    pub fn contains(&self, u: &Vector<D>) -> bool {
        (0..D).all(|d| self.min_m_s[d] <= u[d] && u[d] <= self.max_m_s[d]) && self.is_in_ball(u)
    }

    /// True if the ball cuts something off the box.
    #[must_use]
    pub fn is_round(&self) -> bool {
        let far: Vector<D> = core::array::from_fn(|d| self.max_m_s[d].max(-self.min_m_s[d]));
        dot(&far, &far) > self.speed_max_m_s * self.speed_max_m_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::subtract;

    //= theory sec:disc type=test
    #[test]
    fn no_point_of_box_and_disc_is_closer() {
        let input = InputBox::of([-1.0, -0.3], [0.8, 1.5]).within(1.0);
        for k in 0..400 {
            let (angle, far) = (0.1 * f64::from(k), 0.2 + 0.02 * f64::from(k % 97));
            let u = [far * libm::cos(angle), far * libm::sin(angle)];
            let point = input.clip(&u);
            assert!(input.contains(&point), "{u:?}");
            let least_m_s = length(&subtract(&u, &point));
            for (x, y) in (0..=60).flat_map(|x| (0..=60).map(move |y| (f64::from(x), f64::from(y)))) {
                let other = [-1.0 + x / 30.0, -1.0 + y / 30.0];
                assert!(
                    !input.contains(&other) || length(&subtract(&u, &other)) >= least_m_s - 1e-12,
                    "{u:?}"
                );
            }
        }
    }

    #[test]
    fn the_ball_and_the_box_by_hand() {
        let ball = InputBox::of([-2.0; 3], [2.0; 3]).within(1.0);
        let third = ball.clip(&[5.0, 5.0, 5.0]);
        assert!(third.iter().all(|part| (part - libm::sqrt(1.0 / 3.0)).abs() < 1e-15));
        assert_eq!(ball.clip(&[0.3, 0.4, 0.5]), [0.3, 0.4, 0.5]);
        let flat = InputBox::of([-1.0, -0.6], [1.0, 0.6]).within(1.0);
        let [x, y] = flat.clip(&[3.0, 3.0]);
        assert!((x - 0.8).abs() < 1e-15 && y == 0.6, "the box cuts one component, the disc the other");
        assert!(flat.is_round() && !InputBox::of([-1.0; 2], [1.0; 2]).is_round());
    }
}
