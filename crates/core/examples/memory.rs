//! How many bytes a robot takes with all its memory, for up to so many neighbours: the table in README.md.
//!
//! `cargo run -p closeranks-core --example memory`

use closeranks_core::{MESSAGE_BYTES, SizedRobot};

/// Neighbours, then bytes in the plane, in space, and in the plane with no more rows than are needed without stated errors.
pub(crate) const TABLE: [(usize, [usize; 3]); 5] =
    [row::<3, 4>(), row::<10, 3>(), row::<20, 3>(), row::<50, 3>(), row::<100, 3>()];

const fn row<const N: usize, const K: usize>() -> (usize, [usize; 3]) {
    (N, [size_of::<SizedRobot<2, N>>(), size_of::<SizedRobot<3, N>>(), size_of::<SizedRobot<2, N, K>>()])
}

/// The table as it stands in README.md.
pub(crate) fn table() -> String {
    let head = "neighbours  in the plane  in space  in the plane, least\n";
    let lines = TABLE.map(|(neighbors, [plane, space, least])| {
        format!("{neighbors:10} {plane:13} {space:9} {least:20}\n")
    });
    format!("{head}{}", lines.concat())
}

#[expect(clippy::print_stdout, reason = "a report")]
pub(crate) fn main() {
    print!("{}", table());
    println!("A message has {MESSAGE_BYTES} bytes.");
}
