//! What runs came to, for people, for machines, and as files.

pub(crate) mod as_run;
pub(crate) mod json;
pub(crate) mod pages;
pub(crate) mod recorder;
pub(crate) mod tape;
