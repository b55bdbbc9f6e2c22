//! Broken rows and sums where there are robots of other teams.

use super::Mutant;

const SLOTS: &str = "core/src/robot/slots.rs";

pub(crate) const TEAMS: [Mutant; 5] = [
    Mutant {
        name: "teams: no near rows for robots of other teams",
        law: "distance",
        lines: &[
            (
                "core/src/controller/budget/control.rs",
                "self.budget.push_stranger(&sighting_of(slot), &mut rows);",
                "let _ = slot;",
            ),
            (
                "core/src/controller/links/control.rs",
                "others.chain(view.strangers.iter().map(Beside::stranger))",
                "others.chain(view.strangers[..0].iter().map(Beside::stranger))",
            ),
        ],
    },
    Mutant {
        name: "teams: robots of other teams count",
        law: "spare",
        lines: &[("core/src/robot/tick.rs", "slots: self.neighbors(),", "slots: self.everybody(),")],
    },
    Mutant {
        name: "teams: values of other teams are heard",
        law: "interval",
        lines: &[
            (
                "core/src/robot/round.rs",
                "for slot in self.neighbors().iter().filter(",
                "for slot in self.everybody().iter().filter(",
            ),
            (SLOTS, "self.find(sender).filter(|_| self.is_member(sender))", "self.find(sender)"),
        ],
    },
    Mutant {
        name: "teams: no room is asked for between teams",
        law: "distance",
        lines: &[(
            "sim/src/world/door.rs",
            "return Some(Refused::Stranger { distance_m, needed_m: self.needed_m });",
            "let _ = distance_m;",
        )],
    },
    Mutant {
        name: "teams: who is too near to an obstacle does not say so",
        law: "mode",
        lines: &[(
            "core/src/controller/clearance.rs",
            "rows.count_obstacle(missing_m - self.error_m > HAIR_M);",
            "let _ = HAIR_M;",
        )],
    },
];
