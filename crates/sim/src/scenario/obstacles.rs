//! What stands in the way: discs and walls, listed or drawn, and what robots make of them.

use closeranks_core::num::{Vector, add_scaled};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX};

use crate::geometry::squared_distance;
use crate::parse::column::Column;
use crate::parse::common::{NOT_NEGATIVE, POSITION, POSITIVE, set, small};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};
use crate::scenario::turn::{gap_m, turned};

/// Greatest number of obstacles: every robot looks at all of them in every tick.
pub const OBSTACLES_MAX: usize = 1_000;

/// How often a place is drawn for an obstacle before there is none.
const TRIES: u32 = 200;

/// The obstacles of a scenario, in whichever dimension; in the plane the third numbers are 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obstacles {
    /// Discs first, then walls.
    pub list: Vec<Obstacle<3>>,
    /// How many of them are discs.
    pub discs: usize,
    /// True if wishes are turned along obstacles, to the side on which the middle of those in sight lies.
    pub turn: bool,
    /// Which of them cut links.
    pub which_cut: Cutting,
}

/// Which obstacles cut links.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cutting {
    /// None: messages go through them.
    #[default]
    None,
    /// Discs alone.
    Discs,
    /// Walls alone.
    Walls,
    /// Discs and walls.
    All,
}

impl Obstacles {
    /// In the dimension of the scenario.
    #[must_use]
    pub fn in_dimension<const D: usize>(&self) -> Vec<Obstacle<D>> {
        let point = |x: &Vector<3>| core::array::from_fn(|d| x.get(d).copied().unwrap_or(0.0));
        let of = |one: &Obstacle<3>| Obstacle {
            from_m: point(&one.from_m),
            to_m: point(&one.to_m),
            radius_m: one.radius_m,
            cuts_links: one.cuts_links,
        };
        self.list.iter().map(of).collect()
    }

    /// True if something of the map cuts links.
    #[must_use]
    pub fn cut_links(&self) -> bool {
        self.list.iter().any(|obstacle| obstacle.cuts_links)
    }

    /// Those that cut links, in the dimension of the scenario.
    #[must_use]
    pub fn cutting<const D: usize>(&self) -> Vec<Obstacle<D>> {
        self.in_dimension().into_iter().filter(|obstacle| obstacle.cuts_links).collect()
    }

    /// The same obstacles, of which those of `cutting` cut links.
    #[must_use]
    pub(crate) fn that_cut(mut self, cutting: Cutting) -> Self {
        let [discs, walls] = match cutting {
            Cutting::None => [false; 2],
            Cutting::Discs => [true, false],
            Cutting::Walls => [false, true],
            Cutting::All => [true; 2],
        };
        for (index, obstacle) in self.list.iter_mut().enumerate() {
            obstacle.cuts_links = if index < self.discs { discs } else { walls };
        }
        Self { which_cut: cutting, ..self }
    }

    /// The field of a file in which the obstacle `index` stands.
    pub(crate) fn field(&self, index: usize) -> String {
        match index.checked_sub(self.discs) {
            None => format!("obstacles.discs[{index}]"),
            Some(wall) => format!("obstacles.walls[{wall}]"),
        }
    }

    /// The first robot at `positions_m` that is nearer than `keep_m` to an obstacle: both indices, and how far away it is, m.
    pub(crate) fn too_near<const D: usize>(
        &self,
        positions_m: &[Vector<D>],
        keep_m: f64,
    ) -> Option<(usize, usize, f64)> {
        let obstacles = self.in_dimension::<D>();
        let pairs = positions_m.iter().enumerate().flat_map(|(robot, x)| {
            obstacles.iter().enumerate().map(move |(index, one)| (robot, index, gap_m(one, x)))
        });
        pairs.into_iter().find(|(_, _, gap_m)| *gap_m < keep_m)
    }

    /// Turns the wishes of robots at `positions_m` that see each other within `sight_m`, if wishes are turned.
    pub(crate) fn turn<const D: usize>(
        &self,
        positions_m: &[Vector<D>],
        [sight_m, keep_m]: [f64; 2],
        wishes_m_s: &mut [Vector<D>],
    ) {
        if !self.turn {
            return;
        }
        let obstacles = self.in_dimension::<D>();
        for (wish, x) in wishes_m_s.iter_mut().zip(positions_m) {
            *wish = turned(wish, x, &middle(x, positions_m, sight_m), &obstacles, keep_m);
        }
    }

    /// Reads the lists of the table; obstacles that are drawn come later.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, dimension: usize) -> Self {
        let (place, radius) = (&POSITION[..dimension], Column::new("radius_m", POSITIVE));
        let (disc, wall) = ([place, &[radius]].concat(), [place, place].concat());
        let (mut discs, mut walls) = (Vec::new(), Vec::new());
        set(&mut discs, reader.rows(section, "discs", &disc));
        set(&mut walls, reader.rows(section, "walls", &wall));
        if discs.len() + walls.len() > OBSTACLES_MAX {
            let found = format!("{} discs and {} walls", discs.len(), walls.len());
            reader.refuse("obstacles", found, format!("at most {OBSTACLES_MAX} together"));
        }
        let mut read = Self::default();
        set(&mut read.turn, reader.word(section, "turn", &[("none", false), ("middle", true)]));
        let disc = |row: &Vec<f64>| Obstacle::disc(point(&row[..dimension]), row[dimension]);
        read.list.extend(discs.iter().map(disc));
        read.discs = read.list.len();
        let wall = |row: &Vec<f64>| Obstacle::wall(point(&row[..dimension]), point(&row[dimension..]));
        read.list.extend(walls.iter().map(wall));
        let which = [
            ("none", Cutting::None),
            ("discs", Cutting::Discs),
            ("walls", Cutting::Walls),
            ("all", Cutting::All),
        ];
        let cutting = reader.word(section, "cuts_links", &which).unwrap_or_default();
        read.that_cut(cutting)
    }
}

/// The middle of those within `sight_m` of `x`, itself among them.
fn middle<const D: usize>(x: &Vector<D>, positions_m: &[Vector<D>], sight_m: f64) -> Vector<D> {
    let near = positions_m.iter().filter(|other| squared_distance(x, other) <= sight_m * sight_m);
    let (mut sum, mut count) = ([0.0; D], 0.0);
    for other in near {
        sum = add_scaled(&sum, 1.0, other);
        count += 1.0;
    }
    sum.map(|part| part / count)
}

/// A point of the plane or of space, m.
fn point(x: &[f64]) -> Vector<3> {
    core::array::from_fn(|d| x.get(d).copied().unwrap_or(0.0))
}

/// Obstacles that are drawn around a start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// How many discs, at most.
    pub discs: u16,
    /// How many walls, at most.
    pub walls: u16,
    /// Radii of discs, and half the lengths of walls, are between these, m.
    pub size_m: [f64; 2],
    /// Their middles lie in the cube of this half side, m.
    pub half_side_m: f64,
}

impl Drawn {
    /// Reads the table `drawn`.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        let most = 0..101;
        let least_m = reader.number_or(section, "size_min_m", POSITIVE, 0.1);
        let sizes = Allowed::Closed(least_m, MAGNITUDE_MAX);
        Self {
            discs: reader.whole(section, "discs", most.clone()).map_or(0, small),
            walls: reader.whole(section, "walls", most).map_or(0, small),
            size_m: [least_m, reader.number_or(section, "size_max_m", sizes, least_m.max(0.5))],
            half_side_m: reader.number_or(section, "half_side_m", NOT_NEGATIVE, 3.0),
        }
    }

    /// Discs and walls, none nearer than `keep_m` to any of `positions_m`. One that finds no place is left out.
    pub(crate) fn draw<const D: usize>(
        &self,
        positions_m: &[Vector<D>],
        keep_m: f64,
        seed: u64,
    ) -> Obstacles {
        let mut random = Random::new(seed, Stream::Obstacles);
        let mut drawn = Obstacles::default();
        for index in 0..self.discs + self.walls {
            let tried = (0..TRIES).map(|_| self.one::<D>(index < self.discs, &mut random));
            let free = |one: &Obstacle<D>| positions_m.iter().all(|x| gap_m(one, x) >= keep_m);
            let Some(found) = tried.into_iter().find(free) else { continue };
            let (from_m, to_m) = (point(&found.from_m), point(&found.to_m));
            drawn.list.push(Obstacle { radius_m: found.radius_m, ..Obstacle::wall(from_m, to_m) });
            drawn.discs += usize::from(index < self.discs);
        }
        drawn
    }

    fn one<const D: usize>(&self, is_disc: bool, random: &mut Random) -> Obstacle<D> {
        let half_m = self.half_side_m;
        let middle_m: Vector<D> = core::array::from_fn(|_| random.uniform(-half_m, half_m));
        let size_m = random.uniform(self.size_m[0], self.size_m[1]);
        if is_disc {
            return Obstacle::disc(middle_m, size_m);
        }
        let way: Vector<D> = random.in_ball();
        let along = |sign: f64| core::array::from_fn(|d| middle_m[d] + sign * size_m * way[d]);
        Obstacle::wall(along(-1.0), along(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawn_obstacles_leave_room_around_every_start() {
        let drawn = Drawn { discs: 3, walls: 2, size_m: [0.1, 0.6], half_side_m: 2.0 };
        let positions_m = [[0.0, 0.0], [0.6, 0.0], [0.3, 0.5]];
        let mut counts = 0;
        for seed in 0..50 {
            let obstacles = drawn.draw(&positions_m, 0.2, seed);
            assert_eq!(obstacles.too_near(&positions_m, 0.2), None);
            assert_eq!(obstacles, drawn.draw(&positions_m, 0.2, seed));
            counts += obstacles.list.len();
        }
        assert!(counts > 240, "{counts}");
        let crowded = Drawn { half_side_m: 0.0, ..drawn }.draw(&positions_m, 0.2, 1);
        assert_eq!(crowded, Obstacles::default());
    }
}
