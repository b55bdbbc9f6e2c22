//! Vectors, constant on each of five parts, for which numbers of links break what is known of the whole graph.

use alloc::vec::Vec;

use super::parts::{Counts, PARTS, pair};
use super::rules::{Facts, Rule};
use super::simplex::float;

/// Vectors are rounded to whole numbers up to this.
const ENTRY_MOST: f64 = 1024.0;

/// A smaller breach is none.
const BREACH_LEAST: f64 = 1e-6;

/// Turns of all planes until a matrix of five rows is as good as diagonal.
const TURNS: usize = 7;

type Matrix = [[f64; PARTS]; PARTS];

/// The rules of eigenvalues that numbers of links break, one for each direction.
pub(super) fn eigenvalue_rules(facts: &Facts, counts: &Counts, links: &[f64]) -> Vec<Rule> {
    let scale = roots(counts);
    let mut rules = Vec::new();
    for end in 0..2 {
        let (values, directions) = directions(difference(facts, counts, links, &scale, end));
        for direction in (0..PARTS).filter(|direction| values[*direction] < -BREACH_LEAST) {
            let vector =
                whole(core::array::from_fn(|part| directions[part][direction] / scale[part]), counts);
            rules.push(if end == 0 { Rule::Least(vector) } else { Rule::Most(vector) });
        }
    }
    rules
}

fn roots(counts: &Counts) -> [f64; PARTS] {
    counts.map(|count| root(float(count.max(1))))
}

/// The Laplacian of the parts less λ times what it bounds, or Λ times that less the Laplacian, on vectors of length 1.
fn difference(facts: &Facts, counts: &Counts, links: &[f64], scale: &[f64; PARTS], end: usize) -> Matrix {
    let bound = float(facts.ends[end]) / float(i128::from(crate::spectrum::SCALE));
    let nodes = f64::from(facts.nodes);
    let sign = if end == 0 { 1.0 } else { -1.0 };
    let mut matrix = [[0.0; PARTS]; PARTS];
    for one in 0..PARTS {
        for other in 0..PARTS {
            let both = -float(counts[one] * counts[other]) / nodes;
            let spread = if one == other { float(counts[one]) + both } else { both };
            let laplacian = if one == other {
                (0..PARTS).filter(|part| *part != one).map(|part| links[pair(one, part)]).sum()
            } else {
                -links[pair(one, other)]
            };
            matrix[one][other] = sign * (laplacian - bound * spread) / (scale[one] * scale[other]);
        }
    }
    matrix
}

/// Eigenvalues and eigenvectors, one in each column, by Jacobi's turns.
fn directions(mut matrix: Matrix) -> ([f64; PARTS], Matrix) {
    let mut vectors = [[0.0; PARTS]; PARTS];
    for part in 0..PARTS {
        vectors[part][part] = 1.0;
    }
    for _ in 0..TURNS {
        for one in 0..PARTS {
            for other in one + 1..PARTS {
                turn(&mut matrix, &mut vectors, one, other);
            }
        }
    }
    (core::array::from_fn(|part| matrix[part][part]), vectors)
}

/// Turns the plane of two axes so that the entry they share becomes 0.
fn turn(matrix: &mut Matrix, vectors: &mut Matrix, one: usize, other: usize) {
    if matrix[one][other].abs() < 1e-14 {
        return;
    }
    let slope = (matrix[other][other] - matrix[one][one]) / (2.0 * matrix[one][other]);
    let sign = if slope < 0.0 { -1.0 } else { 1.0 };
    let tangent = sign / (slope.abs() + root(slope * slope + 1.0));
    let cosine = 1.0 / root(tangent * tangent + 1.0);
    let sine = tangent * cosine;
    let mix = |low: f64, high: f64| (cosine * low - sine * high, sine * low + cosine * high);
    for row in matrix.iter_mut() {
        (row[one], row[other]) = mix(row[one], row[other]);
    }
    for column in 0..PARTS {
        (matrix[one][column], matrix[other][column]) = mix(matrix[one][column], matrix[other][column]);
    }
    for row in vectors.iter_mut() {
        (row[one], row[other]) = mix(row[one], row[other]);
    }
}

/// The vector times what makes its largest entry [`ENTRY_MOST`], rounded; 0 on parts without nodes.
fn whole(vector: [f64; PARTS], counts: &Counts) -> [i32; PARTS] {
    let present = |part: usize| if counts[part] > 0 { vector[part] } else { 0.0 };
    let most = (0..PARTS).map(|part| present(part).abs()).fold(f64::MIN_POSITIVE, f64::max);
    core::array::from_fn(|part| nearest(present(part) / most * ENTRY_MOST))
}

/// The nearest whole number of one that is not large.
#[expect(
    clippy::cast_possible_truncation,
    reason = "at most 2^31 in size, or else a vector that is of no use"
)]
fn nearest(value: f64) -> i32 {
    (value + if value < 0.0 { -0.5 } else { 0.5 }) as i32
}

/// The largest whole number that is not above.
#[expect(
    clippy::cast_possible_truncation,
    reason = "at most 2^31 in size, or else a vector that is of no use"
)]
pub(super) fn floor(value: f64) -> i32 {
    let toward_zero = value as i32;
    toward_zero - i32::from(f64::from(toward_zero) > value)
}

/// The square root by Newton's method; the exponent is halved first.
fn root(value: f64) -> f64 {
    let mut root = f64::from_bits((value.to_bits() >> 1) + (1023 << 51));
    for _ in 0..5 {
        root = 0.5 * (root + value / root);
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_whole_numbers() {
        for value in [1e-12, 0.5, 1.0, 2.0, 9.0, 12345.0, 1e12] {
            assert!((root(value) * root(value) / value - 1.0).abs() < 1e-14, "{value}");
        }
        assert_eq!([-1.5, -1.0, -0.2, 0.0, 0.7, 2.0].map(floor), [-2, -1, -1, 0, 0, 2]);
        assert_eq!([-1.6, -1.4, 0.4, 0.6].map(nearest), [-2, -1, 0, 1]);
    }

    #[test]
    fn directions_are_eigenvectors() {
        let mut matrix = [[0.0; PARTS]; PARTS];
        for (one, row) in matrix.iter_mut().enumerate() {
            for (other, entry) in row.iter_mut().enumerate() {
                *entry = f64::from(u8::try_from(1 + (one * other) % 4 + (one + other) % 3).unwrap());
            }
        }
        let (values, vectors) = directions(matrix);
        for column in 0..PARTS {
            for row in 0..PARTS {
                let image: f64 = (0..PARTS).map(|part| matrix[row][part] * vectors[part][column]).sum();
                assert!((image - values[column] * vectors[row][column]).abs() < 1e-9, "{row} {column}");
            }
        }
    }
}
