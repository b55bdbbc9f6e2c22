//! Held links: a controller without weights. Robots agree on which links they keep, and a link that is kept has a row at
//! both ends.

pub mod protocol;
