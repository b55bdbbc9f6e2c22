//! Whether a matrix has no negative eigenvalue, proved without rounding.

use alloc::vec;
use alloc::vec::Vec;

/// Entries are multiplied by 2^48, so that their square roots have 24 bits after the point.
const BITS: u32 = 48;

/// What is kept back of each entry of the diagonal, to cover what rounding leaves.
const KEPT: i128 = 1 << (BITS - 1);

/// No entry of the factor may be larger, so that no sum overflows. It is enough for diagonals up to 2^32.
const FACTOR_MOST: i128 = 1 << 40;

/// True only if the symmetric matrix M has no negative eigenvalue. False says that this was not seen: one is negative, or less
/// than about 1/2.
///
/// Whole numbers T, a triangle of them, are computed with 2^48 M = T Tᵀ + KEPT I + rest. T need not be exact, because the rest is what
/// remains of each entry. The first has no negative eigenvalue, whatever T is, nor have the other two together if in no
/// row the absolute values of the rest sum to more than KEPT. Entries are at most 2^32, rows at most 128.
//= theory sec:spectrum
pub(super) fn is_semidefinite(matrix: &[Vec<i64>]) -> bool {
    factor(matrix).is_some()
}

/// T, if it was seen.
pub(super) fn factor(matrix: &[Vec<i64>]) -> Option<Vec<Vec<i128>>> {
    let count = matrix.len();
    let mut factor: Vec<Vec<i128>> = vec![vec![0; count]; count];
    let mut rest = vec![0_i128; count];
    for column in 0..count {
        let (root, left) = pivot(matrix, &factor, column)?;
        factor[column][column] = root;
        rest[column] += left;
        for row in column + 1..count {
            let value = open(matrix, &factor, row, column);
            let entry = value / root;
            if entry.abs() > FACTOR_MOST {
                return None;
            }
            factor[row][column] = entry;
            let left = (value - entry * root).abs();
            rest[row] += left;
            rest[column] += left;
        }
    }
    rest.into_iter().all(|sum| sum <= KEPT).then_some(factor)
}

/// The next entry of the diagonal of T, and what its square leaves; `None` if there is none.
fn pivot(matrix: &[Vec<i64>], factor: &[Vec<i128>], column: usize) -> Option<(i128, i128)> {
    let value = open(matrix, factor, column, column) - KEPT;
    let root = i128::try_from(u128::try_from(value).ok()?.isqrt()).ok()?;
    (1..=FACTOR_MOST).contains(&root).then(|| (root, value - root * root))
}

/// What the columns before `column` leave of an entry.
fn open(matrix: &[Vec<i64>], factor: &[Vec<i128>], row: usize, column: usize) -> i128 {
    let before = factor[row][..column].iter().zip(&factor[column][..column]);
    (i128::from(matrix[row][column]) << BITS) - before.map(|(a, b)| a * b).sum::<i128>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_matrices() {
        let of = |rows: &[&[i64]]| is_semidefinite(&rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>());
        assert!(of(&[&[1]]) && of(&[&[2, 1], &[1, 2]]) && of(&[&[1 << 32, 0], &[0, 1]]));
        assert!(!of(&[&[0]]) && !of(&[&[-1]]) && !of(&[&[1, 2], &[2, 1]]));
        // The eigenvalues of the first are 0 and 2: it is not seen. A half of the diagonal is kept back.
        assert!(!of(&[&[1, 1], &[1, 1]]) && of(&[&[2, 1], &[1, 2]]));
        assert!(!of(&[&[1, 1 << 32], &[1 << 32, 1]]), "no overflow");
        assert!(!of(&[&[1, i64::MAX], &[i64::MAX, 1]]), "no overflow");
    }

    /// Determinants of all leading parts by expansion: positive exactly if all eigenvalues are.
    #[test]
    fn all_small_matrices_are_right() {
        for code in 0_i64..7_i64.pow(6) {
            let digit = |place: u32| code / 7_i64.pow(place) % 7 - 3;
            let (a, b, c) = (digit(0) + 2, digit(1) + 2, digit(2) + 2);
            let (d, e, f) = (digit(3), digit(4), digit(5));
            let det2 = a * b - d * d;
            let det3 = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
            let seen = is_semidefinite(&[vec![a, d, e], vec![d, b, f], vec![e, f, c]]);
            // No negative eigenvalue: no main minor is negative.
            let others = [a, b, c, det2, a * c - e * e, b * c - f * f, det3];
            assert!(!seen || others.iter().all(|minor| *minor >= 0), "{code}");
            // With 1 off the diagonal and still positive, it is seen.
            let (a, b, c) = (a - 1, b - 1, c - 1);
            let det3 = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
            assert!(seen || !(a > 0 && a * b > d * d && det3 > 0), "{code}");
        }
    }
}
