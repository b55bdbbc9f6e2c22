//! What no single field can tell: ranges that depend on others, and whether the start exists.

use std::collections::BTreeMap;

use closeranks_core::num::Vector;
use closeranks_core::settings::field::Field;
use closeranks_core::settings::params::{Params, ParamsError};
use closeranks_core::settings::range::Allowed;

use super::reader::Reader;
use crate::attack::ListsAttack;
use crate::consensus::Consensus;
use crate::geometry::near::Near;
use crate::geometry::squared_distance;
use crate::plant::Plant;
use crate::scenario::absences::Absence;
use crate::scenario::ranks::RanksError;
use crate::scenario::start::{Start, StartError};
use crate::scenario::{Controller, Limits, Scenario, Values};

/// How many rows (ticks × robots) a run may have at most.
pub const ROWS_MAX: u64 = 200_000_000;

/// How many consensus rounds a run may have at most; what is known of each is kept.
const ROUNDS_MAX: u64 = 10_000_000;

/// Notes in `reader` what cannot be run; `scenario` holds fields that were each read without fault.
pub(super) fn check(reader: &mut Reader, scenario: &Scenario) {
    team(reader, scenario);
    boxes(reader, scenario);
    clocks(reader, scenario);
    values(reader, scenario);
    plant(reader, scenario);
    Consensus::check(reader, scenario);
    Absence::check(reader, scenario);
    if !reader.is_clean() {
        return;
    }
    match scenario.dimension {
        3 => parameters::<3>(reader, scenario),
        _ => parameters::<2>(reader, scenario),
    }
    match scenario.dimension {
        3 => start::<3>(reader, scenario),
        _ => start::<2>(reader, scenario),
    }
    match scenario.dimension {
        3 => obstacles::<3>(reader, scenario),
        _ => obstacles::<2>(reader, scenario),
    }
    if let Some(why) = scenario.refuses_strangers() {
        let with: Vec<_> = Controller::ALL.iter().filter(|of| of.row().runs_among_strangers()).collect();
        let names: Vec<_> = with.iter().map(|of| of.name()).collect();
        reader.refuse("teams", why, format!("several teams only under {}", names.join(", ")));
    }
    if reader.is_clean() {
        match scenario.dimension {
            3 => ranks::<3>(reader, scenario),
            _ => ranks::<2>(reader, scenario),
        }
    }
}

fn parameters<const D: usize>(reader: &mut Reader, scenario: &Scenario) {
    match scenario.params::<D>() {
        Ok(params) => one_by_one(reader, scenario, &params),
        Err(error) => refuse_parameter(reader, scenario, &error),
    }
}

fn team(reader: &mut Reader, scenario: &Scenario) {
    let mut pairs = scenario.malicious.iter().zip(scenario.malicious.iter().skip(1));
    if let Some((robot, _)) = pairs.find(|(first, second)| first == second) {
        let place = reader.second("team.malicious", f64::from(*robot));
        reader.refuse(&place, format!("robot {robot} twice"), "each robot once");
    }
}

/// Ranks that robots cannot have are refused, and so are ranks where nobody asks for them.
fn ranks<const D: usize>(reader: &mut Reader, scenario: &Scenario) {
    if scenario.ranks.is_some() && scenario.ranking().is_none() {
        let (found, field) = (format!("under controller \"{}\"", scenario.controller.name()), "team.ranks");
        let with: Vec<_> = Controller::ALL.iter().filter(|of| of.row().ranks).map(|of| of.name()).collect();
        return reader.refuse(field, found, format!("only under {}", with.join(", ")));
    }
    let Err(error) = scenario.ranks::<D>() else { return };
    let allowed = match &error {
        RanksError::Count { robots, .. } => format!("{robots} ranks, one a robot"),
        RanksError::Core { .. } => {
            "a core of at least 2F + 1 robots, more under assume = \"free\"".to_owned()
        }
        RanksError::NoCore { .. } => "a start with a core, or a smaller team.faults".to_owned(),
        RanksError::Short { keep, .. } => {
            format!("at least {keep} neighbours of lower ranks for every robot above rank 0")
        }
    };
    reader.refuse("team.ranks", error.to_string(), allowed);
}

/// Robots that run one by one each hold what they know of those around them: so many pairs within R take about a gigabyte.
const ONE_BY_ONE_PAIRS_MAX: usize = 500_000;

fn one_by_one<const D: usize>(reader: &mut Reader, scenario: &Scenario, params: &Params<D>) {
    let lists = params.controller().tells_lists() && scenario.attack.lists == ListsAttack::None;
    let at_once = scenario.is_plain() && (params.controller().can_be_computed_at_once() || lists);
    if at_once || pairs_near::<D>(scenario, params) <= ONE_BY_ONE_PAIRS_MAX {
        return;
    }
    let allowed = format!(
        "as many as have at most {ONE_BY_ONE_PAIRS_MAX} pairs within link.radius_m at the start where robots run one by one: \
         wherever something goes wrong, liars have faces, fall silent, send garbage or disobey, and with \
         controller.kind = \"budget\" under assume = \"free\" or stated errors"
    );
    reader.refuse("team.robots", scenario.team.robots.to_string(), allowed);
}

/// How many pairs of robots are within R of each other at the start.
fn pairs_near<const D: usize>(scenario: &Scenario, params: &Params<D>) -> usize {
    let robots = usize::from(scenario.team.robots);
    if robots * robots / 2 <= ONE_BY_ONE_PAIRS_MAX {
        return 0;
    }
    let (Ok(positions_m), radius_m) = (scenario.positions::<D>(), params.link().radius_m) else { return 0 };
    let mut near = Near::default();
    near.look(&positions_m, radius_m);
    (0..positions_m.len()).map(|second| near.before(second, &positions_m, radius_m).0.len()).sum()
}

/// Obstacles are refused under a controller that takes no notice of them, and so are robots that start in their way.
fn obstacles<const D: usize>(reader: &mut Reader, scenario: &Scenario) {
    if let Some(error) = scenario.refuses_obstacles() {
        let with: Vec<_> = Controller::ALL.iter().filter(|of| of.row().runs_among_obstacles()).collect();
        let names: Vec<_> = with.iter().map(|of| of.name()).collect();
        return reader.refuse("obstacles", error, format!("only under {}", names.join(", ")));
    }
    if let Some(error) = scenario.refuses_cuts() {
        let with: Vec<_> = Controller::ALL.iter().filter(|of| of.row().runs_among_cuts()).collect();
        let names: Vec<_> = with.iter().map(|of| of.name()).collect();
        return reader.refuse("obstacles.cuts_links", error, format!("only under {}", names.join(", ")));
    }
    let Ok(positions) = scenario.positions::<D>() else { return };
    // Who guarantees anything recovers from a start that is too near.
    let recovers = scenario.controller.row().guarantees;
    let keep_m = if recovers { 0.0 } else { scenario.start_clearance_m::<D>() };
    let Some((robot, index, gap_m)) = scenario.obstacles.too_near(&positions, keep_m) else { return };
    let field = match scenario.start {
        Start::Listed(_) => format!("start.positions_m[{robot}]"),
        _ => scenario.obstacles.field(index),
    };
    let (robot, place) = (robot + 1, scenario.obstacles.field(index));
    let found = format!("{gap_m:.4} m between the start of robot {robot} and {place}");
    let why =
        if recovers { "outside of obstacles" } else { "obstacles.clearance_m and what stated errors cost" };
    reader.refuse(&field, found, format!("at least {keep_m} m: {why}"));
}

fn boxes(reader: &mut Reader, scenario: &Scenario) {
    let corners = [
        ("controller.input_min_m_s", &scenario.limits.input_min_m_s),
        ("controller.input_max_m_s", &scenario.limits.input_max_m_s),
    ];
    for (field, corner) in corners {
        if corner.len() != scenario.dimension {
            reader.refuse(
                field,
                format!("a list of {}", corner.len()),
                format!("{} numbers", scenario.dimension),
            );
        }
    }
}

fn clocks(reader: &mut Reader, scenario: &Scenario) {
    let (tau_1, tau_2) = (scenario.clock.level_period.as_nanos(), scenario.clock.value_period.as_nanos());
    if tau_2 < tau_1 || !tau_2.is_multiple_of(tau_1) {
        let allowed =
            format!("a whole multiple of clock.tau_1_s = {}", scenario.clock.level_period.as_secs_f64());
        reader.refuse("clock.tau_2_s", scenario.clock.value_period.as_secs_f64().to_string(), allowed);
    }
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
    let [rows, rounds] = [ROWS_MAX, ROUNDS_MAX].map(|most| most as f64);
    let ticks = rows / f64::from(scenario.team.robots) - 1.0;
    let most = ticks.min(rounds * f64::from(scenario.ticks_per_round())) * scenario.tick_s();
    if scenario.duration_s > most {
        let allowed = format!("at most {most:.1} with {} robots and this clock", scenario.team.robots);
        reader.refuse("duration_s", scenario.duration_s.to_string(), allowed);
    }
}

/// Headings lie in the plane, and a body that cannot follow promises nothing.
fn plant(reader: &mut Reader, scenario: &Scenario) {
    if matches!(scenario.plant, Plant::Unicycle { .. }) && scenario.dimension != 2 {
        reader.refuse("plant.look_ahead_m", "in 3 dimensions", "only in 2");
    }
}

fn values(reader: &mut Reader, scenario: &Scenario) {
    let (listed, what) = match &scenario.values {
        Values::Listed(values) => (values.len(), "numbers"),
        Values::Points(points) => (points.len(), "lists of numbers"),
        Values::Random { .. } => return,
    };
    if listed != usize::from(scenario.team.robots) {
        let allowed = format!("{} {what}, one a robot", scenario.team.robots);
        reader.refuse("values.values", format!("a list of {listed}"), allowed);
    }
}

/// True if two robots can pass each other by within a tick: then no distance between them can be kept.
fn is_too_fast(reader: &mut Reader, scenario: &Scenario) -> bool {
    let Limits { input_min_m_s: low, input_max_m_s: high, .. } = &scenario.limits;
    let fastest = low.iter().zip(high).map(|(low, high)| low.abs().max(high.abs()));
    let speed = fastest.map(|speed| speed * speed).sum::<f64>().sqrt().min(scenario.limits.speed_max_m_s);
    let (hold_s, radius_m) = (scenario.clock.hold_max().as_secs_f64(), scenario.link.radius_m);
    if 2.0 * speed * hold_s < radius_m {
        return false;
    }
    let fields = [
        "controller.speed_max_m_s",
        "controller.input_max_m_s",
        "controller.input_min_m_s",
        "clock.hold_max_s",
        "clock.tau_1_s",
    ];
    let field = fields.into_iter().find(|field| reader.was_given(field)).unwrap_or("link.radius_m");
    let found =
        format!("too much: at up to {speed:.4} m/s a robot moves {:.4} m in {hold_s} s", speed * hold_s);
    reader.refuse(field, found, format!("such a move below half of link.radius_m = {radius_m}"));
    true
}

fn refuse_parameter(reader: &mut Reader, scenario: &Scenario, error: &ParamsError) {
    if error.field == Field::DistanceMinM
        && error.allowed != Allowed::Open(0.0, scenario.link.radius_m)
        && is_too_fast(reader, scenario)
    {
        return;
    }
    let why = match error.field {
        Field::Faults => format!(" (2F + 1 <= n = {})", scenario.team.robots),
        Field::Epsilon => format!(" (below 1/(n-1), n = {})", scenario.team.robots),
        Field::DistanceMinM if error.allowed != Allowed::Open(0.0, scenario.link.radius_m) => {
            " (below link.radius_m by two longest moves of a tick and what stated errors cost)".to_owned()
        }
        field if field.why().is_empty() => String::new(),
        field => format!(" ({})", field.why()),
    };
    reader.refuse(error.field.name(), error.value.to_string(), format!("{}{why}", error.allowed));
}

fn start<const D: usize>(reader: &mut Reader, scenario: &Scenario) {
    let positions = match scenario.positions::<D>() {
        Ok(positions) => positions,
        Err(error) => return refuse_start(reader, scenario, &error),
    };
    for (second, first) in at_one_point(&positions) {
        let pair = format!("robots {} and {}", first + 1, second + 1);
        let (field, length_m) = match scenario.start {
            Start::Hexagon { spacing_m } => ("start.spacing_m", spacing_m),
            Start::Random { half_side_m, .. } => ("start.half_side_m", half_side_m),
            _ => {
                let found = format!("{pair} at one point {:?}", positions[second]);
                let field = format!("start.positions_m[{second}]");
                reader.refuse(&field, found, "a different point for each robot");
                continue;
            }
        };
        let found = format!("{length_m:e}, where the distance of {pair} is rounded to 0");
        return reader.refuse(field, found, "a larger start");
    }
}

/// Every robot whose distance to one before it is rounded to 0, with the first such one. Only robots beside each other along the
/// first axis are compared.
fn at_one_point<const D: usize>(positions_m: &[Vector<D>]) -> BTreeMap<usize, usize> {
    let along = |robot: usize| positions_m[robot][0];
    let mut order: Vec<usize> = (0..positions_m.len()).collect();
    order.sort_unstable_by(|one, other| along(*one).total_cmp(&along(*other)));
    let mut found = BTreeMap::new();
    for (place, one) in order.iter().enumerate() {
        let beside = |other: &&usize| squared_distance(&[along(*one)], &[along(**other)]) <= 0.0;
        for other in order[place + 1..].iter().take_while(beside) {
            if squared_distance(&positions_m[*one], &positions_m[*other]) == 0.0 {
                let first = found.entry(*one.max(other)).or_insert(usize::MAX);
                *first = (*first).min(*one.min(other));
            }
        }
    }
    found
}

fn refuse_start(reader: &mut Reader, scenario: &Scenario, error: &StartError) {
    match (error, &scenario.start) {
        (StartError::Count { found, .. }, _) => {
            let allowed = format!("{} positions, one a robot", scenario.team.robots);
            reader.refuse("start.positions_m", format!("a list of {found}"), allowed);
        }
        (StartError::Full { placed, robots, .. }, Start::Random { half_side_m, .. }) => {
            let found = format!("{half_side_m}, where only {placed} of {robots} robots found a place");
            reader.refuse("start.half_side_m", found, "a larger box or a smaller start.distance_min_m");
        }
        _ => reader.refuse("start.kind", error.to_string(), "a start for this team and dimension"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_robot_at_the_point_of_another_is_found_with_the_first_there() {
        let at = |x: f64, y: f64| [x, y];
        let positions_m =
            [at(1.0, 2.0), at(3.0, 2.0), at(1.0, 2.0), at(1.0, 5.0), at(3.0, 2.0 + 1e-200), at(1.0, 2.0)];
        let mut expected = BTreeMap::new();
        for second in 0..positions_m.len() {
            let same = |y: &[f64; 2]| squared_distance(&positions_m[second], y) == 0.0;
            if let Some(first) = positions_m[..second].iter().position(same) {
                expected.insert(second, first);
            }
        }
        assert_eq!(at_one_point(&positions_m), expected);
        assert_eq!(expected.into_iter().collect::<Vec<_>>(), [(2, 0), (4, 1), (5, 0)]);
    }
}
