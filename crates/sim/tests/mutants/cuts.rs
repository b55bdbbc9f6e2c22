//! Broken rows for links that obstacles would cut.

use super::Mutant;

const CUT: &str = "core/src/controller/links/cut.rs";

pub(crate) const CUTS: [Mutant; 6] = [
    Mutant {
        name: "cuts: no rows",
        law: "held",
        lines: &[(
            CUT,
            "if may_bind(rows.program.reach.lhs_max(&toward_m, turned_m, 0.0), bound_m2) {",
            "if false {",
        )],
    },
    Mutant {
        name: "cuts: only one end has a row",
        law: "held",
        lines: &[(
            "core/src/controller/links/rows.rs",
            "among.push(offset_m, gone_m, &mut rows);",
            "if offset_m[0] > 0.0 { among.push(offset_m, gone_m, &mut rows); }",
        )],
    },
    Mutant {
        name: "cuts: twice of what is left",
        law: "held",
        lines: &[(CUT, "let bound_m2 = larger(", "let bound_m2 = 2.0 * larger(")],
    },
    Mutant {
        name: "cuts: radii forgotten",
        law: "held",
        lines: &[(
            CUT,
            "(gap.turned_m(), obstacle.radius_m + self.cuts.keep_m)",
            "(gap.turned_m(), self.cuts.keep_m)",
        )],
    },
    Mutant {
        name: "cuts: a margin without errors",
        law: "held",
        lines: &[(CUT, "keep_m: bounds.away_m + error_m + HAIR_M", "keep_m: HAIR_M")],
    },
    Mutant {
        name: "cuts: errors of both ends forgotten",
        law: "held",
        lines: &[(CUT, "error_m: self.cuts.error_m + gone_m", "error_m: gone_m")],
    },
];
