//! Where robots start.

use closeranks_core::num::{Vector, sqrt};

use crate::scenario::scatter::{TRIES, scatter};

/// Start positions x_i(t₀).
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// The eleven positions read from the published figure. Robots 1 and 10 stand 0.2236 m apart: outside the paper's own
    /// safe set (docs/theory, sec:start).
    Published,
    /// Ours: a hexagonal patch of spacing 0.6 m, inside the safe set in all three scenarios.
    Inside,
    /// The lattice points nearest to the origin, numbered from the centre out; two dimensions.
    Hexagon {
        /// Distance of nearest neighbours, m.
        spacing_m: f64,
    },
    /// Drawn evenly from the cube `[−half_side, half_side]^D`, at least `distance_min` apart.
    Random {
        /// Half the side of the cube, m.
        half_side_m: f64,
        /// Least distance of two robots, m.
        distance_min_m: f64,
    },
    /// One position a robot, each with one number a dimension, m.
    Listed(Vec<Vec<f64>>),
}

/// Why there is no start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The preset is for another team.
    #[error("start `{preset}` has 11 robots in 2 dimensions, not {robots} in {dimension}")]
    Preset {
        /// Which preset it is.
        preset: &'static str,
        /// n.
        robots: u16,
        /// D.
        dimension: usize,
    },
    /// The hexagonal lattice is flat.
    #[error("start `hexagon` has 2 dimensions, not {0}")]
    Flat(usize),
    /// Positions and robots differ in number, or a position has the wrong number of coordinates.
    #[error("{found} positions of {dimension} coordinates for {robots} robots")]
    Count {
        /// How many positions are good.
        found: usize,
        /// D.
        dimension: usize,
        /// n.
        robots: u16,
    },
    /// The generator gave up: so many robots fit, the next did not in 10,000 draws.
    #[error(
        "the box is too full: {placed} of {robots} robots found a place at least {distance_min_m} m from the others, \
         the next one did not in up to {TRIES} tries; allowed is a larger half_side_m or a smaller distance_min_m"
    )]
    Full {
        /// How many found a place.
        placed: usize,
        /// n.
        robots: u16,
        /// How far apart they had to be, m.
        distance_min_m: f64,
    },
}

/// Robots 1 to 11 as read from the published figure, m; malicious there are 1 and 2.
pub const PUBLISHED_M: [[f64; 2]; 11] = [
    [-1.1, 0.4],
    [-0.8, -0.1],
    [0.8, -0.3],
    [0.1, -1.2],
    [0.4, -0.7],
    [-0.5, -1.0],
    [-0.9, -0.4],
    [1.0, 0.8],
    [0.4, 0.9],
    [-0.9, 0.5],
    [1.3, 0.3],
];

/// Lattice places (column in half spacings, row) of robots 1 to 11 in `inside`.
///
/// The patch is 4 + 3 + 4 robots. The assignment of robots to places was chosen so that the paper's three effects show
/// together, as they do for one assignment in four (`examples/choose_inside.rs`, docs/paper.md).
const INSIDE_PLACES: [[i8; 2]; 11] =
    [[-3, -1], [2, 0], [0, 0], [-1, -1], [1, 1], [3, 1], [-1, 1], [-2, 0], [3, -1], [1, -1], [-3, 1]];

/// Spacing of `inside`, m.
pub const INSIDE_SPACING_M: f64 = 0.6;

impl Start {
    /// The positions of so many robots. They are a pure function of the arguments, computed in bounded time.
    pub fn positions<const D: usize>(&self, robots: u16, seed: u64) -> Result<Vec<Vector<D>>, StartError> {
        match self {
            Self::Published => preset("published", &PUBLISHED_M, robots),
            Self::Inside => {
                preset("inside", &INSIDE_PLACES.map(|place| lattice(place, INSIDE_SPACING_M)), robots)
            }
            Self::Hexagon { spacing_m } => hexagon(robots, *spacing_m),
            Self::Random { half_side_m, distance_min_m } => {
                scatter(robots, seed, *half_side_m, *distance_min_m).map_err(|placed| StartError::Full {
                    placed,
                    robots,
                    distance_min_m: *distance_min_m,
                })
            }
            Self::Listed(positions) => listed(positions, robots),
        }
    }
}

fn preset<const D: usize>(
    name: &'static str,
    places: &[[f64; 2]; 11],
    robots: u16,
) -> Result<Vec<Vector<D>>, StartError> {
    if D != 2 || robots != 11 {
        return Err(StartError::Preset { preset: name, robots, dimension: D });
    }
    Ok(places.iter().map(|place| core::array::from_fn(|d| place[d])).collect())
}

/// Position of a lattice place: columns count half spacings, rows are `√3/2` spacings apart.
fn lattice([column, row]: [i8; 2], spacing_m: f64) -> [f64; 2] {
    [0.5 * spacing_m * f64::from(column), 0.5 * sqrt(3.0) * spacing_m * f64::from(row)]
}

fn hexagon<const D: usize>(robots: u16, spacing_m: f64) -> Result<Vec<Vector<D>>, StartError> {
    if D != 2 {
        return Err(StartError::Flat(D));
    }
    // A disc of k rings holds more than 3k² places; squared distances in the lattice are the integers q² + q r + r².
    let rings = (1_i32..200).find(|k| 3 * k * k >= i32::from(robots)).unwrap_or(200);
    let mut places = Vec::new();
    for r in -rings..=rings {
        for q in -rings..=rings {
            places.push((q * q + q * r + r * r, r, q));
        }
    }
    places.sort_unstable();
    places.truncate(usize::from(robots));
    let position = |&(_, r, q): &(i32, i32, i32)| {
        let flat =
            [spacing_m * (f64::from(q) + 0.5 * f64::from(r)), spacing_m * 0.5 * sqrt(3.0) * f64::from(r)];
        core::array::from_fn(|d| flat[d])
    };
    Ok(places.iter().map(position).collect())
}

fn listed<const D: usize>(positions: &[Vec<f64>], robots: u16) -> Result<Vec<Vector<D>>, StartError> {
    let good = positions.iter().filter_map(|position| Vector::<D>::try_from(position.as_slice()).ok());
    let good: Vec<Vector<D>> = good.collect();
    if good.len() != positions.len() || good.len() != usize::from(robots) {
        return Err(StartError::Count { found: good.len(), dimension: D, robots });
    }
    Ok(good)
}

#[cfg(test)]
mod tests {
    use closeranks_core::num::dot;

    use super::*;
    use crate::geometry::squared_distance;

    fn least_distance<const D: usize>(positions: &[Vector<D>]) -> f64 {
        let pairs =
            positions.iter().enumerate().flat_map(|(i, x)| positions[..i].iter().map(move |y| (x, y)));
        sqrt(pairs.map(|(x, y)| squared_distance(x, y)).fold(f64::INFINITY, f64::min))
    }

    #[test]
    fn the_published_start_breaks_the_papers_own_hypothesis() {
        let positions = Start::Published.positions::<2>(11, 1).unwrap();
        assert!((least_distance(&positions) - 0.223_6).abs() < 1e-4);
    }

    #[test]
    fn inside_is_a_patch_of_eleven_different_places() {
        let positions = Start::Inside.positions::<2>(11, 1).unwrap();
        assert!((least_distance(&positions) - 0.6).abs() < 1e-12);
    }

    #[test]
    fn hexagons_of_any_size_keep_their_spacing() {
        for robots in [2, 7, 8, 100, 1_000] {
            let positions = hexagon::<2>(robots, 0.6).unwrap();
            assert_eq!(positions.len(), usize::from(robots));
            assert!((least_distance(&positions) - 0.6).abs() < 1e-9);
            let widest = positions.iter().map(|x| dot(x, x)).fold(0.0, f64::max);
            assert!(widest < 0.36 * f64::from(robots), "a patch, not a strip");
        }
    }

    #[test]
    fn a_full_box_is_said_and_not_searched_for_ever() {
        let crowd = Start::Random { half_side_m: 0.5, distance_min_m: 0.6 };
        let error = crowd.positions::<2>(11, 1).unwrap_err();
        assert!(matches!(error, StartError::Full { placed: 1..=6, robots: 11, .. }), "{error}");
    }

    #[test]
    fn random_starts_keep_their_distance_and_follow_the_seed() {
        let start = Start::Random { half_side_m: 2.0, distance_min_m: 0.5 };
        let at = |seed| start.positions::<3>(11, seed).unwrap();
        assert!(least_distance(&at(3)) >= 0.5);
        assert_eq!(at(3), at(3));
        assert_ne!(at(3), at(4));
    }

    #[test]
    fn presets_and_lists_are_for_their_own_team() {
        assert!(Start::Inside.positions::<2>(5, 1).is_err());
        assert!(Start::Published.positions::<3>(11, 1).is_err());
        let list = Start::Listed(vec![vec![0.0, 1.0], vec![1.0]]);
        assert_eq!(list.positions::<2>(2, 1), Err(StartError::Count { found: 1, dimension: 2, robots: 2 }));
    }
}
