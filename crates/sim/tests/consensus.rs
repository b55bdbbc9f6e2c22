//! Rules of consensus that the world runs, and values of several numbers: each rule shows what its source claims.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_graph::effort::Meter;
use closeranks_graph::graph::Graph;
use closeranks_graph::hops::{self, HopQuestion, HopVerdict};
use closeranks_sim::attack::ValueAttack;
use closeranks_sim::consensus::{Combine, Consensus, Rule, Told, Update};
use closeranks_sim::faults::{Faults, Network};
use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::scenario::{Controller, Scenario, Values};
use closeranks_sim::world::{Engine, Options, Run, run};
use core::ops::ControlFlow;

/// Rounds of a rule on given graphs; liars hold what they hold.
struct Rounds {
    rule: Box<dyn Update>,
    values: Vec<f64>,
    malicious: Vec<bool>,
    faults: u16,
}

impl Rounds {
    fn new(consensus: &Consensus, faults: u16, values: &[f64], liars: &[usize]) -> Self {
        let malicious = (0..values.len()).map(|robot| liars.contains(&robot)).collect();
        let mut values = values.to_vec();
        let mut rule = consensus.rule.update(consensus, values.len());
        rule.begin(&mut values);
        Self { rule, values, malicious, faults }
    }

    /// One round on the graph in which each robot hears those listed.
    fn hold(&mut self, hears: &[Vec<usize>]) {
        let told = |sender: &usize| (u16::try_from(*sender).unwrap(), self.values[*sender]);
        let heard: Vec<Vec<(u16, f64)>> =
            hears.iter().map(|senders| senders.iter().map(told).collect()).collect();
        let mut next = self.values.clone();
        let round = Told {
            faults: self.faults,
            own: &self.values,
            heard: &heard,
            malicious: &self.malicious,
            elapsed_s: 0.1,
        };
        self.rule.update(&round, &mut next);
        for (robot, value) in next.into_iter().enumerate().filter(|(robot, _)| !self.malicious[*robot]) {
            self.values[robot] = value;
        }
    }

    fn spread(&self) -> f64 {
        let normal =
            || self.values.iter().zip(&self.malicious).filter(|(_, lies)| !**lies).map(|(value, _)| *value);
        normal().fold(f64::MIN, f64::max) - normal().fold(f64::MAX, f64::min)
    }
}

fn graph(robots: usize, edges: &[(usize, usize)]) -> (Graph, Vec<Vec<usize>>) {
    let graph = Graph::undirected(robots, edges).unwrap();
    let hears = (0..robots).map(|robot| graph.in_neighbors(robot).iter().collect()).collect();
    (graph, hears)
}

/// The complete graph of seven robots, whose edges come by turns, a third of them at a time: no round is 2-robust, any three in a
/// row together are 4-robust. W-MSR with F = 1 stays apart, a window of three rounds agrees (Saldaña et al.).
#[test]
fn a_sliding_window_agrees_where_only_the_union_is_robust() {
    let all: Vec<(usize, usize)> = (0..7).flat_map(|b| (0..b).map(move |a| (a, b))).collect();
    let parts: Vec<_> = (0..3)
        .map(|part| all.iter().copied().filter(|(a, b)| (a + b) % 3 == part).collect::<Vec<_>>())
        .map(|edges| graph(7, &edges).1)
        .collect();
    assert!(parts.iter().all(|hears| hears.iter().any(|senders| senders.len() < 3)));
    let start = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 1000.0];
    let spread = |rule: Consensus| {
        let mut rounds = Rounds::new(&rule, 1, &start, &[6]);
        (0..600).for_each(|round| rounds.hold(&parts[round % 3]));
        assert!(rounds.values[..6].iter().all(|value| (0.0..=50.0).contains(value)));
        rounds.spread()
    };
    assert!(spread(Consensus { window: 3, ..Rule::SwMsr.into() }) < 1e-6);
    // A window of one round is W-MSR.
    let alone = spread(Rule::WMsr.into());
    assert_eq!(spread(Consensus { window: 1, ..Rule::SwMsr.into() }).to_bits(), alone.to_bits());
}

/// Two groups that meet only over edges which never come together: one round alone discards all that comes from over there.
#[test]
fn w_msr_stays_apart_where_the_window_does_not() {
    let inside = |base: usize| (0..4).flat_map(move |b| (0..b).map(move |a| (base + a, base + b)));
    let rounds: Vec<Vec<Vec<usize>>> = (0..4)
        .map(|shift| {
            let across = (0..4).map(|a| (a, 4 + (a + shift) % 4));
            graph(8, &inside(0).chain(inside(4)).chain(across).collect::<Vec<_>>()).1
        })
        .collect();
    let start = [0.0, 0.0, 0.0, 0.0, 9.0, 9.0, 9.0, 9.0];
    let spread = |rule: Consensus| {
        let mut team = Rounds::new(&rule, 1, &start, &[]);
        (0..400).for_each(|round| team.hold(&rounds[round % 4]));
        team.spread()
    };
    assert_eq!(spread(Rule::WMsr.into()), 9.0);
    assert!(spread(Consensus { window: 4, ..Rule::SwMsr.into() }) < 1e-6);
}

/// All graphs that the exact search calls robust in two hops and not in one: a liar and two sides that hold out under one hop agree
/// under two (Yuan and Ishii).
#[test]
fn two_hops_agree_where_one_does_not() {
    let cycle: Vec<(usize, usize)> = (0..5).map(|a| (a, (a + 1) % 5)).collect();
    let (graph, hears) = graph(5, &cycle);
    let mut go = |_: &_| ControlFlow::Continue(());
    let mut meter = Meter::new(u64::MAX, &mut go);
    assert_eq!(hops::decide(&graph, HopQuestion::survives(2, 1), &mut meter), Ok(HopVerdict::Robust));
    let start = [0.0, 0.0, 10.0, 10.0, 700.0];
    let spread = |rule: Rule, liar: usize| {
        let mut rounds = Rounds::new(&rule.into(), 1, &start, &[liar]);
        (0..2_000).for_each(|_| rounds.hold(&hears));
        rounds.spread()
    };
    assert_eq!(spread(Rule::WMsr, 4), 10.0);
    for liar in 0..5 {
        assert!(spread(Rule::TwoHop, liar) < 1e-6, "{liar}: {}", spread(Rule::TwoHop, liar));
    }
}

/// Percolation from three leaders reaches five of six followers; they end at the leaders' value, the sixth keeps its own
/// (arXiv 2510.01144). A robot that hears too few is no gate for lies either.
#[test]
fn those_that_percolation_reaches_follow_the_leaders() {
    let mut hears: Vec<Vec<usize>> = vec![Vec::new(); 9];
    for follower in 3..8 {
        hears[follower] = (0..follower).collect();
    }
    hears[8] = vec![6, 7];
    let rule = Consensus { leaders: vec![1, 2, 3], ..Rule::BpMsr.into() };
    let start = [5.0, 1.0, 2.0, 9.0, 900.0, -7.0, 3.0, 4.0, 50.0];
    let mut rounds = Rounds::new(&rule, 1, &start, &[4]);
    (0..500).for_each(|_| rounds.hold(&hears));
    for robot in [0, 1, 2, 3, 5, 6, 7] {
        assert!((rounds.values[robot] - 5.0).abs() < 1e-9, "{robot}: {:?}", rounds.values);
    }
    assert_eq!(rounds.values[8], 50.0);
}

/// With F + ⌊n/2⌋ neighbours ARC-P agrees inside of the interval whatever the gain, however long the step; with no more than 2F nobody moves.
#[test]
fn arc_p_agrees_with_enough_neighbours() {
    let all: Vec<(usize, usize)> = (0..7).flat_map(|b| (0..b).map(move |a| (a, b))).collect();
    let start = [0.0, 1.0, 2.0, 3.0, 4.0, 1e300, -1e300];
    for gain_per_s in [0.1, 10.0, 1e6] {
        let mut rounds = Rounds::new(&Consensus { gain_per_s, ..Rule::ArcP.into() }, 2, &start, &[5, 6]);
        (0..4_000).for_each(|_| rounds.hold(&graph(7, &all).1));
        assert!(rounds.spread() < 1e-6 && (0.0..=4.0).contains(&rounds.values[0]), "{gain_per_s}");
    }
    let mut few = Rounds::new(&Rule::ArcP.into(), 2, &start, &[5, 6]);
    let ring: Vec<(usize, usize)> = (0..7).flat_map(|a| [(a, (a + 1) % 7), (a, (a + 2) % 7)]).collect();
    few.hold(&graph(7, &ring).1);
    assert_eq!(few.values, start);
}

/// Trust that is right agrees on a line with a majority of liars; one trusted liar leads all.
#[test]
fn right_trusts_agree_on_a_line_and_a_wrong_one_leads() {
    let line = [(0, 1), (1, 2), (0, 3), (1, 4), (2, 5), (1, 5)];
    let start = [0.0, 6.0, 9.0, 500.0, -500.0, 500.0];
    let value = |trust: [f64; 6]| {
        let rule = Consensus { trust: trust.to_vec(), ..Rule::Trust.into() };
        let mut rounds = Rounds::new(&rule, 0, &start, &[3, 4, 5]);
        (0..3_000).for_each(|_| rounds.hold(&graph(6, &line).1));
        assert!(rounds.spread() < 1e-6);
        rounds.values[0]
    };
    assert!((0.0..=9.0).contains(&value([1.0, 0.5, 1.0, 0.0, 0.0, 0.0])));
    assert!((value([1.0, 0.5, 1.0, 0.1, 0.0, 0.0]) - 500.0).abs() < 1e-6);
}

fn recorded(scenario: &Scenario, engine: Engine) -> Run {
    run(scenario, Options { record: true, digest: true, engine, ..Options::default() }, &mut |_| ()).unwrap()
}

fn team(consensus: Consensus) -> Scenario {
    let attack = ValueAttack::Extreme.into();
    Scenario { duration_s: 3.0, consensus, attack, ..Scenario::default() }.under(Controller::Links)
}

fn every_rule() -> Vec<Consensus> {
    let of = |(_, rule): (&str, Rule)| Consensus {
        leaders: (1..=7).collect(),
        trust: [vec![0.0; 2], vec![1.0; 9]].concat(),
        gain_per_s: 2.0,
        ..rule.into()
    };
    Rule::ALL.into_iter().map(of).collect()
}

/// Robots computed at once and one by one, and whoever holds the rounds, give the same bits.
#[test]
fn engines_agree_under_every_rule() {
    for consensus in every_rule() {
        for dimension in [1, 2] {
            let scenario = team(Consensus { dimension, ..consensus.clone() });
            let (one, other) = (recorded(&scenario, Engine::Team), recorded(&scenario, Engine::Robots));
            assert_eq!(one, other, "{consensus:?}");
        }
    }
}

/// What the world holds for rules of one round is what robots hold by themselves, bit for bit: the first of two numbers, drawn as the only one.
#[test]
fn the_world_holds_what_robots_would() {
    for rule in [Rule::WMsr, Rule::TrimmedMean, Rule::Median, Rule::Linear] {
        for attack in [ValueAttack::Extreme, ValueAttack::Sway, ValueAttack::Silent] {
            let one = Scenario { attack: attack.into(), ..team(rule.into()) };
            let two = Scenario { consensus: Consensus { dimension: 2, ..rule.into() }, ..one.clone() };
            let value = |scenario| recorded(scenario, Engine::Team).record.unwrap().value;
            assert_eq!(value(&one), value(&two), "{rule:?} {attack:?}");
        }
    }
}

/// Rules that survive these liars agree within 3 s, inside of what normal robots held; the others are led away.
#[test]
fn every_rule_meets_the_worst_values() {
    for consensus in every_rule() {
        let summary = recorded(&team(consensus.clone()), Engine::Team).summary;
        let (broken, spread) = (summary.broken(Law::Interval), summary.extremes.spread);
        let holds = consensus.rule != Rule::Linear;
        assert_eq!(broken == 0, holds, "{consensus:?}");
        assert!(!holds || spread < 1.0, "{consensus:?}: {spread}");
    }
}

/// Where a theorem says how fast values come closer, each number of them does, against every lie; else nothing is promised.
//= theory sec:other-rules type=test
#[test]
fn every_number_comes_closer_where_a_theorem_says_so() {
    let promised = |consensus: &Consensus| Law::Agreement.is_kept_by(consensus);
    for rule in [Rule::WMsr, Rule::TrimmedMean] {
        for dimension in [1, 2, 3] {
            let consensus = Consensus { dimension, ..rule.into() };
            assert!(consensus.contracts());
            for value in
                [ValueAttack::Extreme, ValueAttack::Sway, ValueAttack::Random { min: -500.0, max: 500.0 }]
            {
                let scenario = Scenario { attack: value.into(), ..team(consensus.clone()) };
                let summary = recorded(&scenario, Engine::Team).summary;
                assert_eq!(summary.broken(Law::Agreement), 0, "{consensus:?} {value:?}");
                assert!(summary.extremes.spread < 10.0, "{consensus:?} {value:?}");
            }
        }
    }
    let safe = Consensus { dimension: 2, combine: Combine::SafePoint, ..Consensus::default() };
    assert!(![safe, Rule::Median.into(), Rule::SwMsr.into()].iter().any(promised));
}

/// With n = 2F + 1 a trimmed mean discards everything, and the law says nothing of it.
#[test]
fn a_trimmed_mean_of_nothing_promises_nothing() {
    let mut scenario = team(Rule::TrimmedMean.into());
    scenario.team.faults = 5;
    let summary = recorded(&scenario, Engine::Team).summary;
    assert!(summary.extremes.spread > 1.0, "nobody moves");
    assert_eq!(summary.broken(Law::Agreement), 0);
}

/// Half of all messages lost and the rest late: everybody who has a message has all that it says. Who trims on both sides keeps little then
/// and is slow, but nobody is led away.
#[test]
fn what_is_lost_is_lost_for_every_rule() {
    let network = Network { loss: 0.5, delay_max_s: 0.05, ..Network::default() };
    for consensus in every_rule().into_iter().filter(Consensus::keeps_interval) {
        let agrees = matches!(consensus.rule, Rule::WMsr | Rule::SwMsr);
        let scenario = Scenario {
            faults: Faults { network, ..Faults::default() },
            duration_s: if agrees { 8.0 } else { 2.0 },
            ..team(Consensus { dimension: 2, ..consensus.clone() })
        };
        let summary = recorded(&scenario, Engine::Robots).summary;
        assert_eq!(summary.broken(Law::Interval), 0, "{consensus:?}");
        assert!(!agrees || summary.extremes.spread < 10.0, "{consensus:?}: {}", summary.extremes.spread);
    }
}

/// Values of two numbers by a safe point: inside of the hull of honest values, and agreed on, whatever liars tell.
#[test]
fn safe_points_agree_inside_of_the_hull() {
    let lies = [
        ValueAttack::Random { min: -500.0, max: 500.0 },
        ValueAttack::Extreme,
        ValueAttack::Sway,
        ValueAttack::Faces { min: -500.0, max: 500.0 },
        ValueAttack::Split,
    ];
    let consensus = Consensus { dimension: 2, combine: Combine::SafePoint, ..Consensus::default() };
    for attack in lies {
        let scenario = Scenario { attack: attack.into(), duration_s: 4.0, ..team(consensus.clone()) };
        let summary = recorded(&scenario, Engine::Team).summary;
        assert_eq!(summary.broken(Law::Interval), 0, "{attack:?}");
        assert!(summary.extremes.spread < 1.0, "{attack:?}: {}", summary.extremes.spread);
    }
}

/// Normal robots on a line and liars at a corner of its box: numbers one by one leave the hull, safe points do not. The law of the
/// hull is what tells them apart.
#[test]
fn numbers_one_by_one_leave_the_hull() {
    let on_line: Vec<Vec<f64>> = (0..11_u8).map(|robot| vec![f64::from(robot), f64::from(robot)]).collect();
    let text = "\
[controller]\nkind = \"links\"\n[consensus]\ndimension = 2\n[values]\nkind = \"listed\"\nvalues = VALUES\n\
[attack.value]\nkind = \"constant\"\nvalue = 10.0\n";
    let text = text.replace("VALUES", &format!("{on_line:?}"));
    let read = parse::scenario(&text).unwrap();
    assert_eq!(read.values, Values::Points(on_line));
    // With one number told high and one low the box is a trap: the liar of the second number tells the opposite.
    let box_of = recorded(&read, Engine::Team).summary;
    assert_eq!(box_of.broken(Law::Interval), 0);
    let record = recorded(&read, Engine::Team).record.unwrap();
    assert_eq!(record.more_values.len(), 1);
    assert_eq!(record.more_values[0].len(), record.value.len());
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let refused =
        |text: &str| parse::scenario(text).unwrap_err().iter().map(ToString::to_string).collect::<String>();
    for (text, place, allowed) in [
        ("[consensus]\nrule = \"bp-msr\"", "consensus.rule", "leaders"),
        ("[consensus]\nrule = \"trust\"\ntrust = [1.0]", "consensus.rule", "11 numbers"),
        ("[consensus]\nrule = \"trust\"\ntrust = [2.0]", "consensus.trust[0]", "0 to 1"),
        ("[consensus]\ndimension = 4", "consensus.dimension", "3"),
        ("[consensus]\ndimension = 3\ncombine = \"safe-point\"", "consensus.combine", "2 dimensions"),
        ("[consensus]\nrule = \"two-hop\"\n[team]\nrobots = 30\nfaults = 9", "consensus.rule", "at most 8"),
        ("[consensus]\nrule = \"sw-msr\"\nwindow = 0", "consensus.window", "1"),
        (
            "[consensus]\ndimension = 2\n[values]\nkind = \"listed\"\nvalues = [[1.0]]",
            "values.values[0]",
            "2 numbers",
        ),
    ] {
        let told = refused(text);
        assert!(told.contains(place) && told.contains(allowed), "{text}: {told}");
    }
}

/// The run says how far apart values are in each of their numbers, and the largest of these.
#[test]
fn each_number_of_a_value_has_a_spread_of_its_own() {
    let text = "duration_s = 0.5\n[team]\nmalicious = []\n[consensus]\ndimension = 2\n\
                [values]\nkind = \"listed\"\nvalues = [[0, 0], [1, 9], [0, 0], [0, 0], [0, 0], [0, 0], [0, 0], [0, 0], [0, 0], [0, 0], [0, 0]]\n";
    let scenario = parse::scenario(text).unwrap();
    let extremes = run(&scenario, Options::default(), &mut |_| ()).unwrap().summary.extremes;
    let [first, second, third] = extremes.spreads;
    assert!(0.0 < first && first < second && second < 9.0 && third == 0.0, "{:?}", extremes.spreads);
    assert_eq!(extremes.spread, second);
}
