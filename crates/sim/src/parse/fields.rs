//! Every field of a scenario text, with its default and range.

use closeranks_core::controller::assume::Assume;
use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::settings::field::TABLE;
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX, ROBOTS_MAX};
use toml::de::{DeTable, DeValue};

use super::common::{ANY, NUMBERS, POSITION, POSITIVE, interval, set, small};
use super::reader::{Reader, Section};
use super::value::{number, whole};
use crate::attack::Attack;
use crate::consensus::Consensus;
use crate::faults::{Faults, Outages};
use crate::law::Law;
use crate::plant::Plant;
use crate::scenario::absences::Absence;
use crate::scenario::desired::Desired;
use crate::scenario::liars::Local;
use crate::scenario::obstacles::{Drawn, Obstacles};
use crate::scenario::ranks::Ranking;
use crate::scenario::route::{KINDS, Route, Whose};
use crate::scenario::start::Start;
use crate::scenario::{Controller, Scenario, Values};
use crate::world::teams::seed_of;

/// Reads the fields of one table.
type Fill = fn(&mut Reader, &mut Section<'_>, &mut Scenario);

/// Reads all tables; wrong fields are noted in `reader` and stay at their defaults.
pub(super) fn read(reader: &mut Reader, table: &DeTable<'_>) -> Scenario {
    let mut root = Section::root(table);
    let mut scenario = Scenario { strangers: reader.strangers, ..Scenario::default() };
    let expect = head(reader, &mut root, &mut scenario);
    let tables: [(&'static str, Fill); 10] = [
        ("team", team),
        ("link", link),
        ("controller", controller),
        ("links", links),
        ("clock", clock),
        ("start", start),
        ("obstacles", obstacles),
        ("consensus", consensus),
        ("values", values),
        ("motion", motion),
    ];
    for (key, fill) in tables {
        reader.table(&mut root, key, |reader, section| fill(reader, section, &mut scenario));
    }
    let team = root.table("team");
    let drawn = team.filter(|team| team.has_table("malicious")).map(|mut team| {
        reader.table(&mut team, "malicious", |reader, section| {
            Local::read(reader, section, scenario.team.robots, scenario.link.radius_m)
        })
    });
    if let Some(local) = drawn {
        draw_liars(reader, &local, &mut scenario);
    }
    let malicious = whose(&scenario, Some(&scenario.malicious));
    scenario.attack =
        reader.table(&mut root, "attack", |reader, section| Attack::read(reader, section, &malicious));
    scenario.faults = Faults::read(reader, &mut root, scenario.team.robots);
    reader.table(&mut root, "plant", |reader, section| {
        scenario.plant = Plant::read(reader, section, scenario.speed_max_m_s());
        scenario.faults.outages = Outages::read(reader, section, scenario.team.robots);
    });
    let stated = reader.was_given("controller.tracking_error_m");
    if let (false, Some(error_m)) = (stated, scenario.plant.tracking_error_m()) {
        scenario.errors.tracking_m = error_m;
    }
    if let Some(mut section) = root.table("obstacles").filter(|section| section.has_table("drawn")) {
        let drawn = reader.table(&mut section, "drawn", Drawn::read);
        draw_obstacles(reader, &drawn, &mut scenario);
    }
    // What happens to the processes of a fleet; `closeranks-node` reads it.
    let _ = root.has("fleet");
    reader.close(&root);
    scenario.expect = expect.unwrap_or_else(|| scenario.usual(scenario.controller));
    scenario
}

/// Gives the laws that are expected, if they are named.
fn head(reader: &mut Reader, root: &mut Section<'_>, scenario: &mut Scenario) -> Option<Vec<Law>> {
    set(&mut scenario.name, reader.text(root, "name", 60));
    set(&mut scenario.duration_s, reader.number(root, "duration_s", Allowed::Closed(0.0, MAGNITUDE_MAX)));
    set(&mut scenario.seed, reader.whole(root, "seed", 0..1 << 63));
    scenario.seed = seed_of(scenario.seed, reader.team);
    set(&mut scenario.dimension, reader.whole(root, "dimension", 2..4).and_then(|d| usize::try_from(d).ok()));
    if scenario.dimension == 3 {
        scenario.limits.input_min_m_s = vec![-1.5; 3];
        scenario.limits.input_max_m_s = vec![1.5; 3];
    }
    let law = |value: &DeValue<'_>| Law::ALL.into_iter().find(|law| Some(law.name()) == value.as_str());
    let names = Law::ALL.map(|law| format!("`{}`", law.name())).join(", ");
    reader.list(root, "expect", &names, law)
}

fn team(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    reader.beside.iter().for_each(|key| section.know(key));
    set(&mut scenario.team.robots, reader.whole(section, "robots", 2..u64::from(ROBOTS_MAX) + 1).map(small));
    let faults = reader.whole(section, "faults", 0..u64::from(ROBOTS_MAX)).map(small);
    scenario.team.faults = faults.unwrap_or(((scenario.team.robots - 1) / 2).min(2));
    let robots = scenario.team.robots;
    let robot =
        move |value: &DeValue<'_>| whole(value).map(small).filter(|robot| (1..=robots).contains(robot));
    scenario.malicious = (1..=scenario.team.faults.min(robots)).collect();
    // Liars that are drawn are read once it is known how far links reach.
    if !section.knows_table("malicious") {
        let allowed = format!("the number of a robot, 1 to {robots}");
        set(&mut scenario.malicious, reader.list(section, "malicious", &allowed, robot));
        scenario.malicious.sort_unstable();
    }
    scenario.ranks = Ranking::read(reader, section, scenario.team.robots);
    scenario.absences = Absence::read(reader, section, robots, scenario.dimension);
}

/// Draws liars once it is known where robots start. A start that does not exist is refused later.
fn draw_liars(reader: &Reader, local: &Local, scenario: &mut Scenario) {
    if !reader.is_clean() {
        return;
    }
    let (faults, seed) = (scenario.team.faults, scenario.seed);
    let liars = match scenario.dimension {
        3 => scenario.positions::<3>().map(|positions_m| local.draw(&positions_m, faults, seed)),
        _ => scenario.positions::<2>().map(|positions_m| local.draw(&positions_m, faults, seed)),
    };
    set(&mut scenario.malicious, liars.ok());
}

/// Reads every number of the settings that stands in `table`.
fn numbers(reader: &mut Reader, section: &mut Section<'_>, table: &str, scenario: &mut Scenario) {
    for row in TABLE.iter().filter(|row| row.place().0 == table) {
        if let Some(number) = reader.number(section, row.place().1, row.range) {
            (row.set)(&mut scenario.parts(), number);
        }
    }
}

fn link(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    numbers(reader, section, "link", scenario);
}

fn controller(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let kinds: Vec<_> = Controller::ALL.iter().map(|controller| (controller.name(), *controller)).collect();
    set(&mut scenario.controller, reader.word(section, "kind", &kinds));
    numbers(reader, section, "controller", scenario);
    let splits = [("neighbours", PhiSplit::Neighbors), ("own", PhiSplit::Own)];
    set(&mut scenario.composed.phi_split, reader.word(section, "share", &splits));
    let assumptions = [("obedient", Assume::Obedient), ("free", Assume::Free)];
    let assumed = reader.word(section, "assume", &assumptions);
    set(&mut scenario.budget.assume, assumed);
    set(&mut scenario.links.assume, assumed);
    scenario.tuning = ["rate_1_s", "orca_horizon_s"].map(|name| reader.number(section, name, POSITIVE));
    let limits = &mut scenario.limits;
    let speed = format!("a finite number (m/s), {ANY}");
    set(&mut limits.input_min_m_s, reader.list(section, "input_min_m_s", &speed, inside));
    set(&mut limits.input_max_m_s, reader.list(section, "input_max_m_s", &speed, inside));
    // Who states a speed alone means a disc and no box.
    let is_disc = limits.speed_max_m_s.is_finite();
    if is_disc && !reader.was_given("controller.input_min_m_s") {
        limits.input_min_m_s.fill(-limits.speed_max_m_s);
    }
    if is_disc && !reader.was_given("controller.input_max_m_s") {
        limits.input_max_m_s.fill(limits.speed_max_m_s);
    }
}

fn links(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    numbers(reader, section, "links", scenario);
    let sides = [("none", false), ("right", true)];
    set(&mut scenario.links.pass_right, reader.word(section, "pass", &sides));
}

fn clock(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    numbers(reader, section, "clock", scenario);
}

fn start(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let presets = [
        ("inside", Start::Inside),
        ("published", Start::Published),
        ("hexagon", Start::Hexagon { spacing_m: 0.6 }),
        ("random", Start::Random { half_side_m: 1.5, distance_min_m: 0.45 }),
        ("listed", Start::Listed(Vec::new())),
    ];
    let names: Vec<(&str, usize)> =
        presets.iter().enumerate().map(|(index, (name, _))| (*name, index)).collect();
    let usual = match (scenario.team.robots, scenario.dimension) {
        (11, 2) => 0,
        (_, 2) => 2,
        _ => 3,
    };
    let coordinate = format!("a finite number (m), {ANY}");
    let at_m = reader.list(section, "at_m", &coordinate, inside);
    if let Some(at_m) = at_m.as_ref().filter(|at_m| at_m.len() != scenario.dimension) {
        let field = section.name("at_m");
        reader.refuse(&field, format!("a list of {}", at_m.len()), format!("{} numbers", scenario.dimension));
    }
    scenario.start_at_m = at_m.unwrap_or_default();
    scenario.start = presets[reader.kind(section, &names).unwrap_or(usual)].1.clone();
    match &mut scenario.start {
        Start::Hexagon { spacing_m } => set(spacing_m, reader.number(section, "spacing_m", POSITIVE)),
        Start::Random { half_side_m, distance_min_m } => {
            set(half_side_m, reader.number(section, "half_side_m", POSITIVE));
            set(distance_min_m, reader.number(section, "distance_min_m", POSITIVE));
        }
        Start::Listed(positions) => {
            set(positions, reader.rows(section, "positions_m", &POSITION[..scenario.dimension]));
        }
        Start::Inside | Start::Published => {}
    }
}

fn obstacles(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    numbers(reader, section, "obstacles", scenario);
    scenario.obstacles = Obstacles::read(reader, section, scenario.dimension);
    // Those that are drawn are read once it is known how far from the start they must be.
    if section.knows_table("drawn") && !scenario.obstacles.list.is_empty() {
        reader.refuse("obstacles.drawn", "beside obstacles that are listed", "one of the two");
    }
}

/// Draws obstacles once it is known where robots start. A start that does not exist is refused later.
fn draw_obstacles(reader: &Reader, drawn: &Drawn, scenario: &mut Scenario) {
    if !reader.is_clean() {
        return;
    }
    let found = match scenario.dimension {
        3 => scenario
            .positions::<3>()
            .map(|x| drawn.draw(&x, scenario.start_clearance_m::<3>(), scenario.seed)),
        _ => scenario
            .positions::<2>()
            .map(|x| drawn.draw(&x, scenario.start_clearance_m::<2>(), scenario.seed)),
    };
    let Obstacles { turn, which_cut, .. } = scenario.obstacles;
    set(&mut scenario.obstacles, found.ok().map(|found| Obstacles { turn, ..found }.that_cut(which_cut)));
}

/// How values are updated.
fn consensus(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    scenario.consensus = Consensus::read(reader, section, scenario.team.robots);
}

fn values(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let listed = reader.kind(section, &[("random", false), ("listed", true)]) == Some(true);
    if listed && scenario.consensus.dimension > 1 {
        let columns = &NUMBERS[..scenario.consensus.dimension];
        scenario.values = Values::Points(reader.rows(section, "values", columns).unwrap_or_default());
        return;
    }
    if listed {
        let allowed = format!("a finite number, {ANY}");
        scenario.values =
            Values::Listed(reader.list(section, "values", &allowed, inside).unwrap_or_default());
        return;
    }
    let [min, max] = interval(reader, section, [-500.0, 500.0]);
    scenario.values = Values::Random { min, max };
}

/// A number that fits.
fn inside(value: &DeValue<'_>) -> Option<f64> {
    number(value).filter(|number| ANY.holds(*number))
}

fn motion(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let simple = [
        ("paper", Desired::Paper),
        ("hold", Desired::Hold),
        ("gather", Desired::Gather),
        ("outward", Desired::Outward),
        ("wander", Desired::Wander),
    ];
    let words = simple.iter().map(|(name, _)| *name).chain(KINDS.map(|(name, _)| name));
    let kinds: Vec<(&str, usize)> = words.enumerate().map(|(index, name)| (name, index)).collect();
    let Some(kind) = reader.kind(section, &kinds) else { return };
    if let Some((_, desired)) = simple.into_iter().nth(kind) {
        scenario.desired = desired;
        return;
    }
    let listed = KINDS[kind - (kinds.len() - KINDS.len())].1;
    scenario.desired = Desired::Listed(Route::read(reader, section, listed, &whose(scenario, None)));
}

/// Whose rows a list may have in this scenario.
fn whose<'a>(scenario: &Scenario, malicious: Option<&'a [u16]>) -> Whose<'a> {
    Whose { robots: scenario.team.robots, dimension: scenario.dimension, malicious }
}
