//! Plain `f64` and free exponents give the same bits wherever `f64` neither overflows nor underflows.
//!
//! So a robot can sum its row in `f64` first, and with free exponents only if it must, and whoever computes a whole team at
//! once can do the same. Scaling by a power of two rounds nothing, so shrinking all offsets by 2⁻⁷⁴⁰ forces
//! the second way upon a row of which the first is known.

use closeranks_core::equations::composition::{Composed, PhiSplit, Sum};
use closeranks_core::equations::link::Link;
use closeranks_core::num::dot;
use closeranks_core::num::number::Number;
use closeranks_core::num::scaled::Scaled;
use seeded::Seeded;
use team::Team;

mod seeded;
mod team;

/// All offsets are multiplied with this, 2⁻⁷⁴⁰.
const SHRINK: f64 = f64::from_bits((1023 - 740) << 52);

//= paper eq:split type=test
//= paper eq:phi_i type=test
#[test]
fn a_row_has_the_same_bits_both_ways() {
    for seed in 0..300 {
        for share in [PhiSplit::Neighbors, PhiSplit::Own] {
            check_rows(Team::<2>::random(seed, share));
            check_rows(Team::<3>::random(seed, share));
        }
    }
}

/// Neighbours that are added one by one in `f64`, from numbers that were never `Scaled`, give the same bits.
#[test]
fn a_team_computed_at_once_has_the_bits_of_each_robot() {
    for seed in 0..300 {
        let team = Team::<3>::random(seed, PhiSplit::Neighbors);
        let composed = &team.composed;
        let told = |k: usize| composed.degree_term::<f64>(team.claims[k]);
        for i in 0..team.count() {
            let mut sum = Sum::new(told(i));
            for j in team.neighbors(i) {
                let offset = team.term(i, j).offset_m;
                let Some(link): Option<Link<f64>> = team.shape.link(&offset) else { continue };
                let collision = composed.collision_term(dot(&offset, &offset));
                let coefficient = composed.coefficient(told(i), told(j), link.slope, collision);
                sum.add_told(composed.shared(told(j)));
                sum.add_link(&offset, coefficient, collision);
            }
            assert_eq!(sum.finish(composed), Some(team.composition(i)), "robot {i}, seed {seed}");
        }
    }
}

#[test]
fn each_operation_has_the_same_bits_both_ways() {
    let mut random = Seeded(7);
    let mut number = || random.between(-1.0, 1.0) * libm::exp(random.between(-80.0, 80.0));
    for _ in 0..20_000 {
        let (a, b) = (number(), number());
        let (x, y) = (Scaled::new(a), Scaled::new(b));
        same(Number::plus(x, y), a + b);
        same(Number::times(x, y), a * b);
        same(x.times_f64(b), a * b);
        same(Number::plus(Number::times(x, y), x), a * b + a);
        let exponent = 8.0 * libm::log(a.abs());
        same(Scaled::exp(exponent), <f64 as Number>::exp(exponent));
    }
}

fn check_rows<const D: usize>(mut team: Team<D>) {
    team.composed = Composed { alpha: 1e-40, ..team.composed };
    for i in 0..team.count() {
        let own: Scaled = team.composed.degree_term(team.claims[i]);
        let shrunk = team.neighbors(i).map(|j| {
            let mut term = team.term(i, j);
            term.offset_m = term.offset_m.map(|component| component * SHRINK);
            term
        });
        let (plain, free) = (team.composition(i), team.composed.compose(own, shrunk));
        assert_eq!(free.row.normal.map(f64::to_bits), plain.row.normal.map(f64::to_bits), "robot {i}");
        assert_eq!(free.phi.to_bits(), plain.phi.to_bits(), "robot {i}");
        assert_eq!((free.row.bound * SHRINK).to_bits(), plain.row.bound.to_bits(), "robot {i}");
    }
}

fn same(free: Scaled, plain: f64) {
    assert_eq!(free.value().to_bits(), plain.to_bits(), "{free:?} and {plain:e}");
}
