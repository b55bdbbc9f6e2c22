//! The team computed at once and robots one by one, with every message as bytes, give the same bits.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::Assume;
use closeranks_core::settings::{
    BudgetSettings, Clock, ComposedSettings, Errors, LinkSettings, LinksSettings, Team,
};
use closeranks_sim::scenario::Limits;
use core::time::Duration;

use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::need::Listen;
use closeranks_sim::attack::{LevelAttack, ValueAttack};
use closeranks_sim::consensus::Rule;
use closeranks_sim::engine::workers::{Piece, Workers};
use closeranks_sim::plant::Plant;
use closeranks_sim::scenario::desired::Desired;
use closeranks_sim::scenario::ranks::{How, Ranking};
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{Engine, Options, Run, World, run};
use std::sync::Arc;

fn recorded(scenario: &Scenario, engine: Engine) -> Run {
    run(scenario, Options { record: true, engine, ..Options::default() }, &mut |_| ()).unwrap()
}

#[track_caller]
fn same_bits(scenario: &Scenario) {
    let (team, robots) = (recorded(scenario, Engine::Team), recorded(scenario, Engine::Robots));
    let digest = |run: &Run| run.record.as_ref().unwrap().digest();
    assert_eq!(digest(&team), digest(&robots), "{scenario:?}");
    assert_eq!(team, robots, "{scenario:?}");
}

fn short(name: &str) -> Scenario {
    Scenario { name: name.into(), duration_s: 2.0, ..Scenario::default() }
}

#[test]
fn the_papers_attacks_from_both_starts() {
    for start in [Start::Inside, Start::Published] {
        for attack in [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5)] {
            same_bits(&Scenario { start: start.clone(), attack: attack.into(), ..short("paper") });
        }
    }
}

#[test]
fn the_own_share_three_dimensions_and_no_value_attack() {
    let space = Start::Random { half_side_m: 0.9, distance_min_m: 0.4 };
    let cube = Scenario {
        dimension: 3,
        start: space,
        attack: ValueAttack::None.into(),
        team: Team { robots: 12, ..short("cube").team },
        limits: Limits {
            input_min_m_s: vec![-1.5; 3],
            input_max_m_s: vec![1.5; 3],
            ..short("cube").limits.clone()
        },
        ..short("cube")
    };
    same_bits(&cube);
    same_bits(&Scenario { composed: ComposedSettings { phi_split: PhiSplit::Own, ..cube.composed }, ..cube });
    same_bits(&Scenario {
        attack: LevelAttack::Bias(3.5).into(),
        composed: ComposedSettings { phi_split: PhiSplit::Own, ..short("own").composed },
        ..short("own")
    });
}

/// Lies so wild that plain exponentials overflow, and clusters in which slopes vanish below what `f64` holds.
#[test]
fn levels_and_radii_beyond_the_range_of_f64() {
    for bias in [-60.0, -20.0, -16.0, 60.0, 900_000.0, -900_000.0] {
        same_bits(&Scenario { attack: LevelAttack::Bias(bias).into(), ..short("wild") });
        same_bits(&Scenario {
            attack: LevelAttack::Bias(bias).into(),
            link: LinkSettings { radius_m: 9.0, ..short("wild and wide").link },
            ..short("wild and wide")
        });
    }
    same_bits(&Scenario {
        link: LinkSettings { radius_m: 30.0, q2: 0.9, ..short("cluster").link },
        ..short("cluster")
    });
}

#[test]
fn attacks_that_change_with_time() {
    let step = LevelAttack::Step { bias: -4.0, from_s: 1.0 };
    let sine = LevelAttack::Sine { amplitude: 5.0, period_s: 0.9 };
    let random = LevelAttack::Random { min: -20.0, max: 20.0 };
    for level_attack in [step, sine, random] {
        same_bits(&Scenario { attack: level_attack.into(), ..short("in time") });
    }
}

#[test]
fn teams_of_other_sizes_and_no_liars() {
    for (robots, faults) in [(2, 0), (3, 1), (5, 0), (30, 4)] {
        let start = Start::Hexagon { spacing_m: 0.5 };
        let malicious = (1..=faults).collect();
        same_bits(&Scenario { malicious, start, team: Team { robots, faults }, ..short("size") });
    }
}

/// Robots that keep lists hand over what they tell with or without bytes.
#[test]
fn teams_that_hold_links() {
    let links = Scenario { controller: Controller::Links, ..short("links") };
    let clock = Clock { level_period: Duration::from_millis(20), ..links.clock };
    for attack in [ValueAttack::Sway, ValueAttack::None] {
        same_bits(&Scenario { attack: attack.into(), ..links.clone() });
        same_bits(&Scenario { attack: attack.into(), clock, duration_s: 6.0, ..links.clone() });
    }
    for (robots, faults) in [(2, 0), (5, 1), (20, 4)] {
        let (malicious, start) = ((1..=faults).collect(), Start::Hexagon { spacing_m: 0.5 });
        same_bits(&Scenario { malicious, start, clock, team: Team { robots, faults }, ..links.clone() });
    }
    let errors = Errors { position_m: 0.01, tracking_m: 0.02 };
    same_bits(&Scenario { errors, clock, ..links.clone() });
    let links = LinksSettings { assume: Assume::Free, pass_right: true, ..links.links };
    same_bits(&Scenario { controller: Controller::Links, links, clock, ..short("free") });
}

/// Neighbours come and go, some links end at R at the start, and some lists change back and forth.
#[test]
fn teams_that_hold_links_and_move_far() {
    let links = Scenario { controller: Controller::Links, duration_s: 8.0, ..short("far") };
    let clock = Clock { level_period: Duration::from_millis(100), ..links.clock };
    for (seed, desired) in [(1, Desired::Outward), (2, Desired::Gather), (3, Desired::Wander)] {
        let team = Team { robots: 24, faults: 1 };
        let links = Scenario { team, desired, clock, seed, malicious: vec![5], ..links.clone() };
        let random = Start::Random { half_side_m: 1.6, distance_min_m: 0.35 };
        same_bits(&Scenario { start: random, ..links.clone() });
        // Six neighbours are at a distance of exactly R, and a few more of nearly that.
        same_bits(&Scenario { start: Start::Hexagon { spacing_m: 1.0 }, ..links });
    }
}

#[test]
fn every_rule_of_consensus() {
    for (_, rule) in Rule::ALL {
        for value in [ValueAttack::default(), ValueAttack::None] {
            same_bits(&Scenario { consensus: rule.into(), attack: value.into(), ..short("rules") });
        }
        let consensus = rule.into();
        same_bits(&Scenario { consensus, controller: Controller::Links, ..short("rules under links") });
    }
}

/// Bodies that lag belong to the world, whatever computes the robots.
#[test]
fn bodies_that_lag() {
    for lag_s in [0.001, 0.02, 0.3] {
        let plant = Plant::Lag { lag_s };
        for controller in [Controller::Composed, Controller::None, Controller::Budget] {
            let lagging = Scenario { plant, controller, ..short("lag") };
            same_bits(&lagging);
            same_bits(&Scenario { attack: LevelAttack::Bias(3.5).into(), ..lagging.clone() });
            same_bits(&Scenario { errors: Errors { tracking_m: 0.05, position_m: 0.01 }, ..lagging });
        }
    }
    let (start, plant) =
        (Start::Random { half_side_m: 2.0, distance_min_m: 0.35 }, Plant::Lag { lag_s: 0.1 });
    same_bits(&Scenario { start, plant, ..short("wide") });
}

#[test]
fn teams_of_liars_only() {
    for value_attack in [ValueAttack::Sway, ValueAttack::Extreme, ValueAttack::None] {
        let (malicious, duration_s) = ((1..=11).collect(), 0.5);
        same_bits(&Scenario { malicious, attack: value_attack.into(), duration_s, ..short("liars") });
    }
}

fn budget(name: &str) -> Scenario {
    Scenario { controller: Controller::Budget, ..short(name) }
}

#[test]
fn budget_with_every_lie() {
    let lies = [
        LevelAttack::None,
        LevelAttack::Bias(-2.5),
        LevelAttack::Bias(3.5),
        LevelAttack::Bias(1e6),
        LevelAttack::Step { bias: -4.0, from_s: 1.0 },
        LevelAttack::Sine { amplitude: 5.0, period_s: 0.9 },
        LevelAttack::Ramp { rate_per_s: -3.0 },
        LevelAttack::Random { min: -20.0, max: 20.0 },
        LevelAttack::Replay { age_s: 0.5 },
    ];
    for level_attack in lies {
        same_bits(&Scenario { attack: level_attack.into(), ..budget("lies") });
    }
}

/// The published start is outside the set; long runs and wide starts have robots out of sight.
#[test]
fn budget_from_starts_inside_and_outside() {
    for index in 0..24_u8 {
        let [half_side_m, distance_min_m] = [[1.1, 0.4], [2.5, 0.2], [1.8, 0.35]][usize::from(index % 3)];
        let (start, q2) =
            (Start::Random { half_side_m, distance_min_m }, [0.1, 0.3, 0.9][usize::from(index / 8)]);
        same_bits(&Scenario {
            start,
            seed: u64::from(index),
            link: LinkSettings { q2, ..budget("start").link },
            budget: BudgetSettings { q2: (q2 != 0.3).then_some(q2), ..budget("start").budget },
            ..budget("start")
        });
    }
    same_bits(&Scenario { start: Start::Published, ..budget("published") });
    for bias in [3.5, -2.5] {
        same_bits(&Scenario { duration_s: 10.0, attack: LevelAttack::Bias(bias).into(), ..budget("long") });
    }
}

#[test]
fn budget_in_teams_and_spaces_of_any_size() {
    for robots in 2..=14_u16 {
        let faults = (robots - 1) / 3;
        let malicious: Vec<u16> = (1..=faults).collect();
        for (dimension, half_side_m) in [(2, 1.3), (3, 1.1)] {
            let start = Start::Random { half_side_m, distance_min_m: 0.3 };
            let (low, high) = (vec![-1.5; dimension], vec![1.5; dimension]);
            same_bits(&Scenario {
                dimension,
                malicious: malicious.clone(),
                start,
                seed: u64::from(robots),
                attack: LevelAttack::Bias(0.3).into(),
                team: Team { robots, faults },
                limits: Limits { input_min_m_s: low, input_max_m_s: high, ..budget("size").limits.clone() },
                ..budget("size")
            });
        }
    }
}

#[test]
fn budget_with_other_ticks_holds_and_ranges() {
    for (tick_ms, q2) in [(1, 0.3), (20, 0.9), (50, 0.3), (100, 0.1)] {
        let (tau_1, tau_2) = (Duration::from_millis(tick_ms), Duration::from_millis(100));
        same_bits(&Scenario {
            attack: LevelAttack::Bias(3.5).into(),
            clock: Clock { level_period: tau_1, value_period: tau_2, ..budget("ticks").clock },
            budget: BudgetSettings { q2: (q2 != 0.3).then_some(q2), ..budget("ticks").budget },
            ..budget("ticks")
        });
    }
    let hold_max = Some(Duration::from_millis(30));
    same_bits(&Scenario { clock: Clock { hold_max, ..budget("hold").clock }, ..budget("hold") });
    same_bits(&Scenario {
        link: LinkSettings { radius_m: 30.0, q2: 0.9, ..budget("cluster").link },
        ..budget("cluster")
    });
    same_bits(&Scenario {
        link: LinkSettings { radius_m: 1.4, ..budget("near-sighted").link },
        ..budget("near-sighted")
    });
    same_bits(&Scenario {
        attack: LevelAttack::Bias(-900_000.0).into(),
        link: LinkSettings { radius_m: 9.0, ..budget("wild").link },
        ..budget("wild")
    });
}

#[test]
fn budget_far_from_the_origin_is_not_computed_at_once() {
    let far =
        |x: f64| (0..11).map(move |robot| vec![x + 0.6 * f64::from(robot % 4), 0.6 * f64::from(robot / 4)]);
    for x in [0.0, 9.9e4, 1e7, 1e9] {
        same_bits(&Scenario { start: Start::Listed(far(x).collect()), ..budget("far") });
    }
}

/// Teams so wide that hardly anybody sees everybody: what is known of a neighbour is then summed up over whom both see.
#[test]
fn budget_in_wide_teams() {
    for (robots, radius_m, spacing_m) in [(90, 4.0, 0.6), (150, 4.5, 0.55), (150, 2.5, 0.7)] {
        same_bits(&Scenario {
            team: Team { robots, faults: 3 },
            malicious: vec![1, 40, 77],
            link: LinkSettings { radius_m, ..LinkSettings::default() },
            start: Start::Hexagon { spacing_m },
            duration_s: 0.02,
            ..budget("wide")
        });
    }
}

/// A team with ranks: `robots` in a hexagon, `spacing_m` apart, which pull outwards.
fn ranked(controller: Controller, (robots, faults): (u16, u16), spacing_m: f64, how: How) -> Scenario {
    Scenario {
        controller,
        team: Team { robots, faults },
        malicious: vec![2, robots - 1],
        start: Start::Hexagon { spacing_m },
        desired: Desired::Outward,
        duration_s: 0.5,
        ranks: Some(Ranking { how, listen: Listen::All }),
        ..short("ranks")
    }
}

/// Who counts for whom depends on ranks: both engines ask the same rule, whatever the size of the team.
#[test]
fn teams_with_ranks() {
    for controller in [Controller::Budget, Controller::Links] {
        for (team, spacing_m) in [((12, 1), 0.6), ((40, 2), 0.6), ((40, 2), 1.1), ((150, 2), 1.0)] {
            for (how, listen) in
                [(How::Own { core: 7 }, Listen::All), (How::Layers { core: 6 }, Listen::Counted)]
            {
                let mut scenario = ranked(controller, team, spacing_m, how);
                scenario.duration_s = if team.0 > 100 { 0.03 } else { 0.1 };
                scenario.ranks.as_mut().unwrap().listen = listen;
                same_bits(&scenario);
                if team.0 < 100 {
                    let start = Start::Random { half_side_m: 2.0, distance_min_m: 0.35 };
                    same_bits(&Scenario { start, ..scenario });
                }
            }
        }
    }
}

/// The rule of a team may be any `Need`: here the ranks are listed, in an order that no choice would give.
#[test]
fn teams_with_another_need() {
    let listed = How::Listed((0..30).map(|robot| [0, 0, 3, 1, 9][robot % 5]).collect());
    for controller in [Controller::Budget, Controller::Links] {
        same_bits(&ranked(controller, (30, 1), 0.5, listed.clone()));
    }
    let scenario = ranked(Controller::Budget, (30, 1), 0.5, listed);
    let without = Scenario { ranks: None, ..scenario.clone() };
    assert_ne!(recorded(&scenario, Engine::Team).record, recorded(&without, Engine::Team).record);
}

/// Liars that move as they like are computed one by one in either case; the laws hold with ranks.
#[test]
fn free_liars_with_ranks() {
    let mut scenario = ranked(Controller::Budget, (40, 2), 0.6, How::Own { core: 9 });
    scenario.budget.assume = Assume::Free;
    same_bits(&scenario);
}

/// Runs pieces from the last to the first, so many of them.
#[derive(Debug)]
struct Backwards(usize);

impl Workers for Backwards {
    fn count(&self) -> usize {
        self.0
    }

    fn run(&self, pieces: Vec<Piece<'_>>) {
        for piece in pieces.into_iter().rev() {
            piece();
        }
    }
}

/// Who computes a large team, and in how many pieces, changes no bit.
#[test]
fn any_number_of_workers_gives_the_same_bits() {
    for controller in [Controller::Budget, Controller::Links] {
        let scenario =
            Scenario { malicious: vec![7, 301], ..ranked(controller, (700, 1), 1.2, How::Own { core: 5 }) };
        let digest = |workers: usize| {
            let options = Options { digest: true, ..Options::default() };
            let mut world = World::<2>::new(&scenario, options).unwrap();
            world.employ(Arc::new(Backwards(workers)));
            for _ in 0..4 {
                world.step();
            }
            world.digest()
        };
        assert!([2, 3, 8].iter().all(|workers| digest(*workers) == digest(1)));
    }
}
