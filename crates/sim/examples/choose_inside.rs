//! The generator of the preset `inside`: tries assignments of eleven robots to the places of a hexagonal patch and
//! prints those that show all three effects of the paper's section V, each better than the ones before.
//!
//! `cargo run --release -p closeranks-sim --example choose_inside -- 20000`

use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::settings::ComposedSettings;
use closeranks_sim::attack::{Attack, LevelAttack};
use closeranks_sim::law::Law;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::random::{Random, Stream};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, run};

/// Columns count half spacings, rows are `√3/2` spacings apart.
const PLACES: [[i8; 2]; 11] =
    [[-3, 1], [-1, 1], [1, 1], [3, 1], [-2, 0], [0, 0], [2, 0], [-3, -1], [-1, -1], [1, -1], [3, -1]];

fn scenario(places: &[[i8; 2]; 11], bias: f64) -> Scenario {
    let position =
        |[column, row]: [i8; 2]| vec![0.3 * f64::from(column), 0.3 * 3.0_f64.sqrt() * f64::from(row)];
    Scenario {
        start: Start::Listed(places.iter().map(|place| position(*place)).collect()),
        attack: Attack::from(if bias == 0.0 { LevelAttack::None } else { LevelAttack::Bias(bias) }),
        composed: ComposedSettings { phi_split: PhiSplit::Neighbors, ..ComposedSettings::default() },
        ..Scenario::default()
    }
}

fn outcome(places: &[[i8; 2]; 11], bias: f64) -> Option<Summary> {
    Some(run(&scenario(places, bias), Options::default(), &mut |_| ()).ok()?.summary)
}

fn clean(summary: &Summary) -> bool {
    let laws = [Law::Degree, Law::Distance, Law::Interval, Law::Agreement, Law::Feasible];
    summary.start.phi_min > 0.0 && laws.iter().all(|law| summary.broken(*law) == 0)
}

#[expect(clippy::print_stdout, reason = "a generator prints")]
fn main() {
    let tries: u32 = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(2_000);
    let mut random = Random::new(1, Stream::Start);
    let (mut shown, mut best) = (0, 0.0);
    for _ in 0..tries {
        let mut places = PLACES;
        for last in (1..places.len()).rev() {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "below 12"
            )]
            let other = random.uniform(0.0, last as f64 + 1.0) as usize;
            places.swap(last, other);
        }
        let Some(nominal) = outcome(&places, 0.0).filter(clean) else { continue };
        if nominal.malicious_below > 0 {
            continue;
        }
        let Some(over) = outcome(&places, 3.5) else { continue };
        let Some(under) = outcome(&places, -2.5) else { continue };
        let gaps = [nominal.gyration_m - under.gyration_m, over.gyration_m - nominal.gyration_m];
        let liars = [nominal.liar_distance_m, under.liar_distance_m];
        let effects = gaps[0] > 0.0 && gaps[1] > 0.0 && over.malicious_below == 1 && liars[1] < liars[0];
        if !(effects && clean(&over) && clean(&under)) {
            continue;
        }
        shown += 1;
        if gaps[0].min(gaps[1]) > best {
            best = gaps[0].min(gaps[1]);
            let [low, middle, high] = [&under, &nominal, &over].map(|summary| summary.gyration_m);
            println!("gyration {low:.3} {middle:.3} {high:.3} m, robots 1 to 11 at {places:?}");
        }
    }
    println!("{shown} of {tries} assignments show all effects");
}
