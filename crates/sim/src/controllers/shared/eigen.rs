//! Eigenvalues and eigenvectors of small symmetric matrices, by Jacobi's rotations: the same bits everywhere, with square roots
//! alone.

use closeranks_core::num::sqrt;

/// Sweeps over all pairs; convergence is quadratic, and ten are more than enough.
const SWEEPS: usize = 30;

/// The eigenvalues of `matrix` in rising order, each with its eigenvector of length 1. `matrix` is symmetric, row by row.
pub(in crate::controllers) fn eigen(mut matrix: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let size = matrix.len();
    let mut vectors: Vec<Vec<f64>> =
        (0..size).map(|i| (0..size).map(|j| if i == j { 1.0 } else { 0.0 }).collect()).collect();
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..size {
            for q in p + 1..size {
                turned |= turn(&mut matrix, &mut vectors, p, q);
            }
        }
        if !turned {
            break;
        }
    }
    let mut pairs: Vec<(f64, Vec<f64>)> =
        vectors.into_iter().enumerate().map(|(k, vector)| (matrix[k][k], vector)).collect();
    pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
    pairs
}

/// Rotates axes p and q so that the entry between them vanishes. False if it already is as good as 0.
fn turn(matrix: &mut [Vec<f64>], vectors: &mut [Vec<f64>], p: usize, q: usize) -> bool {
    let (between, span) = (matrix[p][q], matrix[p][p].abs() + matrix[q][q].abs());
    if between.abs() <= f64::EPSILON * span || between == 0.0 {
        return false;
    }
    let slope = (matrix[q][q] - matrix[p][p]) / (2.0 * between);
    let tangent = if slope < 0.0 { -1.0 } else { 1.0 } / (slope.abs() + sqrt(slope * slope + 1.0));
    let cosine = 1.0 / sqrt(tangent * tangent + 1.0);
    let sine = tangent * cosine;
    for row in matrix.iter_mut() {
        (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
    }
    rotate_rows(matrix, [p, q], [cosine, sine]);
    rotate_rows(vectors, [p, q], [cosine, sine]);
    true
}

fn rotate_rows(rows: &mut [Vec<f64>], [p, q]: [usize; 2], [cosine, sine]: [f64; 2]) {
    for k in 0..rows.len() {
        let (x, y) = (rows[p][k], rows[q][k]);
        (rows[p][k], rows[q][k]) = (cosine * x - sine * y, sine * x + cosine * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_are_orthogonal_and_give_the_matrix_back() {
        let size = 9;
        let entry =
            |i: usize, j: usize| f64::from(u16::try_from((3 * i + 5 * j) % 7 + (3 * j + 5 * i) % 7).unwrap());
        let matrix: Vec<Vec<f64>> = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
        let pairs = eigen(matrix.clone());
        assert!(pairs.is_sorted_by(|one, next| one.0 <= next.0));
        for i in 0..size {
            for j in 0..size {
                let product: f64 = (0..size).map(|k| pairs[i].1[k] * pairs[j].1[k]).sum();
                assert!((product - if i == j { 1.0 } else { 0.0 }).abs() < 1e-12);
                let back: f64 = pairs.iter().map(|(value, vector)| value * vector[i] * vector[j]).sum();
                assert!((back - matrix[i][j]).abs() < 1e-11);
            }
        }
    }
}
