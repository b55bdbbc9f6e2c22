//! Worlds side by side have the bits of each alone: of its digest, of what became of the laws, and of its summary.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;

use closeranks_core::controller::assume::Assume;
use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::settings::{Clock, ComposedSettings, LinkSettings, Team};
use closeranks_sim::attack::{LevelAttack, ListsAttack, MotionAttack, ValueAttack};
use closeranks_sim::law::Law;
use closeranks_sim::plant::Plant;
use closeranks_sim::scenario::desired::Desired;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Limits, Scenario};
use closeranks_sim::world::any::{AnyGiven, AnyWorld};
use closeranks_sim::world::block::Block;
use closeranks_sim::world::together::together;
use closeranks_sim::world::{Options, Run};

const OPTIONS: Options = Options {
    record: false,
    digest: true,
    robustness: false,
    without_phi: false,
    engine: closeranks_sim::world::Engine::Team,
};

fn short(name: &str) -> Scenario {
    Scenario { name: name.into(), duration_s: 0.3, start: random(1.3, 0.4), ..Scenario::default() }
}

fn random(half_side_m: f64, distance_min_m: f64) -> Start {
    Start::Random { half_side_m, distance_min_m }
}

fn alone(scenario: &Scenario) -> AnyWorld {
    let mut world = AnyWorld::new(scenario, OPTIONS).unwrap();
    while !world.is_over() {
        world.step();
    }
    world
}

/// So many worlds side by side, stepped and as whole runs, against each alone; whether they were in lanes.
#[track_caller]
fn same_bits(scenario: &Scenario, worlds: u64) -> bool {
    let seeds: Vec<u64> = (0..worlds).map(|k| 3 * k + 1).collect();
    let mut block = Block::new(scenario, &seeds, OPTIONS).unwrap();
    block.advance(&vec![AnyGiven::default(); seeds.len()], u32::MAX).unwrap();
    assert_eq!(block.worlds().len(), seeds.len());
    let scenarios: Vec<Scenario> =
        seeds.iter().map(|seed| Scenario { seed: *seed, ..scenario.clone() }).collect();
    let runs = together(&scenarios.iter().collect::<Vec<_>>(), OPTIONS);
    for ((scenario, world), run) in scenarios.iter().zip(block.worlds()).zip(runs) {
        let (alone, name) = (alone(scenario), format!("seed {} of {}", scenario.seed, scenario.name));
        assert_eq!(world.ticks_done(), alone.ticks_done());
        assert_eq!(world.digest(), alone.digest(), "{name}");
        assert_eq!(world.verdicts(), alone.verdicts(), "{name}");
        let [one, other] = [world, &alone].map(|world| format!("{:?}", world.snapshot()));
        assert_eq!(one, other, "{name}");
        assert_eq!(run.is_some(), block.is_in_lanes(), "{name}");
        run.inspect(|run| same_run(run, &alone.finish(), &name));
    }
    block.is_in_lanes()
}

/// With every field of their summaries.
#[track_caller]
fn same_run(one: &Run, other: &Run, name: &str) {
    let [summary, expected] = [one, other].map(|run| format!("{:#?}", run.summary));
    assert_eq!(summary, expected, "{name}");
    assert_eq!(one.digest, other.digest, "{name}");
}

/// What lanes do not share may differ from run to run; what differs in more, or has too few that are like it, goes alone.
#[test]
fn runs_that_are_alike_find_each_other() {
    let bias = |seed: u32| LevelAttack::Bias(0.5 * f64::from(seed) - 4.0);
    let alike = |seed: u32| Scenario {
        seed: u64::from(seed),
        attack: bias(seed).into(),
        start: random(1.0 + 0.05 * f64::from(seed), 0.3),
        desired: if seed.is_multiple_of(3) { Desired::Gather } else { Desired::Paper },
        ..short("alike")
    };
    let mut scenarios: Vec<Scenario> = (0..23).map(alike).collect();
    scenarios[3].composed.alpha *= 2.0;
    scenarios[5].malicious = vec![2, 3];
    scenarios[9].duration_s *= 2.0;
    scenarios[12].controller = Controller::Budget;
    scenarios[14].team.robots = 12;
    let others = [3, 5, 9, 12, 14];
    // Sixteen go together; the last two are too few.
    let in_lanes = |place: usize| !others.contains(&place) && place < 21;
    let runs = together(&scenarios.iter().collect::<Vec<_>>(), OPTIONS);
    for (place, (scenario, run)) in scenarios.iter().zip(runs).enumerate() {
        assert_eq!(run.is_some(), in_lanes(place), "place {place}");
        run.inspect(|run| same_run(run, &alone(scenario).finish(), &format!("place {place}")));
    }
}

/// Ticks in which no law is near to being broken, and ticks in which many are, in turns: teams that begin too close, and teams that lies
/// and wishes tear apart.
#[test]
fn laws_that_break_and_hold_again() {
    let sine = |amplitude: f64| LevelAttack::Sine { amplitude, period_s: 0.4 };
    let composed = ComposedSettings { alpha: 40.0, w_c: 0.5, ..short("laws").composed };
    let teams = [
        Scenario { start: random(0.7, 0.1), ..short("close") },
        Scenario { attack: sine(30.0).into(), desired: Desired::Outward, composed, ..short("torn") },
        Scenario {
            attack: sine(9.0).into(),
            desired: Desired::Wander,
            start: random(1.9, 0.3),
            ..short("wide")
        },
    ];
    let mut broken = Vec::new();
    for team in teams {
        let team = Scenario { duration_s: 1.2, ..team };
        assert!(same_bits(&team, 9));
        let verdicts = *alone(&team).verdicts();
        broken.extend(verdicts.iter().filter(|verdict| verdict.count > 0).map(|verdict| verdict.law));
    }
    for law in [Law::Degree, Law::Distance, Law::Shares, Law::Spare] {
        assert!(broken.contains(&law), "{law:?} is broken somewhere: {broken:?}");
    }
}

#[test]
fn the_papers_attacks_and_any_number_of_worlds() {
    for (worlds, attack) in
        [(16, LevelAttack::None), (7, LevelAttack::Bias(-2.5)), (13, LevelAttack::Bias(3.5))]
    {
        assert!(same_bits(&Scenario { attack: attack.into(), ..short("attack") }, worlds));
    }
    assert!(!same_bits(&short("few"), 3), "few worlds are not worth it");
}

/// Starts so wide that links break and form, so narrow that robots collide, and all on one line, where rows have components that are 0.
#[test]
fn starts_of_all_kinds() {
    for (half_side_m, distance_min_m) in [(2.6, 0.3), (0.6, 0.05), (30.0, 0.3), (1000.0, 0.3)] {
        assert!(same_bits(&Scenario { start: random(half_side_m, distance_min_m), ..short("start") }, 16));
    }
    let line = (0..11).map(|k| vec![0.5 * f64::from(k) - 2.5, 0.0]).collect();
    assert!(same_bits(&Scenario { start: Start::Listed(line), ..short("line") }, 6));
    assert!(same_bits(&Scenario { start: Start::Hexagon { spacing_m: 0.6 }, ..short("hexagon") }, 6));
}

#[test]
fn teams_of_other_sizes_in_the_plane_and_in_space() {
    for (robots, faults) in [(2, 0), (3, 1), (6, 1), (29, 4), (64, 3)] {
        let (malicious, team) = ((1..=faults).collect(), Team { robots, faults });
        let start = random(0.32 * f64::from(robots).sqrt() + 0.3, 0.2);
        assert!(same_bits(&Scenario { malicious, team, start, duration_s: 0.2, ..short("size") }, 9));
    }
    let too_many =
        Scenario { team: Team { robots: 65, faults: 2 }, start: random(4.0, 0.2), ..short("large") };
    assert!(!same_bits(&Scenario { duration_s: 0.05, ..too_many }, 6));
    let cube = Scenario {
        dimension: 3,
        start: random(0.9, 0.4),
        team: Team { robots: 12, faults: 2 },
        limits: Limits { input_min_m_s: vec![-1.5; 3], input_max_m_s: vec![1.5; 3], ..short("cube").limits },
        ..short("cube")
    };
    assert!(same_bits(&cube, 10));
}

/// Lies so wild that plain exponentials overflow, and clusters in which slopes vanish below what `f64` holds.
#[test]
fn levels_and_radii_beyond_the_range_of_f64() {
    for bias in [-60.0, -16.0, 60.0, 900_000.0, -900_000.0] {
        for radius_m in [3.0, 9.0] {
            let link = LinkSettings { radius_m, ..short("wild").link };
            assert!(same_bits(
                &Scenario { attack: LevelAttack::Bias(bias).into(), link, ..short("wild") },
                7
            ));
        }
    }
    let link = LinkSettings { radius_m: 30.0, q2: 0.9, ..short("cluster").link };
    assert!(same_bits(&Scenario { link, ..short("cluster") }, 7));
}

#[test]
fn lies_that_change_motions_plants_and_splits() {
    let random_levels = LevelAttack::Random { min: -20.0, max: 20.0 };
    let sine = LevelAttack::Sine { amplitude: 5.0, period_s: 0.2 };
    for attack in [random_levels, sine, LevelAttack::Replay { age_s: 0.1 }] {
        assert!(same_bits(&Scenario { attack: attack.into(), ..short("lies") }, 8));
    }
    for attack in [ValueAttack::Sway, ValueAttack::None, ValueAttack::Extreme] {
        assert!(same_bits(&Scenario { attack: attack.into(), ..short("values") }, 8));
    }
    for desired in [Desired::Gather, Desired::Outward, Desired::Wander, Desired::Hold] {
        assert!(same_bits(&Scenario { desired, ..short("desired") }, 8));
    }
    let own = ComposedSettings { phi_split: PhiSplit::Own, ..short("own").composed };
    assert!(same_bits(&Scenario { composed: own, attack: LevelAttack::Bias(3.5).into(), ..short("own") }, 8));
    assert!(same_bits(&Scenario { plant: Plant::Lag { lag_s: 0.05 }, ..short("lag") }, 8));
    let clock = Clock { level_period: Duration::from_millis(20), ..short("slow").clock };
    assert!(same_bits(&Scenario { clock, duration_s: 1.2, ..short("slow") }, 8));
}

/// What lanes are not for goes one by one, with the same answers.
#[test]
fn what_is_not_computed_in_lanes_is_computed_all_the_same() {
    for controller in [Controller::Budget, Controller::None] {
        assert!(!same_bits(&Scenario { controller, duration_s: 0.2, ..short("controller") }, 6));
    }
    assert!(!same_bits(&Scenario { attack: ValueAttack::Split.into(), ..short("faces") }, 6));
    assert!(!same_bits(&Scenario { attack: MotionAttack::Flee.into(), ..short("runaways") }, 6));
    let mut amid = short("obstacles");
    amid.obstacles.list.push(Obstacle::disc([0.9, 0.9, 0.0], 0.2));
    assert!(!same_bits(&amid, 6));
    let slow = Limits { speed_max_m_s: 1.6, ..short("disc").limits };
    assert!(!same_bits(&Scenario { limits: slow, ..short("disc") }, 6));
}

/// Arrays that are given reach the world they are for, and a bad one is refused before any world is stepped.
#[test]
fn what_is_given_reaches_its_world() {
    for controller in [Controller::Composed, Controller::Links] {
        what_is_given(&Scenario { duration_s: 0.2, controller, ..short("given") });
    }
}

#[track_caller]
fn what_is_given(scenario: &Scenario) {
    let seeds: Vec<u64> = (0..16).collect();
    let mut block = Block::new(scenario, &seeds, OPTIONS).unwrap();
    assert!(block.is_in_lanes());
    let desired = |seed: u64| vec![0.05 * f64::from(u32::try_from(seed).unwrap()) - 0.4; 22];
    let levels = |seed: u64| vec![f64::from(u32::try_from(seed).unwrap()); 11];
    let all: Vec<_> = seeds.iter().map(|seed| (desired(*seed), levels(*seed), vec![7.0; 11])).collect();
    let mut given: Vec<AnyGiven<'_>> = all
        .iter()
        .map(|(desired, levels, values)| AnyGiven {
            desired_m_s: Some(desired),
            levels: Some(levels),
            values: Some(values),
        })
        .collect();
    for _ in 0..30 {
        block.step_with(&given).unwrap();
    }
    for (index, world) in block.worlds().iter().enumerate() {
        let mut alone = AnyWorld::new(&Scenario { seed: seeds[index], ..scenario.clone() }, OPTIONS).unwrap();
        for _ in 0..30 {
            alone.step_with(&given[index]).unwrap();
        }
        assert_eq!(world.digest(), alone.digest(), "world {index}");
    }
    let bad = vec![f64::NAN; 11];
    given[11].values = Some(&bad);
    assert!(block.step_with(&given).is_err());
    assert!(block.worlds().iter().all(|world| world.ticks_done() == 30));
}

fn links(name: &str) -> Scenario {
    Scenario { controller: Controller::Links, ..short(name) }
}

/// Teams that hold links: together, spreading so that pairs leave range, wandering in and out of it, drawn far apart, among liars.
#[test]
fn held_links() {
    for (worlds, attack) in [(16, LevelAttack::None), (7, LevelAttack::Bias(-2.5))] {
        assert!(same_bits(&Scenario { attack: attack.into(), ..links("attack") }, worlds));
    }
    for desired in [Desired::Gather, Desired::Outward, Desired::Wander, Desired::Hold] {
        for half_side_m in [0.9, 1.3, 2.6] {
            let start = random(half_side_m, 0.3);
            let desired = desired.clone();
            assert!(same_bits(&Scenario { desired, start, duration_s: 1.5, ..links("desired") }, 9));
        }
    }
    assert!(!same_bits(&links("few"), 3), "few worlds are not worth it");
}

/// Long enough that promises lapse and whoever does not let go is barred, in teams that many pairs join and leave.
#[test]
fn held_links_for_a_while() {
    for (desired, half_side_m, faults) in [(Desired::Wander, 2.2, 1), (Desired::Outward, 1.3, 2)] {
        let (malicious, team) = ((1..=faults).collect(), Team { robots: 8, faults });
        let start = random(half_side_m, 0.3);
        let attack = ValueAttack::Sway.into();
        let scenario =
            Scenario { desired, start, malicious, team, attack, duration_s: 12.0, ..links("while") };
        assert!(same_bits(&scenario, 6));
    }
}

/// Robots that begin too close, in clusters, on a line and far apart, pressed against each other, so that rows and monitors are near.
#[test]
fn held_links_of_starts_of_all_kinds() {
    for (half_side_m, distance_min_m) in [(0.6, 0.05), (4.0, 0.3), (30.0, 0.3), (1000.0, 0.3)] {
        let start = random(half_side_m, distance_min_m);
        assert!(same_bits(&Scenario { start, desired: Desired::Gather, ..links("start") }, 16));
    }
    let gather = Scenario { desired: Desired::Gather, duration_s: 2.5, ..links("pressed") };
    assert!(same_bits(&gather, 6));
    let line = (0..11).map(|k| vec![0.5 * f64::from(k) - 2.5, 0.0]).collect();
    assert!(same_bits(&Scenario { start: Start::Listed(line), ..links("line") }, 6));
    let mut right = Scenario { desired: Desired::Paper, duration_s: 1.5, ..links("right") };
    for (pass_right, assume) in [(false, Assume::Free), (true, Assume::Obedient)] {
        (right.links.pass_right, right.links.assume) = (pass_right, assume);
        assert!(same_bits(&right, 6));
    }
}

#[test]
fn held_links_of_teams_of_other_sizes() {
    for (robots, faults) in [(2, 0), (3, 1), (6, 1), (29, 4), (64, 3)] {
        let (malicious, team) = ((1..=faults).collect(), Team { robots, faults });
        let start = random(0.32 * f64::from(robots).sqrt() + 0.3, 0.2);
        assert!(same_bits(&Scenario { malicious, team, start, duration_s: 0.2, ..links("size") }, 9));
    }
    let cube = Scenario {
        dimension: 3,
        start: random(0.9, 0.4),
        team: Team { robots: 12, faults: 2 },
        limits: Limits { input_min_m_s: vec![-1.5; 3], input_max_m_s: vec![1.5; 3], ..links("cube").limits },
        ..links("cube")
    };
    assert!(same_bits(&cube, 10));
    let slow = Limits { speed_max_m_s: 1.6, ..links("disc").limits };
    assert!(same_bits(&Scenario { limits: slow, duration_s: 1.0, ..links("disc") }, 6));
    let clock = Clock { level_period: Duration::from_millis(20), ..links("slow").clock };
    assert!(same_bits(&Scenario { clock, duration_s: 1.2, ..links("slow") }, 8));
}

/// What lanes of held links are not for goes one by one.
#[test]
fn held_links_that_are_computed_one_by_one() {
    let mut amid = links("obstacles");
    amid.obstacles.list.push(Obstacle::disc([0.9, 0.9, 0.0], 0.2));
    assert!(!same_bits(&amid, 6));
    assert!(!same_bits(&Scenario { attack: MotionAttack::Flee.into(), ..links("runaways") }, 6));
    assert!(!same_bits(&Scenario { attack: ListsAttack::Never.into(), ..links("lists") }, 6));
}
