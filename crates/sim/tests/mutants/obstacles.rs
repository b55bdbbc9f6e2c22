//! Broken rows for obstacles and for speed limits in any direction.

use super::Mutant;

const CLEARANCE: &str = "core/src/controller/clearance.rs";

pub(crate) const OBSTACLES: [Mutant; 5] = [
    Mutant {
        name: "obstacles: no rows",
        law: "clear",
        lines: &[(
            CLEARANCE,
            "if may_bind(program.reach.lhs_max(&toward_m, self.error_m, 0.0), bound_m2) {",
            "if false {",
        )],
    },
    Mutant {
        name: "obstacles: radii forgotten",
        law: "clear",
        lines: &[(CLEARANCE, "least_m - obstacle.radius_m - self.keep_m", "least_m - self.keep_m")],
    },
    Mutant {
        name: "obstacles: errors of the own place forgotten",
        law: "clear",
        lines: &[(CLEARANCE, "{ 0.0 } else { settings.errors.position_m };", "{ 0.0 } else { 0.0 };")],
    },
    Mutant {
        name: "obstacles: twice of what is left",
        law: "clear",
        lines: &[(CLEARANCE, "let bound_m2 = least_m *", "let bound_m2 = 2.0 * least_m *")],
    },
    Mutant {
        name: "obstacles: the disc of velocities forgotten",
        law: "input",
        lines: &[
            (
                "core/src/program/balls/mod.rs",
                "if let Some(ball_m) = reach.ball_m() {",
                "if let Some(ball_m) = None::<f64> {",
            ),
            (
                "core/src/program/mod.rs",
                "if self.is_in_ball(&boxed) { boxed }",
                "if length(&boxed) < f64::INFINITY { boxed }",
            ),
        ],
    },
];
