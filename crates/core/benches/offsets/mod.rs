//! Where the neighbours of benches stand.

/// Ten neighbours on two rings, as in the paper's formations, m.
pub(crate) const OFFSETS: [[f64; 2]; 10] = [
    [0.6, 0.0],
    [-0.6, 0.1],
    [0.3, 0.52],
    [-0.3, -0.52],
    [1.2, 0.4],
    [-1.1, 0.9],
    [0.2, -1.4],
    [2.1, 1.0],
    [-1.8, -1.6],
    [2.4, -1.3],
];
