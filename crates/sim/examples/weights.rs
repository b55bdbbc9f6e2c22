//! How far the paper's eleven robots get under `budget`, by weight, tick and errors: the table of docs/theory, `sec:own-weight`.
//!
//! `cargo run --release -p closeranks-sim --example weights -- FIRST COUNT CASE [q2=Q epsilon=E rate=R gamma_c=C]...`
//!
//! From the places of `inside`, robots assigned to them anew for each of COUNT runs from number FIRST on; mean radius of
//! gyration in m after 1, 2, 4 and 10 s and the least one after 10 s, without an attack. CASE is a tick in ms, with `free`, `noise` (1 cm,
//! stated) or `lag` (20 ms, stated) after it, as in `5`, `5free` or `50noise`.

use core::time::Duration;
use std::env::args;

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::settings::fraction_of_rate;
use closeranks_core::settings::{BudgetSettings, Clock};
use closeranks_sim::plant::Plant;
use closeranks_sim::random::{Random, Stream};
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{self, Options, World};

/// Columns count half spacings, rows are `√3/2` spacings apart.
const PLACES: [[i8; 2]; 11] =
    [[-3, 1], [-1, 1], [1, 1], [3, 1], [-2, 0], [0, 0], [2, 0], [-3, -1], [-1, -1], [1, -1], [3, -1]];
const TIMES_S: [f64; 4] = [1.0, 2.0, 4.0, 10.0];

fn start(number: u64) -> Start {
    let (mut places, mut random) = (PLACES, Random::new(number, Stream::Start));
    for last in (1..11_u64).rev() {
        let other = random.below(last + 1);
        places.swap(usize::try_from(last).unwrap_or(0), usize::try_from(other).unwrap_or(0));
    }
    let place = |[column, row]: [i8; 2]| vec![0.3 * f64::from(column), 0.3 * 3.0_f64.sqrt() * f64::from(row)];
    Start::Listed(places.map(place).to_vec())
}

fn scenario(case: &str) -> Scenario {
    let (tick, rest) = case.split_at(case.find(|c: char| !c.is_ascii_digit()).unwrap_or(case.len()));
    let tick = Duration::from_millis(tick.parse().unwrap_or(5));
    let clock =
        Clock { level_period: tick, value_period: tick.max(Duration::from_millis(100)), ..Clock::default() };
    let mut scenario = Scenario { clock, ..Scenario::default() }.under(Controller::Budget);
    match rest {
        "free" => scenario.budget.assume = Assume::Free,
        "noise" => {
            scenario.errors.position_m = 0.01;
            scenario.faults.sensing.noise_m = 0.01;
        }
        "lag" => {
            scenario.errors.tracking_m = 0.0425;
            scenario.plant = Plant::Lag { lag_s: 0.02 };
        }
        _ => {}
    }
    scenario
}

/// One setting, as `name=number`.
fn set(scenario: &mut Scenario, word: &str) {
    let Some((name, number)) = word.split_once('=') else {
        return if word == "composed" {
            *scenario = scenario.clone().under(Controller::Composed);
        };
    };
    let number: f64 = number.parse().unwrap_or(f64::NAN);
    let tick_s = scenario.tick_s();
    match name {
        "q2" => scenario.budget.q2 = Some(number),
        "epsilon" => scenario.budget.epsilon = Some(number),
        "rate" => scenario.budget.gamma = Some(fraction_of_rate(number, tick_s)),
        "gamma_c" => scenario.budget.gamma_c = Some(number),
        "rate_c" => scenario.budget.gamma_c = Some(fraction_of_rate(number, tick_s)),
        _ => {}
    }
}

fn gyration_m(positions_m: &[[f64; 2]]) -> f64 {
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| positions_m.iter().map(of).sum::<f64>() / 11.0;
    let (x, y) = (mean(&|p| p[0]), mean(&|p| p[1]));
    mean(&|p| (p[0] - x).powi(2) + (p[1] - y).powi(2)).sqrt()
}

fn run(scenario: &Scenario) -> [f64; 4] {
    let options = Options { without_phi: true, ..Options::default() };
    let mut world = World::<2>::new(scenario, options).expect("a scenario that can be run");
    let tick_s = scenario.tick_s();
    TIMES_S.map(|time_s| {
        while (f64::from(world.ticks_done()) - 0.5) * tick_s < time_s && !world.is_over() {
            world.step();
        }
        gyration_m(&world.frame().positions_m)
    })
}

/// The mean radius of gyration under both controllers over runs of a sweep: FILE SEED FIRST COUNT [NAME=NUMBER]...
#[expect(clippy::print_stdout, reason = "a report")]
fn campaign(words: &[String]) {
    let [file, seed, first, count, settings @ ..] = words else { return };
    let plan = Plan::read(&std::fs::read_to_string(file).expect("a file")).expect("a sweep");
    let number = |word: &String| word.parse::<u64>().expect("a number");
    let (mut sums, mut violations) = ([[0.0; 3]; 3], 0);
    for run in number(first)..number(first) + number(count) {
        let drawn = plan.draw(number(seed), run).expect("a run");
        let mut ends = [(false, 0.0); 2];
        let both =
            |scenario: &Scenario| matches!(scenario.controller, Controller::Budget | Controller::Composed);
        for (scenario, _) in drawn.scenarios.iter().filter(|(scenario, _)| both(scenario)) {
            let mut scenario = scenario.clone();
            if settings.iter().any(|word| word == "chosen") {
                let assume = scenario.budget.assume;
                scenario.budget = BudgetSettings { assume, ..BudgetSettings::default() };
            }
            for word in settings {
                set(&mut scenario, word);
            }
            let options = Options { without_phi: true, ..Options::default() };
            let summary = world::run(&scenario, options, &mut |_| ()).expect("a run").summary;
            let budget = scenario.controller == Controller::Budget;
            ends[usize::from(!budget)] = (summary.start.inside, summary.gyration_m);
            violations += usize::from(budget && summary.violations(&scenario).next().is_some());
        }
        let [(one, width), (other, other_width)] = ends;
        for (sum, counts) in sums.iter_mut().zip([true, one, one && other]) {
            if counts {
                *sum = [sum[0] + 1.0, sum[1] + width, sum[2] + other_width];
            }
        }
    }
    println!("{}: {violations} violations", settings.join(" "));
    for (about, [count, budget, composed]) in
        ["all", "budget starts safe", "both start safe"].iter().zip(sums)
    {
        println!(
            "    {about:20} {count:6} runs: budget {:.3} m, composed {:.3} m",
            budget / count,
            composed / count
        );
    }
}

#[expect(clippy::print_stdout, reason = "a report")]
fn main() {
    let words: Vec<String> = args().skip(1).collect();
    if words.first().is_some_and(|word| word == "campaign") {
        return campaign(&words[1..]);
    }
    let [first, count, case, ..] = &words[..] else { return println!("FIRST COUNT CASE [NAME=NUMBER]...") };
    let (first, count): (u64, u64) = (first.parse().unwrap_or(0), count.parse().unwrap_or(12));
    let mut base = scenario(case);
    for word in &words[3..] {
        set(&mut base, word);
    }
    let (mut sums, mut runs) = ([0.0; 4], 0.0);
    let mut least = f64::INFINITY;
    for number in first..first + count {
        let at = run(&Scenario { start: start(number), ..base.clone() });
        sums = core::array::from_fn(|k| sums[k] + at[k]);
        least = least.min(at[3]);
        runs += 1.0;
    }
    let [one, two, four, ten] = sums.map(|sum| sum / runs);
    println!("{:40} {one:.3} {two:.3} {four:.3} {ten:.3}  least {least:.3}", words[2..].join(" "));
}
