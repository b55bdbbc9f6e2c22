//! Laws of one W-MSR round (sec:prelim), over thousands of random rounds.
//!
//! Values are small whole numbers wherever a law speaks of equality: their sums are exact, so only the one division rounds.
//! One law that is often assumed is *not* here, because it is false: raising a neighbour's value can lower the result (last
//! test).

#![expect(clippy::float_cmp, reason = "laws of bits")]

use closeranks_core::wmsr::{Round, update};
use seeded::Seeded;

mod seeded;

const CASES: u64 = 5_000;

/// Own value, told values and F of one round.
struct Case {
    own: f64,
    told: Vec<f64>,
    faults: u16,
}

fn round(own: f64, told: &[f64], faults: u16) -> Round {
    update(own, &mut told.to_vec(), faults)
}

#[test]
fn the_order_of_messages_does_not_matter() {
    for (mut random, Case { own, mut told, faults }) in cases() {
        for value in &mut told {
            *value *= 0.1; // no longer exact: only a fixed order of addition gives equal bits
        }
        told.push([f64::NAN, f64::INFINITY, -0.0, 0.0][random.below(4)]);
        let first = round(own, &told, faults);
        for _ in 0..4 {
            shuffle(&mut told, &mut random);
            let again = round(own, &told, faults);
            assert_eq!(again, first, "F = {faults}, own {own}, told {told:?}");
            assert_eq!(again.value.to_bits(), first.value.to_bits());
        }
    }
}

#[test]
fn the_result_lies_between_what_was_kept_and_at_most_f_go_on_each_side() {
    for (mut random, Case { own, told, faults }) in cases() {
        let size = [1.0, 1e-310, 1e300, 0.1][random.below(4)];
        let (own, told) = (own * size, told.iter().map(|value| value * size).collect::<Vec<_>>());
        let result = round(own, &told, faults);
        let smaller = told.iter().filter(|&&value| value < own).count();
        let larger = told.iter().filter(|&&value| value > own).count();
        assert_eq!(result.below, smaller.min(faults.into()));
        assert_eq!(result.above, larger.min(faults.into()));
        assert_eq!(result.kept + result.below + result.above, told.len());
        assert!(result.low <= own && own <= result.high, "{result:?}");
        assert!((result.low..=result.high).contains(&result.value), "{result:?}");
        let outside =
            |edge: fn(f64, f64) -> bool, bound| told.iter().filter(|&&value| edge(value, bound)).count();
        assert!(outside(|value, low| value < low, result.low) <= result.below, "{result:?} of {told:?}");
        assert!(outside(|value, high| value > high, result.high) <= result.above, "{result:?} of {told:?}");
    }
}

//= paper eq:linear type=test
#[test]
fn without_faults_it_is_the_plain_mean() {
    for (_, Case { own, told, .. }) in cases() {
        let sum: f64 = told.iter().sum();
        assert_eq!(round(own, &told, 0).value, (own + sum) / number(told.len() + 1));
        assert_eq!(round(own, &told, 0).kept, told.len());
    }
}

/// The steps as they are printed: sort, cut, average.
#[test]
fn it_is_the_printed_algorithm() {
    for (_, Case { own, told, faults }) in cases() {
        let mut smaller: Vec<f64> = told.iter().copied().filter(|&value| value < own).collect();
        let mut larger: Vec<f64> = told.iter().copied().filter(|&value| value > own).collect();
        smaller.sort_by(f64::total_cmp);
        larger.sort_by(|a, b| b.total_cmp(a));
        let mut kept: Vec<f64> = told.iter().copied().filter(|&value| value == own).collect();
        kept.extend(smaller.iter().skip(faults.into()));
        kept.extend(larger.iter().skip(faults.into()));
        let sum: f64 = kept.iter().sum();
        let result = round(own, &told, faults);
        assert_eq!((result.kept, result.value), (kept.len(), (own + sum) / number(kept.len() + 1)));
    }
}

#[test]
fn what_is_not_finite_counts_as_not_told() {
    for (mut random, Case { own, told, faults }) in cases() {
        let mut spoilt = told.clone();
        for _ in 0..random.below(5) {
            spoilt.push([f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(4)]);
        }
        shuffle(&mut spoilt, &mut random);
        assert_eq!(round(own, &spoilt, faults), round(own, &told, faults));
    }
}

#[test]
fn fewer_neighbours_than_2f_leave_ties_and_the_middle() {
    for (_, Case { own, told, .. }) in cases() {
        let faults = u16::try_from(told.len()).unwrap();
        let result = round(own, &told, faults);
        assert_eq!(result.value, own, "all that differ are gone");
        assert_eq!(result.kept, told.iter().filter(|&&value| value == own).count(), "ties stay");
        assert_eq!(round(own, &told, u16::MAX), result);
    }
}

#[test]
fn up_to_f_liars_cannot_leave_the_hull_of_the_others() {
    for (mut random, Case { own, mut told, faults }) in cases() {
        let low = told.iter().copied().fold(own, f64::min);
        let high = told.iter().copied().fold(own, f64::max);
        for _ in 0..faults {
            told.push([1e300, -1e300, 50.0, -50.0, 1.5][random.below(5)]);
        }
        let value = round(own, &told, faults).value;
        assert!((low..=high).contains(&value), "{value} outside [{low}, {high}] with {told:?}, F = {faults}");
    }
}

#[test]
fn it_moves_with_its_values() {
    for (mut random, Case { own, told, faults }) in cases() {
        let result = round(own, &told, faults);
        let by = f64::from(u32::try_from(random.below(2_000)).unwrap()) - 1_000.0;
        let moved: Vec<f64> = told.iter().map(|value| value + by).collect();
        // one division before and one after, of numbers below 1009
        let error = (round(own + by, &moved, faults).value - (result.value + by)).abs();
        assert!(error <= 2.0 * 1_009.0 * f64::EPSILON, "{error:e}");
        let mirrored: Vec<f64> = told.iter().map(|value| -value).collect();
        assert_eq!(round(-own, &mirrored, faults).value, -result.value);
        let doubled: Vec<f64> = told.iter().map(|value| 2.0 * value).collect();
        assert_eq!(round(2.0 * own, &doubled, faults).value, 2.0 * result.value);
    }
}

#[test]
fn it_rises_with_a_value_that_stays_on_its_side_of_the_own_one() {
    for (mut random, Case { own, mut told, faults }) in cases() {
        if told.is_empty() {
            continue;
        }
        let before = round(own, &told, faults).value;
        let raised = random.below(told.len());
        let side = told[raised].partial_cmp(&own);
        told[raised] += 0.5 * f64::from(u32::try_from(random.below(8)).unwrap());
        if told[raised].partial_cmp(&own) == side {
            assert!(
                round(own, &told, faults).value >= before,
                "own {own}, {raised} raised in {told:?}, F = {faults}"
            );
        }
    }
}

#[test]
fn it_may_fall_when_a_value_rises_past_the_own_one() {
    // -1 is discarded as the one smallest; 0 ties with the own value and is kept, so that the mean has one more term.
    let (lower, higher) = (round(0.0, &[10.0, 10.0, 10.0, -1.0], 1), round(0.0, &[10.0, 10.0, 10.0, 0.0], 1));
    assert_eq!((lower.value, higher.value), (20.0 / 3.0, 20.0 / 4.0));
}

/// Up to 12 neighbours with values -8 to 8, so that ties are frequent, and F from 0 to 4.
fn cases() -> impl Iterator<Item = (Seeded, Case)> {
    (0..CASES).map(|seed| {
        let mut random = Seeded(seed);
        let mut value = |_| f64::from(i32::try_from(random.below(17)).unwrap_or(0) - 8);
        let own = value(0);
        let told: Vec<f64> = (0..12).map(&mut value).collect();
        let count = random.below(13);
        let faults = u16::try_from(random.below(5)).unwrap_or(0);
        (random, Case { own, told: told[..count].to_vec(), faults })
    })
}

fn shuffle(values: &mut [f64], random: &mut Seeded) {
    for index in (1..values.len()).rev() {
        values.swap(index, random.below(index + 1));
    }
}

fn number(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}
