//! Broken programs that the campaign must catch, each by the law that is there for it.

pub(crate) mod cuts;
pub(crate) mod obstacles;
pub(crate) mod presence;
pub(crate) mod teams;

/// A broken program: what is wrong, the law that must notice, and the lines that are other than they should be.
pub(crate) struct Mutant {
    pub(crate) name: &'static str,
    pub(crate) law: &'static str,
    pub(crate) lines: &'static [(&'static str, &'static str, &'static str)],
}

const TICK: &str = "core/src/controller/budget/mod.rs";
const CONTROL: &str = "core/src/controller/budget/control.rs";
const PROTOCOL: &str = "core/src/controller/links/protocol.rs";
const POLICY: &str = "core/src/controller/links/policy.rs";
const ROWS: &str = "core/src/controller/links/rows.rs";
const LINKS: &str = "core/src/controller/links/control.rs";
const SHARED: &str = "core/src/controller/rows.rs";
const INEQUALITY: &str = "core/src/controller/budget/inequality.rs";

pub(crate) const MUTANTS: [Mutant; 42] = [
    Mutant {
        name: "gradient with the wrong sign",
        law: "decay",
        lines: &[(
            TICK,
            "add_scaled(&own.gradient, 1.0, &gradient)",
            "add_scaled(&own.gradient, -1.0, &gradient)",
        )],
    },
    Mutant {
        name: "share doubled",
        law: "spare",
        lines: &[
            (
                INEQUALITY,
                "self.loss_max(known.budget) / (known.degree_max + 1.0)",
                "self.loss_max(known.budget) / 2.0",
            ),
            (INEQUALITY, "if self.need.is_ranked() { 3.0 } else { own.degree + 1.0 }", "2.0"),
        ],
    },
    Mutant {
        name: "|v|² left out of (far')",
        law: "decay",
        lines: &[(INEQUALITY, "-component), bend, spend)", "-component), 0.0 * bend, spend)")],
    },
    Mutant {
        name: "no row of its own",
        law: "spare",
        lines: &[(
            TICK,
            "        if self.form() == Form::Level {\n            let spend",
            "        if false {\n            let spend",
        )],
    },
    Mutant {
        name: "L at the wrong distance",
        law: "decay",
        lines: &[(
            "core/src/controller/budget/curvature.rs",
            "distance_m + (2.0 * move_max_m + error_m)",
            "0.5 * distance_m",
        )],
    },
    Mutant {
        name: "more counted on than is seen, budgets fourfold",
        law: "spare",
        lines: &[(
            "core/src/controller/budget/knowledge.rs",
            "budget: larger(seen.low - need, 0.0),",
            "budget: 4.0 * larger(seen.low - need, 0.0) + 1.0,",
        )],
    },
    Mutant {
        name: "near rows give too much",
        law: "path",
        lines: &[(
            SHARED,
            "0.5 * gamma_c * larger(spare_m2, 0.0)",
            "2.0 * gamma_c * larger(spare_m2, 0.0) + 0.05",
        )],
    },
    Mutant {
        name: "no near rows",
        law: "distance",
        lines: &[(TICK, "            self.push_near(offset_m, pair, rows);\n", "")],
    },
    Mutant {
        name: "rows left out where robots can break them",
        law: "decay",
        lines: &[("core/src/program/balls/reach.rs", "most * SURELY", "0.2 * most")],
    },
    Mutant {
        name: "a warm start that nobody checks",
        law: "decay",
        lines: &[(
            "core/src/program/balls/warm_start.rs",
            " && self.rows().iter().all(|row| row.holds(&v))",
            "",
        )],
    },
    Mutant {
        name: "no margin for distances",
        law: "distance",
        lines: &[
            (TICK, "self.spare_m2(pair, -error_m)", "self.spare_m2(pair, 0.0)"),
            (INEQUALITY, "self.spare_m2(&pair, -error_m)", "self.spare_m2(&pair, 0.0)"),
        ],
    },
    Mutant {
        name: "F - 1 values trimmed",
        law: "interval",
        lines: &[(
            "core/src/wmsr.rs",
            "(smaller.min(usize::from(faults)), larger.min(usize::from(faults)))",
            "(smaller.min(usize::from(faults).saturating_sub(1)), larger.min(usize::from(faults).saturating_sub(1)))",
        )],
    },
    Mutant {
        name: "two more values trimmed",
        law: "agreement",
        lines: &[(
            "core/src/wmsr.rs",
            "(smaller.min(usize::from(faults)), larger.min(usize::from(faults)))",
            "(smaller.min(usize::from(faults) + 2), larger.min(usize::from(faults) + 2))",
        )],
    },
    Mutant {
        name: "the box forgotten",
        law: "input",
        lines: &[(
            CONTROL,
            "velocity_m_s: self.input.clip(&velocity),",
            "velocity_m_s: velocity.map(|component| 1.1 * component),",
        )],
    },
    Mutant {
        name: "always guaranteed",
        law: "mode",
        lines: &[
            (CONTROL, "Some(reason) => Mode::Degraded(reason),", "Some(_) => Mode::Guaranteed,"),
            (CONTROL, "_ if degree_low => Mode::Degraded(Reason::Degree),", ""),
            (
                CONTROL,
                "None if exact && standing.h < -H_ROUNDING => Mode::Degraded(Reason::OutsideSafeSet),",
                "",
            ),
            (
                CONTROL,
                "let exact = self.budget.is_exact() && standing.missing == 0;",
                "let _ = (degree_low, H_ROUNDING);",
            ),
        ],
    },
    Mutant {
        name: "never guaranteed again",
        law: "mode",
        lines: &[(
            "core/src/robot/assurance.rs",
            "now.is_within(told_max, *then)",
            "now.is_within(2 * told_max, *then)",
        )],
    },
    Mutant {
        name: "missing neighbours forgotten",
        law: "decay",
        lines: &[(
            "core/src/robot/missing.rs",
            "let missing = self.surely_holds(&slot.offset_m, gone_m);",
            "let missing = false;",
        )],
    },
    Mutant {
        name: "missing neighbours taken for those that stand still",
        law: "decay",
        lines: &[(
            "core/src/robot/missing.rs",
            "slot.unsensed_m = if missing { gone_m } else { 0.0 };",
            "slot.unsensed_m = if missing { f64::MIN_POSITIVE } else { 0.0 };",
        )],
    },
    Mutant {
        name: "begins anew without saying so",
        law: "decay",
        lines: &[(
            "core/src/robot/assurance.rs",
            "(self.anew, self.in_time) = (true, false);",
            "(self.anew, self.in_time) = (false, false);",
        )],
    },
    Mutant {
        name: "tolerances that grow with R",
        law: "mode",
        lines: &[(
            "core/src/controller/budget/recovery.rs",
            "let hair_m2 = NEAR_ROUNDING * self.distance_min_m * self.distance_min_m;",
            "let hair_m2 = NEAR_ROUNDING * self.curvature.link().radius_m * self.curvature.link().radius_m;",
        )],
    },
    Mutant {
        name: "tolerances of lengths near 1 m",
        law: "mode",
        lines: &[(
            "core/src/controller/budget/recovery.rs",
            "let hair_m2 = NEAR_ROUNDING * self.distance_min_m * self.distance_min_m;",
            "let hair_m2 = 1e-8;",
        )],
    },
    Mutant {
        name: "rounding at the limit costs a promise",
        law: "mode",
        lines: &[(
            "core/src/controller/budget/recovery.rs",
            "const H_ROUNDING: f64 = 1e-11;",
            "const H_ROUNDING: f64 = 0.0;",
        )],
    },
    Mutant {
        name: "late while it moves, and begun anew where it is",
        law: "mode",
        lines: &[(
            "core/src/robot/assurance.rs",
            "if late && (hold_max != params.settings().clock.level_period || errors.away_m == 0.0) {",
            "if late {",
        )],
    },
    Mutant {
        name: "reports a larger h than it has",
        law: "mode",
        lines: &[(
            "core/src/robot/tick.rs",
            "let h = degree_barrier(self.level, need);",
            "let h = degree_barrier(self.level, need) + 1e-6;",
        )],
    },
    Mutant {
        name: "neighbours in need are followed",
        law: "untowed",
        lines: &[(
            TICK,
            "        let gradient = pair.gradient(offset_m);\n",
            "        let gradient = pair.gradient(offset_m);\n        if known.budget <= 0.0 {\n            rows.desired_m = add_scaled(&rows.desired_m, -0.001, offset_m);\n        }\n",
        )],
    },
    Mutant {
        name: "budgets below 0 taken as they are",
        law: "feasible",
        lines: &[
            (SHARED, "0.5 * gamma_c * larger(spare_m2, 0.0)", "0.5 * gamma_c * spare_m2"),
            ("core/src/program/balls/row.rs", "bound: larger(scale * bound, 0.0),", "bound: scale * bound,"),
        ],
    },
    Mutant {
        name: "one neighbour fewer required",
        law: "degree",
        lines: &[(
            "core/src/need.rs",
            "faults.saturating_add(half)\n}",
            "faults.saturating_add(half).saturating_sub(1)\n}",
        )],
    },
    Mutant {
        name: "links: row dropped when a release is sent",
        law: "held",
        lines: &[(PROTOCOL, "self.is_listed() || !self.is_released()", "self.is_listed()")],
    },
    Mutant {
        name: "links: an older acknowledgement counts",
        law: "held",
        lines: &[(
            PROTOCOL,
            "self.listed_after.is_some_and(|after| after < self.acknowledged)",
            "self.listed_after.is_some() && self.acknowledged > self.born",
        )],
    },
    Mutant {
        name: "links: counted on without being listed",
        law: "held",
        lines: &[
            (
                PROTOCOL,
                "self.listed_after.is_some_and(|after| after < self.acknowledged)",
                "self.acknowledged > self.born",
            ),
            (POLICY, "partner.hold(false);", ""),
        ],
    },
    Mutant {
        name: "links: R without the hair",
        law: "degree",
        lines: &[("core/src/controller/links/mod.rs", "const HAIR: f64 = 1e-9;", "const HAIR: f64 = 0.0;")],
    },
    Mutant {
        name: "links: held rows give too much",
        law: "held",
        lines: &[(ROWS, "0.25 * self.gamma * larger(", "0.6 * self.gamma * larger(")],
    },
    Mutant {
        name: "links: |v|² left out of (held)",
        law: "held",
        lines: &[(ROWS, "Row::far(offset, bound_m2)", "Row::new(*offset, 0.0, bound_m2)")],
    },
    Mutant {
        name: "links: missing neighbours taken for those that stand still",
        law: "decay",
        lines: &[(
            "core/src/controller/links/mod.rs",
            "self.errors.offset_m + gone_m",
            "self.errors.offset_m + 0.0 * gone_m",
        )],
    },
    Mutant {
        name: "links: one release too many",
        law: "degree",
        lines: &[(POLICY, "counted >= keep + usize::from(is_counted)", "counted >= keep")],
    },
    Mutant {
        name: "links: free liars counted as normal",
        law: "degree",
        lines: &[(
            LINKS,
            "Assume::Free => (Keep::NormalNeighbors, settings.team.faults),",
            "Assume::Free => (Keep::NormalNeighbors, 0),",
        )],
    },
    Mutant {
        name: "links: guaranteed without links that are counted on",
        law: "mode",
        lines: &[(
            LINKS,
            ".then_some(Reason::Uncounted);",
            ".then_some(Reason::Uncounted).filter(|_| false);",
        )],
    },
    Mutant {
        name: "ranks: everybody is listed, whatever its rank",
        law: "degree",
        lines: &[
            (POLICY, "partner.is_sensed() && partner.counts_with(own, &self.need)[0]", "partner.is_sensed()"),
            (
                "core/src/controller/links/partner.rs",
                "[need.counts(own, self.member()), need.counts(self.member(), own)]",
                "[true, need.counts(self.member(), own)]",
            ),
            (
                POLICY,
                "counts && sensed && distance_m <= self.begun_m()",
                "sensed && distance_m <= self.begun_m()",
            ),
        ],
    },
    Mutant {
        name: "ranks: the need of a robot of another rank",
        law: "degree",
        lines: &[(
            "core/src/need.rs",
            "if robot.into().rank > 0 => above",
            "if robot.into().rank > 1 => above",
        )],
    },
    Mutant {
        name: "ranks: the core needs one fewer",
        law: "degree",
        lines: &[(
            "core/src/need.rs",
            "in_core: among(core, faults, keep)",
            "in_core: among(core, faults, keep).saturating_sub(1)",
        )],
    },
    Mutant {
        name: "ranks: budget shared with no regard to who else takes",
        law: "spare",
        lines: &[(
            "core/src/controller/budget/knowledge.rs",
            "Form::Level => 3.0 / by_both - 1.0,",
            "Form::Level => 0.0,",
        )],
    },
    Mutant {
        name: "ranks: robots of equal rank count for each other",
        law: "degree",
        lines: &[("core/src/need.rs", "other.rank < robot.rank", "other.rank <= robot.rank")],
    },
];
