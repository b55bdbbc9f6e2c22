//! The numbers of an advice for machines.

use closeranks_sim::advice::cost::{Cost, Stated};
use closeranks_sim::advice::patch::{self, Spacings};
use closeranks_sim::advice::{Advice, Fit};
use closeranks_sim::scenario::start::Start;
use closeranks_sweep::PROGRAM;
use serde_json::{Map, Value, json};

use super::Asked;

/// Everything. Numbers that do not exist are null.
pub(super) fn advice(asked: &Asked, advice: &Advice) -> Value {
    let fits = advice.fits.iter().map(|one| (one.assume.to_owned(), fit(one)));
    json!({
        "version": PROGRAM.version,
        "commit": PROGRAM.commit,
        "asked": question(asked, advice),
        "controller": asked.talk.controller(),
        "exists": advice.fit().exists(),
        "start": start(asked, advice),
        "assume": fits.collect::<Map<_, _>>(),
        "speed_max_m_s": advice.limits.speed_m_s,
        "tick_max_s": advice.limits.tick_s,
        "errors": advice.costs.iter().map(cost).collect::<Value>(),
        "start_of_file": asked.start.as_ref().map(|start| json!({
            "inside": start.inside,
            "h_min": start.h_min,
            "degree_min": start.degree_min,
            "distance_min_m": start.distance_min_m,
        })),
    })
}

fn question(asked: &Asked, advice: &Advice) -> Value {
    let (question, scenario) = (&asked.question, asked.question.settled());
    json!({
        "robots": scenario.team.robots,
        "faults": scenario.team.faults,
        "dimension": scenario.dimension,
        "radius_m": scenario.link.radius_m,
        "q2": advice.fit().link.q2,
        "epsilon": advice.fit().link.q1 - 2.0,
        "distance_min_m": scenario.limits.distance_min_m,
        "axis_speed_m_s": question.axis_speed_m_s(),
        "speed_m_s": question.speed_m_s(),
        "tick_s": scenario.tick_s(),
        "hold_max_s": scenario.clock.hold_max().as_secs_f64(),
        "move_max_m": question.move_max_m(),
        "position_error_m": scenario.errors.position_m,
        "tracking_error_m": scenario.errors.tracking_m,
        "assume": advice.fit().assume,
        "controller_of_file": asked.controller,
    })
}

/// The start with most room, as a scenario has it.
fn start(asked: &Asked, advice: &Advice) -> Option<Value> {
    let (best, scenario) = (advice.fit().spacings.best?, &asked.question.scenario);
    match patch::start(scenario.team.robots, best.spacing_m, scenario.dimension) {
        Start::Hexagon { spacing_m } => Some(json!({ "kind": "hexagon", "spacing_m": spacing_m })),
        Start::Listed(positions_m) => Some(json!({ "kind": "listed", "positions_m": positions_m })),
        _ => None,
    }
}

fn fit(fit: &Fit) -> Value {
    let Fit { counts, spacings: of, .. } = fit;
    json!({
        "exists": fit.exists(),
        "need": counts.need,
        "counted": counts.counted,
        "h_most": counts.h_most,
        "faults_max": counts.faults_max,
        "faults_max_apart": counts.faults_max_apart,
        "robots_min": counts.robots_min,
        "spacings": spacings(of),
    })
}

fn spacings(of: &Spacings) -> Value {
    json!({
        "least_m": of.least_m,
        "h_at_least": of.h_at_least,
        "largest_m": of.largest_m,
        "most_room": of.best.map(|best| json!({
            "spacing_m": best.spacing_m,
            "h": best.h,
            "share": best.share,
        })),
    })
}

fn cost(cost: &Cost) -> Value {
    json!({
        "error": name(cost.error),
        "stated": cost.stated,
        "link_m": cost.link_m,
        "apart_m": cost.apart_m,
        "move_max_m": cost.move_max_m,
        "h": cost.h,
        "h_lost": cost.h_lost,
        "spacings": spacings(&cost.spacings),
    })
}

fn name(error: Stated) -> &'static str {
    match error {
        Stated::Nothing => "nothing",
        Stated::Position => "position",
        Stated::Tracking => "tracking",
        Stated::Hold => "hold",
        Stated::All => "all",
    }
}
