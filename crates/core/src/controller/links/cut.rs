//! Links that obstacles would cut: how much room each of them has, and the row that keeps it whole.
//!
//! Let w be the offset from the nearest point q of the segment of an obstacle, whose radius is s, to the nearest point of the straight way
//! between robots i and j. The plane `w·z = w·q + s|w|` touches the obstacle and has the way on its far side. A robot stays there, by the
//! margin m, if it moves by a v with
//!
//! ```text
//! (cut)  −w·v ≤ (|w| (|w| − s − m) + (w·(x_i − x_j))⁺)⁺
//! ```
//!
//! Both ends find the same plane, and what is beyond it is convex, so the link is whole between ticks too (docs/theory/obstacles.md,
//! thm:cut). With errors there is a row for each corner of a cube around w. The half-space contains v = 0.

use crate::controller::rows::{Rows, may_bind};
use crate::num::{Vector, dot, larger, length, sqrt, subtract};
use crate::obstacle::Obstacle;
use crate::program::balls::row::Row;
use crate::settings::Settings;

/// Links keep so much more room than they must, m: far more than rounding turns a plane by, less than anybody can see.
const HAIR_M: f64 = 1e-4;

/// How much room links keep from what would cut them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuts {
    /// m, from a link of references to an obstacle, m: how far robots may be from their references, and how wrong their places
    /// may be sensed.
    pub keep_m: f64,
    /// E, m: how wrong the place of a robot may be sensed that is seen in this tick.
    pub error_m: f64,
}

/// What robots know of how much room a link has beyond the margin, m: infinite where nothing could cut it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// It has at least so much.
    pub least_m: f64,
    /// It has at most so much.
    pub most_m: f64,
}

impl Room {
    /// Nothing could cut the link.
    pub const OPEN: Self = Self { least_m: f64::INFINITY, most_m: f64::INFINITY };

    /// True if the link certainly has so little room that no robot counts on it: whoever obeys its rows leaves it more.
    //= theory sec:cut-admitted
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.most_m < -0.5 * HAIR_M
    }

    /// True if the link certainly has so much room that it may begin to be counted on.
    //= theory sec:cut-admitted
    #[must_use]
    pub fn suffices(&self) -> bool {
        self.least_m >= -0.25 * HAIR_M
    }
}

impl Cuts {
    /// What follows from the settings.
    //= theory thm:cut
    #[must_use]
    pub fn new<const D: usize>(settings: &Settings<D>) -> Self {
        let bounds = settings.error_bounds();
        let error_m = bounds.sensed_m();
        Self { keep_m: bounds.away_m + error_m + HAIR_M, error_m }
    }
}

/// What a robot at `position_m` (m) knows of what cuts links.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Among<'map, const D: usize> {
    cuts: Cuts,
    position_m: Vector<D>,
    /// Empty if nothing of the map cuts links.
    map: &'map [Obstacle<D>],
}

/// A link beside an obstacle: w, m, its length, and how wrong the ends of the link may be, m.
#[expect(clippy::struct_field_names, reason = "all of them are lengths")]
struct Gap<const D: usize> {
    offset_m: Vector<D>,
    length_m: f64,
    error_m: f64,
}

impl<'map, const D: usize> Among<'map, D> {
    /// For a robot at `position_m` that knows of `map`.
    pub(crate) fn new(cuts: Cuts, position_m: Vector<D>, map: &'map [Obstacle<D>]) -> Self {
        let any = map.iter().any(|obstacle| obstacle.cuts_links);
        Self { cuts, position_m, map: if any { map } else { &[] } }
    }

    /// True if nothing could cut a link.
    #[inline]
    pub(crate) fn is_open(&self) -> bool {
        self.map.is_empty()
    }

    /// How much room the link has to a robot at the offset r (m) that may have gone `gone_m` since it was sensed.
    //= theory sec:cut-admitted
    #[cold]
    pub(crate) fn room(&self, offset_m: &Vector<D>, gone_m: f64) -> Room {
        let mut room = Room::OPEN;
        for obstacle in self.map.iter().filter(|obstacle| obstacle.cuts_links) {
            let Gap { length_m, error_m, .. } = self.gap(obstacle, offset_m, gone_m);
            let seen_m = length_m - obstacle.radius_m - self.cuts.keep_m;
            room.least_m = room.least_m.min(seen_m - error_m);
            room.most_m = room.most_m.min(seen_m + error_m);
        }
        room
    }

    /// Adds the rows of the link to that robot: one for each obstacle that a move could reach, and with errors one for each corner of the
    /// cube in which w lies.
    //= theory thm:cut
    #[cold]
    pub(crate) fn push(&self, offset_m: &Vector<D>, gone_m: f64, rows: &mut Rows<'_, D>) {
        for obstacle in self.map.iter().filter(|obstacle| obstacle.cuts_links) {
            let gap = self.gap(obstacle, offset_m, gone_m);
            let toward_m = gap.offset_m.map(|component| -component);
            let (turned_m, kept_m) = (gap.turned_m(), obstacle.radius_m + self.cuts.keep_m);
            let bound_m2 = larger(gap.own_m2(kept_m) + gap.beyond_m2(offset_m), 0.0);
            if may_bind(rows.program.reach.lhs_max(&toward_m, turned_m, 0.0), bound_m2) {
                rows.push(&toward_m, turned_m, |toward| Row::new(*toward, 0.0, bound_m2));
            }
        }
    }

    fn gap(&self, obstacle: &Obstacle<D>, offset_m: &Vector<D>, gone_m: f64) -> Gap<D> {
        let other_m = subtract(&self.position_m, offset_m);
        let offset_m = obstacle.offset_between_m(&self.position_m, &other_m);
        Gap { length_m: length(&offset_m), offset_m, error_m: self.cuts.error_m + gone_m }
    }
}

impl<const D: usize> Gap<D> {
    /// How far the true w may be from this one, m: it is what projecting a convex set leaves that is wrong by the error.
    //= theory thm:cut
    fn turned_m(&self) -> f64 {
        sqrt(self.error_m * (2.0 * self.length_m + self.error_m))
    }

    /// The least that `|w| (|w| − s − m)` can be, m², where `kept_m` is s + m.
    fn own_m2(&self, kept_m: f64) -> f64 {
        let least_m = larger(self.length_m - self.error_m, 0.5 * kept_m);
        least_m * (least_m - kept_m)
    }

    /// The least that `(w·r)⁺` can be, m²: by so much the own end is farther from the plane than the nearest point of the link.
    fn beyond_m2(&self, offset_m: &Vector<D>) -> f64 {
        let turned_m = self.turned_m();
        let wrong_m2 = turned_m * length(offset_m) + 2.0 * self.error_m * (self.length_m + turned_m);
        larger(dot(&self.offset_m, offset_m) - wrong_m2, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::add_scaled;
    use crate::obstacle::is_cut;
    use crate::program::InputBox;
    use crate::program::balls::reach::Reach;

    const REACH_M: f64 = 0.3;
    const EXACT: Cuts = Cuts { keep_m: HAIR_M, error_m: 0.0 };

    fn map() -> [Obstacle<2>; 3] {
        let wall = Obstacle::wall([-1.0, 0.0], [0.0, 0.0]).cutting();
        [wall, Obstacle::disc([1.2, 0.4], 0.3).cutting(), Obstacle::disc([0.5, 0.0], 0.2)]
    }

    /// A number between −1 and 1.
    fn number(k: u32, by: f64) -> f64 {
        libm::sin(by * f64::from(k) * f64::from(k))
    }

    fn drawn(k: u32, by: f64, size: f64) -> [f64; 2] {
        [size * number(k, by), size * number(k, by + 0.7)]
    }

    /// The move of a robot at `x` with a link to `y`, both as sensed, that wishes to move by `wish_m`.
    fn moved(cuts: Cuts, map: &[Obstacle<2>], [x, y, wish_m]: [[f64; 2]; 3]) -> [f64; 2] {
        let mut memory = [Row::default(); 60];
        let reach = Reach::new(&InputBox::of([-REACH_M; 2], [REACH_M; 2]), 1.0);
        let mut rows = Rows::new(&wish_m, reach, &mut memory);
        Among::new(cuts, x, map).push(&subtract(&x, &y), 0.0, &mut rows);
        rows.closest().displacement_m
    }

    fn room_m(map: &[Obstacle<2>], x: &[f64; 2], y: &[f64; 2]) -> f64 {
        let cutting = map.iter().filter(|one| one.cuts_links);
        cutting.map(|one| length(&one.offset_between_m(x, y)) - one.radius_m).fold(f64::INFINITY, f64::min)
    }

    /// Both ends move as they like within their rows, and sense both places wrong by up to 0.02 m, each in its own way: a link that has the
    /// margin has it after the move and at every part of it, and rows bind often enough for this to say something.
    //= theory thm:cut type=test
    #[test]
    fn a_link_with_room_keeps_it_whatever_both_ends_wish_and_however_wrong_they_sense() {
        let map = map();
        for error_m in [0.0, 0.02] {
            let cuts = Cuts { keep_m: HAIR_M + error_m, error_m };
            let (mut links, mut tight, mut stopped) = (0, 0, 0);
            for k in 0..60_000 {
                let [x, y] = [drawn(k, 1.3, 1.5), drawn(k, 2.9, 1.5)];
                if room_m(&map, &x, &y) < cuts.keep_m {
                    continue;
                }
                let sensed = |from: [f64; 2], by| {
                    let way = drawn(k, by, 1.0);
                    add_scaled(&from, error_m / length(&way).max(1.0), &way)
                };
                let wishes = [drawn(k, 5.3, 0.4), drawn(k, 6.1, 0.4)];
                let v = moved(cuts, &map, [sensed(x, 3.7), sensed(y, 4.1), wishes[0]]);
                let w = moved(cuts, &map, [sensed(y, 4.9), sensed(x, 8.3), wishes[1]]);
                for part in [0.3, 0.7, 1.0] {
                    let [x, y] = [add_scaled(&x, part, &v), add_scaled(&y, part, &w)];
                    let room_m = room_m(&map, &x, &y);
                    assert!(room_m >= cuts.keep_m - 1e-9, "{k}, {error_m}: {room_m}");
                    tight += u32::from(room_m < cuts.keep_m + 1e-3);
                }
                links += 1;
                stopped += u32::from(length(&subtract(&v, &wishes[0])) > 0.2);
            }
            assert!(links > 2_000 && stopped > 100, "{links} links, {stopped} stopped");
            assert!(tight > 20 || error_m > 0.0, "{tight}");
        }
    }

    /// One end alone, or a row without the error, is not enough: what the test above checks can fail.
    #[test]
    fn rows_of_one_end_alone_let_links_be_cut() {
        let map = map();
        let mut cut = 0;
        for k in 0..20_000 {
            let [x, y] = [drawn(k, 1.3, 1.5), drawn(k, 2.9, 1.5)];
            if room_m(&map, &x, &y) >= HAIR_M {
                let v = moved(EXACT, &map, [x, y, drawn(k, 5.3, 0.4)]);
                let [x, y] = [add_scaled(&x, 1.0, &v), add_scaled(&y, 1.0, &drawn(k, 6.1, 0.29))];
                cut += u32::from(is_cut(&map, &x, &y));
            }
        }
        assert!(cut > 50, "{cut}");
    }

    /// A link that passes the end of a wall at 0.1 m: what each end may do by hand.
    //= theory thm:cut type=test
    #[test]
    fn rows_by_hand() {
        let (cuts, map) = (Cuts { keep_m: 0.02, error_m: 0.0 }, [map()[0]]);
        let [x, y] = [[0.1, 1.0], [0.1, -1.0]];
        let near = |a: [f64; 2], b: [f64; 2]| length(&subtract(&a, &b)) < 1e-12;
        assert!(near(moved(cuts, &map, [x, y, [-0.3, 0.1]]), [-0.08, 0.1]), "all but the margin may go");
        assert!(near(moved(cuts, &map, [x, y, [0.3, -0.3]]), [0.3, -0.3]), "away and along it is free");
        let slant = moved(cuts, &map, [[0.5, -1.2], [0.1, -0.1], [-0.3, 0.0]]);
        assert!(near(slant, [-0.3, 0.0]), "an end that is far from the plane may go farther: {slant:?}");
        let open = [Obstacle { cuts_links: false, ..map[0] }];
        assert!(near(moved(cuts, &open, [x, y, [-0.3, 0.1]]), [-0.3, 0.1]));
        let lost = Among::new(cuts, [-0.5, 1.0], &map).room(&[0.0, 2.0], 0.0);
        assert!(lost.is_lost() && !lost.suffices());
        let kept = Among::new(cuts, x, &map).room(&[0.0, 2.0], 0.0);
        assert!((kept.least_m - 0.08).abs() < 1e-12 && kept.suffices() && !kept.is_lost());
        assert_eq!(Among::new(cuts, x, &open).room(&[0.0, 2.0], 0.0), Room::OPEN);
    }

    /// Whoever is not sensed may have gone anywhere: the room is known less, and in the end the robot stands still.
    //= theory sec:cut-admitted type=test
    #[test]
    fn who_is_not_sensed_may_be_cut_or_not() {
        let among_map = [map()[0]];
        let among = Among::new(EXACT, [0.1, 1.0], &among_map);
        let room = among.room(&[0.0, 2.0], 0.5);
        assert!(!room.is_lost() && !room.suffices());
        let mut memory = [Row::default(); 60];
        let reach = Reach::new(&InputBox::of([-REACH_M; 2], [REACH_M; 2]), 1.0);
        let mut rows = Rows::new(&[-0.2, 0.1], reach, &mut memory);
        among.push(&[0.0, 2.0], 0.5, &mut rows);
        assert!(length(&rows.closest().displacement_m) < 1e-12);
    }

    #[test]
    fn an_obstacle_without_numbers_forbids_any_move() {
        let map = [Obstacle::disc([f64::NAN, 0.0], 0.5).cutting()];
        assert_eq!(moved(EXACT, &map, [[0.6, 0.0], [0.0, 0.6], [0.2, 0.1]]), [0.0, 0.0]);
    }

    #[test]
    fn more_rows_than_there_is_memory_for_mean_standing_still() {
        let map = [map()[0]; 3];
        let mut memory = [Row::default(); 6];
        let reach = Reach::new(&InputBox::of([-REACH_M; 2], [REACH_M; 2]), 1.0);
        let mut rows = Rows::new(&[0.2, 0.1], reach, &mut memory);
        Among::new(EXACT, [0.1, 1.0], &map).push(&[0.0, 2.0], 0.0, &mut rows);
        assert!(rows.program.is_full());
        assert_eq!(rows.closest().displacement_m, [0.0, 0.0]);
    }
}
