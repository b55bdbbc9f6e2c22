//! The figures: what is drawn is what was recorded, for any team and any length, and never anything not finite.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::settings::Team;
use closeranks_report::figure::{Case, figure1, figure2, overview};
use closeranks_report::png::png;
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Limits;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, run};

const TITLES: [&str; 4] = ["nominal updating", "understating", "overstating", "a <b> & \"c\""];

fn record(scenario: &Scenario) -> Record {
    run(scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap().record.unwrap()
}

fn short() -> Scenario {
    Scenario { duration_s: 1.0, start: Start::Published, ..Scenario::default() }
}

/// Runs with the paper's attacks, one more than the paper has.
fn cases(count: usize) -> Vec<(Scenario, Record)> {
    let attacks =
        [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5), LevelAttack::Bias(1.0)];
    let scenarios = attacks
        .into_iter()
        .take(count)
        .map(|level_attack| Scenario { attack: level_attack.into(), ..short() });
    scenarios.map(|scenario| (scenario.clone(), record(&scenario))).collect()
}

fn show(runs: &[(Scenario, Record)]) -> Vec<Case<'_>> {
    let titled = runs.iter().zip(TITLES);
    titled.map(|((scenario, record), title)| Case { title, scenario, record }).collect()
}

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

/// Lines in the paths drawn in `colour` with dots, without the sample in the legend.
fn links(svg: &str, colour: &str) -> usize {
    let style = format!("stroke=\"{colour}\" stroke-width=\"0.9\"");
    let paths = svg.lines().filter(|line| line.contains(&style));
    paths.map(|line| count(line, "M")).sum::<usize>() - 1
}

fn is_clean(svg: &str) {
    for bad in ["NaN", "inf", "<b>"] {
        assert!(!svg.contains(bad), "{bad}");
    }
}

/// Drawing takes a while without optimisation, so that not every figure is drawn.
fn is_drawable(svg: &str) {
    is_clean(svg);
    assert!(png(svg, 0.5).is_ok());
}

#[test]
fn formations_have_a_panel_for_the_start_and_each_end() {
    for number in 0..=4 {
        let runs = cases(number);
        let svg = figure1(&show(&runs));
        let panels = if number == 0 { 0 } else { number + 1 };
        assert_eq!(count(&svg, "fill=\"none\" stroke=\"#4D4D4D\""), panels, "frames");
        assert_eq!(count(&svg, "<circle"), 9 * panels + 1, "normal robots and the legend's");
        assert!(count(&svg, "</text>") > 11 * panels, "numbers");
        assert_eq!(count(&svg, "a &lt;b&gt; &amp; &quot;c&quot;"), usize::from(number == 4));
        is_clean(&svg);
    }
}

//= paper fig:sim type=test
#[test]
fn links_drawn_are_links_recorded() {
    let runs = cases(3);
    let svg = figure1(&show(&runs));
    let degrees = |record: &Record, tick: usize| -> usize {
        (0..11).map(|index| usize::from(record.degree[record.row(tick, index)])).sum()
    };
    let ends: usize = runs.iter().map(|(_, record)| degrees(record, record.last_tick())).sum();
    let twice = degrees(&runs[0].1, 0) + ends;
    assert_eq!(2 * (links(&svg, "#A0A0A0") + links(&svg, "#D55E00")), twice);
    assert!(links(&svg, "#D55E00") > 20);
}

//= paper fig:sim_result type=test
#[test]
fn lines_have_two_panels_a_case() {
    for number in 0..=4 {
        let runs = cases(number);
        let svg = figure2(&show(&runs));
        assert_eq!(count(&svg, "fill=\"none\" stroke=\"#4D4D4D\""), 2 * number, "frames");
        assert_eq!(count(&svg, "time (s)"), number);
        // Nine normal lines a panel of three blues, the legend's line is another.
        let blues = ["#0072B2", "#4FA3D8", "#004C78"].map(|blue| count(&svg, &format!("stroke=\"{blue}\"")));
        assert_eq!(blues, [6 * number + 1, 6 * number, 6 * number]);
        is_clean(&svg);
    }
}

#[test]
fn the_same_record_gives_the_same_bytes() {
    let (runs, again) = (cases(2), cases(2));
    assert_eq!(figure1(&show(&runs)), figure1(&show(&again)));
    assert_eq!(figure2(&show(&runs)), figure2(&show(&again)));
}

#[test]
fn a_full_run_is_a_small_file() {
    let scenario = Scenario { duration_s: 10.0, ..short() };
    let mut record = record(&scenario);
    let size = |record: &Record| figure2(&[Case { title: "run", scenario: &scenario, record }; 3]).len();
    assert!(size(&record) < 80_000);
    for (row, h) in record.h.iter_mut().enumerate() {
        *h = if row * 7_919 % 13 < 6 { 1.0 } else { -1.0 };
    }
    assert!(size(&record) < 400_000, "{}", size(&record));
}

#[test]
fn three_dimensions_are_projected_and_say_so() {
    let scenario = Scenario {
        dimension: 3,
        start: Start::Random { half_side_m: 0.9, distance_min_m: 0.4 },
        limits: Limits {
            input_min_m_s: vec![-1.5; 3],
            input_max_m_s: vec![1.5; 3],
            ..short().limits.clone()
        },
        ..short()
    };
    let record = record(&scenario);
    let svg = overview(Case { title: "cube", scenario: &scenario, record: &record });
    assert_eq!(count(&svg, "3D, seen along z"), 2);
    is_drawable(&svg);
}

#[test]
fn a_single_tick_shows_dots() {
    let scenario = Scenario { duration_s: 0.0, ..short() };
    let record = record(&scenario);
    let svg = overview(Case { title: "instant", scenario: &scenario, record: &record });
    assert_eq!(count(&svg, "r=\"2\""), 2 * 11);
    is_drawable(&svg);
}

#[test]
fn crowds_have_no_numbers() {
    let scenario = Scenario {
        start: Start::Hexagon { spacing_m: 0.5 },
        duration_s: 0.02,
        team: Team { robots: 70, ..short().team },
        ..short()
    };
    let record = record(&scenario);
    let svg = overview(Case { title: "crowd", scenario: &scenario, record: &record });
    assert!(count(&svg, "<circle") > 2 * 68 && count(&svg, "</text>") < 80);
    is_drawable(&svg);
}

#[test]
fn what_is_not_finite_is_left_out() {
    let scenario = short();
    let mut record = record(&scenario);
    let last = record.row(record.last_tick(), 0);
    for (offset, bad) in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300].into_iter().enumerate() {
        record.positions_m[0][last + 3 + offset] = bad;
        for column in [&mut record.h, &mut record.value] {
            column[last / 2 + 11 * offset] = bad;
        }
    }
    let svg = overview(Case { title: "broken", scenario: &scenario, record: &record });
    assert_eq!(count(&svg, "<circle"), 2 * 9 - 4 + 1);
    is_drawable(&svg);
}

#[test]
fn a_record_of_nothing_is_drawn() {
    let scenario = short();
    let record = Record::new(&scenario, 7);
    is_drawable(&overview(Case { title: "none", scenario: &scenario, record: &record }));
}
