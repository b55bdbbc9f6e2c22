//! Panels of figures: frame and axes, numbers at them, titles, legends, and where each stands on the page.

pub(crate) mod axes;
pub(crate) mod layout;
pub(crate) mod legend;
pub(crate) mod stroke;
pub(crate) mod ticks;
pub(crate) mod title;
