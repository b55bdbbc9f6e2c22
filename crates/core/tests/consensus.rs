//! Resilient consensus from degrees alone (thm:rs_robust), with the rate of docs/theory.
//!
//! If every normal robot has at least F′ = F + ⌊n/2⌋ neighbours in a round, at most F of them malicious, and everybody tells all
//! neighbours the same value, then W-MSR keeps the normal values inside their hull and shrinks its width by 1 − β/2 or
//! more in that very round, with β = 1/n for equal weights, whatever the graph does from round to round. One neighbour
//! fewer is too few for every n, and one voice each is needed: both are shown by networks that are stuck for ever.
//!
//! Robots are numbered so that the malicious ones come last, which no statement here depends on.

#![expect(clippy::float_cmp, reason = "a stuck network keeps its bits")]

use network::{Network, ROBOTS_MAX, check_round, graph_of, join, join_all, two_cliques};
use seeded::Seeded;

mod network;
mod seeded;

/// Normal values in the exhaustive check.
const TRUTHS: [f64; 4] = [0.0, 1.0, 2.0, 3.0];
/// What malicious robots tell there.
const LIES: [f64; 9] = [-1e9, -1.0, 0.0, 0.5, 1.0, 2.0, 2.5, 3.0, 1e9];

/// Every graph of 3 to 6 robots, every malicious set, every assignment of `TRUTHS` and `LIES`.
///
/// Nothing is lost by numbering malicious robots last, nor by leaving out assignments without a 0 or without a 3, since the
/// round moves and scales with its values (wmsr.rs).
//= paper thm:rs_robust type=test
//= theory thm:contraction type=test
#[test]
fn every_small_network_with_enough_links_contracts_in_one_round() {
    let (mut rounds, mut worst): (u64, f64) = (0, 0.0);
    for (robots, faults) in [(3, 1), (4, 1), (5, 1), (5, 2), (6, 1), (6, 2)] {
        for malicious in 0..=usize::from(faults) {
            for graph in 0..1_u32 << (robots * (robots - 1) / 2) {
                let network = Network { links: graph_of(robots, graph), normal: robots - malicious, faults };
                if network.normal_degree() >= network.required() {
                    worst = worst.max(check_all_assignments(&network, &mut rounds));
                }
            }
        }
    }
    assert_eq!(rounds, 1_021_638, "every one of them");
    assert!(worst > 0.66, "the liars of this check are not harmless: {worst}");
}

//= paper thm:rs_robust type=test
//= theory thm:contraction type=test
#[test]
fn a_changing_network_with_a_greedy_liar_contracts_in_every_round() {
    let mut worst: f64 = 0.0;
    for seed in 0..60 {
        let mut random = Seeded(seed);
        let robots = 3 + random.below(10);
        let faults = random.below((robots - 1) / 2 + 1);
        let normal = robots - random.below(faults + 1);
        let mut values = [0.0; ROBOTS_MAX];
        values[..normal].fill_with(|| random.between(-500.0, 500.0));
        for _ in 0..10 {
            let links = tight_links(robots, normal, faults + robots / 2, &mut random);
            let network = Network { links, normal, faults: u16::try_from(faults).unwrap() };
            network.lie_greedily(&mut values);
            worst = worst.max(check_round(&network, &values));
            values = network.step(&values, |sender, _| values[sender]);
        }
    }
    assert!(worst > 0.82, "the liar is not harmless: {worst}");
}

/// S and T are complete, and every robot of S is linked to F of T, spread cyclically. Values of 1 on S and 0 on T stay, though
/// nobody lies.
//= paper thm:rs_robust type=test
//= theory sec:tight type=test
#[test]
fn one_neighbour_fewer_is_stuck_for_every_size_and_one_more_link_each_frees_it() {
    let mut pairs = 0;
    for robots in 2..=ROBOTS_MAX {
        for faults in 0..=(robots - 1) / 2 {
            let stuck = two_cliques(robots, faults, u16::try_from(faults).unwrap());
            assert_eq!(stuck.normal_degree() + 1, stuck.required(), "n = {robots}, F = {faults}");
            let mut values = [0.0; ROBOTS_MAX];
            values[..robots / 2].fill(1.0);
            assert_eq!(stuck.step(&values, |sender, _| values[sender]), values, "n = {robots}, F = {faults}");

            let enough = two_cliques(robots, faults + 1, u16::try_from(faults).unwrap());
            assert!(enough.normal_degree() >= enough.required(), "n = {robots}, F = {faults}");
            check_round(&enough, &values);
            pairs += 1;
        }
    }
    assert_eq!(pairs, 239);
}

/// Seven neighbours of eleven are enough against two liars that tell everybody the same, and not if they have two faces.
//= paper thm:rs_robust type=test
//= paper misbeh type=test
//= theory thm:two-faced type=test
#[test]
fn liars_with_two_faces_split_a_network_that_one_voice_cannot() {
    let network = two_cliques_and_two_liars();
    assert_eq!((network.normal_degree(), network.required()), (7, 7));
    let mut start = [0.0; ROBOTS_MAX];
    start[..4].fill(1.0);

    let two_faced = |_, receiver: usize| if receiver < 4 { 1.0 } else { 0.0 };
    let mut values = start;
    for _ in 0..1_000 {
        values = network
            .step(&values, |sender, to| if sender < 9 { values[sender] } else { two_faced(sender, to) });
    }
    assert_eq!(values[..9], start[..9], "no normal robot has moved in 1000 rounds");

    let mut values = start;
    for _ in 0..200 {
        network.lie_greedily(&mut values);
        check_round(&network, &values);
        values = network.step(&values, |sender, _| values[sender]);
    }
    assert!(network.spread(&values) < 1e-3, "{:e} after 200 rounds of (1 - 1/22)", network.spread(&values));
}

/// All truths for normal robots, all lies for malicious ones.
fn check_all_assignments(network: &Network, rounds: &mut u64) -> f64 {
    let robots = network.links.len();
    let choices = |robot: usize| if robot < network.normal { &TRUTHS[..] } else { &LIES[..] };
    let (mut digits, mut worst): ([usize; 6], f64) = ([0; 6], 0.0);
    loop {
        let mut values = [0.0; ROBOTS_MAX];
        for robot in 0..robots {
            values[robot] = choices(robot)[digits[robot]];
        }
        if network.hull(&values) == (0.0, 3.0) {
            *rounds += 1;
            worst = worst.max(check_round(network, &values));
        }
        let Some(next) = (0..robots).find(|&robot| digits[robot] + 1 < choices(robot).len()) else {
            return worst;
        };
        digits[..next].fill(0);
        digits[next] += 1;
    }
}

/// Takes links from the complete graph in random order as long as normal robots keep `required` neighbours.
fn tight_links(robots: usize, normal: usize, required: usize, random: &mut Seeded) -> Vec<u32> {
    let mut links = vec![0; robots];
    let mut pairs: Vec<_> = (1..robots).flat_map(|b| (0..b).map(move |a| (a, b))).collect();
    for &(a, b) in &pairs {
        join(&mut links, a, b);
    }
    for last in (1..pairs.len()).rev() {
        pairs.swap(last, random.below(last + 1));
    }
    let spare =
        |links: &[u32], robot: usize| robot >= normal || links[robot].count_ones() as usize > required;
    for (a, b) in pairs {
        if spare(&links, a) && spare(&links, b) {
            links[a] &= !(1 << b);
            links[b] &= !(1 << a);
        }
    }
    links
}

/// Normal cliques 0..4 and 4..9 with 8 links across, at most 2 at each robot; robots 9 and 10 are malicious, linked to all.
fn two_cliques_and_two_liars() -> Network {
    let mut links = vec![0; 11];
    join_all(&mut links, 0..4);
    join_all(&mut links, 4..9);
    for link in 0..8 {
        join(&mut links, link / 2, 4 + link % 5);
    }
    for liar in 9..11 {
        for robot in 0..liar {
            join(&mut links, robot, liar);
        }
    }
    Network { links, normal: 9, faults: 2 }
}
