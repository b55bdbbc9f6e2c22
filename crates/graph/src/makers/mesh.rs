//! A triangulation that grows from left to right, with edges flipped until no circle around a triangle holds another point.

use alloc::vec;
use alloc::vec::Vec;

/// A point with coordinates below 2^30.
pub(super) type Point = [i64; 2];

/// No half-edge.
const NONE: u32 = u32::MAX;

/// Triangles, three half-edges each: half-edge e goes from `from[e]` to `from[next(e)]`, its triangle at the left.
pub(super) struct Mesh<'a> {
    points: &'a [Point],
    from: Vec<u32>,
    /// The half-edge the other way, `NONE` at the rim.
    twin: Vec<u32>,
    /// The next point of the rim, anticlockwise, and the one before.
    rim_next: Vec<u32>,
    rim_before: Vec<u32>,
    /// The half-edge from a point of the rim to the next.
    rim_edge: Vec<u32>,
    /// Half-edges that may have to be flipped.
    doubtful: Vec<u32>,
    /// So many points at the start are on one line; if it is all, there are no triangles.
    in_line: usize,
}

impl<'a> Mesh<'a> {
    /// The Delaunay triangulation of points in rising order, all different.
    pub(super) fn of(points: &'a [Point]) -> Self {
        let none = || vec![NONE; points.len()];
        let mut mesh = Self {
            points,
            from: Vec::new(),
            twin: Vec::new(),
            rim_next: none(),
            rim_before: none(),
            rim_edge: none(),
            doubtful: Vec::new(),
            in_line: in_line(points),
        };
        if mesh.in_line < points.len() {
            mesh.fan();
            for point in mesh.in_line + 1..points.len() {
                mesh.add(small(point));
                mesh.flip_all();
            }
        }
        mesh
    }

    /// All edges, each once.
    pub(super) fn edges(&self) -> Vec<(u32, u32)> {
        if self.in_line == self.points.len() {
            return (1..small(self.in_line)).map(|to| (to - 1, to)).collect();
        }
        let once = |edge: &u32| *edge < self.twin[*edge as usize];
        let ends = |edge: u32| (self.from[edge as usize], self.from[next(edge) as usize]);
        (0..small(self.from.len())).filter(once).map(ends).collect()
    }

    /// The first triangles: the points on a line, each with the next, and the first point beside it.
    fn fan(&mut self) {
        let top = small(self.in_line);
        let is_left = self.turn(0, 1, top) > 0;
        for low in 0..top - 1 {
            let (one, other) = if is_left { (low, low + 1) } else { (low + 1, low) };
            self.triangle([one, other, top]);
        }
        for low in 1..top - 1 {
            let (before, after) = (3 * (low - 1), 3 * low);
            if is_left { self.join(before + 1, after + 2) } else { self.join(before + 2, after + 1) }
        }
        for edge in 0..small(self.from.len()) {
            if self.twin[edge as usize] == NONE {
                let (one, other) = (self.from[edge as usize], self.from[next(edge) as usize]);
                self.rim_next[one as usize] = other;
                self.rim_before[other as usize] = one;
                self.rim_edge[one as usize] = edge;
            }
        }
    }

    /// Joins a point that is right of all others to all of the rim that it sees. It sees an edge at the newest of them.
    fn add(&mut self, point: u32) {
        let newest = point - 1;
        let (mut first, mut last) = (newest, newest);
        while self.turn(self.rim_before[first as usize], first, point) < 0 {
            first = self.rim_before[first as usize];
        }
        while self.turn(last, self.rim_next[last as usize], point) < 0 {
            last = self.rim_next[last as usize];
        }
        let (mut one, mut before) = (first, NONE);
        while one != last {
            let other = self.rim_next[one as usize];
            let edge = self.triangle([other, one, point]);
            self.join(edge, self.rim_edge[one as usize]);
            self.doubtful.push(edge);
            match before {
                NONE => self.rim_edge[first as usize] = edge + 1,
                before => self.join(before, edge + 1),
            }
            (one, before) = (other, edge + 2);
        }
        self.rim_edge[point as usize] = before;
        for (one, other) in [(first, point), (point, last)] {
            self.rim_next[one as usize] = other;
            self.rim_before[other as usize] = one;
        }
    }

    /// Flips edges until none is left whose circle holds the point across.
    fn flip_all(&mut self) {
        while let Some(edge) = self.doubtful.pop() {
            let other = self.twin[edge as usize];
            if other == NONE || !self.holds(edge, self.from[before(other) as usize]) {
                continue;
            }
            self.flip(edge, other);
            self.doubtful.extend([edge, next(edge), other, next(other)]);
        }
    }

    /// Puts the other diagonal of the two triangles in the place of this one.
    fn flip(&mut self, edge: u32, other: u32) {
        let (side, far) = (before(edge), before(other));
        let (beyond_far, beyond_side) = (self.twin[far as usize], self.twin[side as usize]);
        self.from[edge as usize] = self.from[far as usize];
        self.from[other as usize] = self.from[side as usize];
        self.move_to(edge, beyond_far);
        self.move_to(other, beyond_side);
        self.join(side, far);
    }

    /// The half-edge takes the place of one whose twin, or none at the rim, is given.
    fn move_to(&mut self, edge: u32, twin: u32) {
        if twin == NONE {
            self.twin[edge as usize] = NONE;
            self.rim_edge[self.from[edge as usize] as usize] = edge;
        } else {
            self.join(edge, twin);
        }
    }

    /// A new triangle; tells its first half-edge.
    fn triangle(&mut self, corners: [u32; 3]) -> u32 {
        let edge = small(self.from.len());
        self.from.extend(corners);
        self.twin.extend([NONE; 3]);
        edge
    }

    fn join(&mut self, one: u32, other: u32) {
        self.twin[one as usize] = other;
        self.twin[other as usize] = one;
    }

    /// Positive if the third point is at the left of the way from the first to the second, 0 if on its line.
    fn turn(&self, one: u32, two: u32, three: u32) -> i64 {
        turn([one, two, three].map(|point| self.points[point as usize]))
    }

    /// Whether the circle around the triangle of the half-edge holds the point inside, not on it.
    fn holds(&self, edge: u32, point: u32) -> bool {
        let [x, y] = self.points[point as usize];
        let corner = |edge: u32| {
            let [cx, cy] = self.points[self.from[edge as usize] as usize];
            let (dx, dy) = (i128::from(cx - x), i128::from(cy - y));
            (dx, dy, dx * dx + dy * dy)
        };
        let (a, b, c) = (corner(edge), corner(next(edge)), corner(before(edge)));
        let minor = |one: (i128, i128, i128), two: (i128, i128, i128)| one.0 * two.1 - two.0 * one.1;
        a.2 * minor(b, c) - b.2 * minor(a, c) + c.2 * minor(a, b) > 0
    }
}

/// How many of the points at the start are on one line.
fn in_line(points: &[Point]) -> usize {
    let off = points.iter().position(|point| points.len() > 1 && turn([points[0], points[1], *point]) != 0);
    off.unwrap_or(points.len())
}

fn turn([one, two, three]: [Point; 3]) -> i64 {
    (two[0] - one[0]) * (three[1] - one[1]) - (two[1] - one[1]) * (three[0] - one[0])
}

/// The half-edge that follows in the triangle.
fn next(edge: u32) -> u32 {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

/// The one before.
fn before(edge: u32) -> u32 {
    if edge.is_multiple_of(3) { edge + 2 } else { edge - 1 }
}

fn small(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::Generator;

    /// No circle around a triangle holds any point, all triangles are anticlockwise, and they cover the rim's inside.
    fn check(points: &[Point]) {
        let mesh = Mesh::of(points);
        let mut area = 0;
        for edge in (0..small(mesh.from.len())).step_by(3) {
            let corners = [edge, edge + 1, edge + 2].map(|edge| points[mesh.from[edge as usize] as usize]);
            assert!(turn(corners) > 0, "{points:?}");
            area += turn(corners);
            assert!((0..small(points.len())).all(|point| !mesh.holds(edge, point)), "{points:?}");
        }
        let (mut rim, mut at) = (0, small(points.len()) - 1);
        for _ in 0..points.len() {
            let to = mesh.rim_next[at as usize];
            if to == NONE {
                return assert_eq!(mesh.in_line, points.len());
            }
            let [a, b] = [at, to].map(|point| points[point as usize]);
            rim += a[0] * b[1] - b[0] * a[1];
            at = to;
            if to == small(points.len()) - 1 {
                break;
            }
        }
        assert_eq!(area, rim, "{points:?}");
    }

    #[test]
    fn any_points_are_triangulated() {
        let mut generator = Generator::new(7);
        for case in 0..400 {
            // Few places make many points on one line and on one circle.
            let side = [2, 3, 4, 6, 1000][case % 5];
            let mut points: Vec<Point> = (0..2 + case % 23)
                .map(|_| [(); 2].map(|()| i64::try_from(generator.below(side)).unwrap()))
                .collect();
            points.sort_unstable();
            points.dedup();
            check(&points);
        }
    }

    #[test]
    fn points_in_line_are_a_path() {
        let points: Vec<Point> = (0..5).map(|step| [step, 2 * step]).collect();
        assert_eq!(Mesh::of(&points).edges(), [(0, 1), (1, 2), (2, 3), (3, 4)]);
        check(&points);
        assert!(Mesh::of(&[[0, 0]]).edges().is_empty());
    }
}
