//! `examples/four_robots.rs` shows what it says: the filter holds the team together, and says so when it cannot.

use closeranks_core::{BudgetSettings, Controller, Mode, Reason};
use example::{HOLD_MAX, Line, PERIOD, run};

#[path = "../examples/four_robots.rs"]
mod example;

const BUDGET: fn() -> Controller = || Controller::Budget(BudgetSettings::default());

fn spread(line: &Line) -> f64 {
    line.values.iter().fold(f64::MIN, |most, y| most.max(*y))
        - line.values.iter().fold(f64::MAX, |least, y| least.min(*y))
}

#[test]
fn with_the_filter_nobody_is_lost_and_honest_values_meet() {
    let lines = run(BUDGET(), HOLD_MAX).unwrap();
    for line in &lines {
        assert_eq!((line.degree_min, line.modes), (3, [Mode::Guaranteed; 3]));
        assert!(line.h_min >= 0.0 && line.values.iter().all(|value| (10.0..=30.0).contains(value)));
    }
    let last = lines.last().unwrap();
    assert!(last.farthest_m > 2.5 && spread(last) < 1.0, "{} m, {}", last.farthest_m, spread(last));
}

#[test]
fn without_it_they_part_and_values_stay_apart() {
    let lines = run(Controller::None, HOLD_MAX).unwrap();
    let last = lines.last().unwrap();
    assert_eq!((last.degree_min, last.modes), (0, [Mode::Degraded(Reason::Degree); 3]));
    assert!(last.farthest_m > 10.0 && spread(last) > 5.0);
}

#[test]
fn ticks_later_than_stated_are_noticed() {
    let lines = run(BUDGET(), PERIOD).unwrap();
    for line in &lines[1..] {
        assert_eq!(line.modes, [Mode::Degraded(Reason::Late); 3]);
    }
}

#[test]
fn the_report_is_printed() {
    example::main().unwrap();
}
