//! Broken departures and arrivals.

use super::Mutant;

const DOOR: &str = "sim/src/world/door.rs";

pub(crate) const PRESENCE: [Mutant; 3] = [
    Mutant {
        name: "presence: nobody is told who left",
        law: "mode",
        lines: &[("core/src/robot/slots.rs", "self.keep(|slot| slot.id != id);", "self.keep(|_| id.0 > 0);")],
    },
    Mutant {
        name: "presence: no room is asked for",
        law: "distance",
        lines: &[(DOOR, "if distance_m < self.needed_m {", "if distance_m < 0.5 * self.needed_m {")],
    },
    Mutant {
        name: "presence: who comes remembers",
        law: "mode",
        lines: &[("sim/src/faults/outages.rs", "returns || self.arrived[index]", "returns")],
    },
];
