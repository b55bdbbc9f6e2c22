//! The figures: what is drawn is what was recorded, for any team and any length, and never anything not finite.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::settings::Team;
use closeranks_report::figure::{Case, animation, figure1, figure2, figure3, overview};
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
        // Robots 1 and 10 start too close: they have rings, and the legend has one.
        let rings = if number == 0 { 0 } else { 3 };
        assert_eq!(count(&svg, "<circle"), 9 * panels + 1 + rings, "normal robots and the legend's");
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
        // Nine normal lines a panel of three blues and as many numbers beside h; the legend's line is another.
        let blues = ["#0072B2", "#4FA3D8", "#004C78"].map(|blue| count(&svg, &format!("stroke=\"{blue}\"")));
        assert_eq!(blues, [9 * number + 1, 9 * number, 9 * number]);
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
    assert_eq!(count(&svg, "3D, seen along z"), 3, "start, end, paths");
    assert_eq!(count(&svg, "3D, seen along y"), 2, "start and end");
    is_drawable(&svg);
    let cases = [Case { title: "cube", scenario: &scenario, record: &record }];
    for (svg, panels) in [(figure1(&cases), 2), (figure3(&cases), 1)] {
        for view in ["3D, seen along z", "3D, seen along y"] {
            assert_eq!(count(&svg, view), panels);
        }
        is_clean(&svg);
    }
}

/// Two robots on top of each other used to look like one.
#[test]
fn robots_that_are_too_close_have_a_ring() {
    let rings = |svg: &str| count(svg, "stroke=\"#CC79A7\"");
    let runs = cases(1);
    assert_eq!(rings(&figure1(&show(&runs))), 2 + 1, "two robots at the start, and the legend's");
    let apart = Scenario { start: Start::Hexagon { spacing_m: 0.6 }, ..short() };
    let record = record(&apart);
    let cases = [Case { title: "apart", scenario: &apart, record: &record }];
    assert_eq!(rings(&figure1(&cases)), 0, "no ring, nothing to explain");
}

/// Values agree in less than a second; of a long run nobody could see how.
#[test]
fn values_that_agree_early_have_an_inset() {
    let frames = |duration_s: f64| {
        let scenario = Scenario { duration_s, ..short() };
        let record = record(&scenario);
        let svg = figure2(&[Case { title: "one", scenario: &scenario, record: &record }]);
        is_clean(&svg);
        count(&svg, "fill=\"none\" stroke=\"#4D4D4D\"")
    };
    assert_eq!((frames(0.5), frames(5.0)), (2, 3));
}

/// Which line is whose could not be told.
#[test]
fn every_barrier_has_the_number_of_its_robot() {
    let runs = cases(1);
    let numbers =
        |svg: &str| (1..=11).filter(|robot| svg.contains(&format!("<tspan>{robot}</tspan>"))).count();
    assert_eq!(numbers(&figure2(&show(&runs))), 11);
}

/// Where robots went could not be seen, nor how near they came to each other.
#[test]
fn paths_and_distances_have_a_panel_a_case() {
    for number in 0..=3 {
        let runs = cases(number);
        let svg = figure3(&show(&runs));
        assert_eq!(count(&svg, "fill=\"none\" stroke=\"#4D4D4D\""), 2 * number, "frames");
        assert_eq!(count(&svg, "r=\"2.4\""), 11 * number + 1, "starts");
        is_clean(&svg);
    }
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
    assert!(count(&svg, "<circle") > 2 * 68 && count(&svg, "</text>") < 140);
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
    // Formations with the legend's robot, three rings; starts and ends of paths with two of the legend.
    assert_eq!(count(&svg, "<circle"), 2 * 9 - 4 + 1 + 3 + 11 + 9 - 4 + 2);
    is_drawable(&svg);
}

#[test]
fn a_record_of_nothing_is_drawn() {
    let scenario = short();
    let record = Record::new(&scenario, 7);
    is_drawable(&overview(Case { title: "none", scenario: &scenario, record: &record }));
}

/// Every attribute that moves has as many values as times, the last picture is what is shown at rest, and no team makes it large.
#[test]
fn pictures_that_move_are_small_and_complete() {
    for robots in [2, 11, 50, 200] {
        let start = Start::Random { half_side_m: 0.3 * f64::from(robots), distance_min_m: 0.2 };
        let team = Team { robots, faults: 0 };
        let scenario = Scenario { duration_s: 0.3, team, malicious: vec![1], start, ..short() };
        let record = record(&scenario);
        let svg = animation(Case { title: TITLES[3], scenario: &scenario, record: &record }).unwrap();
        assert!(svg.len() < 400_000, "{robots} robots: {} bytes", svg.len());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{robots} robots");
        let document = roxmltree::Document::parse(&svg).unwrap();
        let moving = document.descendants().filter(|node| node.has_attribute("values"));
        let mut transforms = 0;
        for node in moving {
            let list = |key: &str| node.attribute(key).unwrap().split(';').collect::<Vec<_>>();
            let (times, values) = (list("keyTimes"), list("values"));
            assert_eq!(times.len(), values.len());
            assert_eq!((times[0], times[times.len() - 1]), ("0.0000", "1"));
            let rest = values[values.len() - 1];
            let parent = node.parent().unwrap();
            let shown = parent.attribute(node.attribute("attributeName").unwrap()).unwrap();
            assert!(shown == rest || shown == format!("translate({rest})"), "{shown} is not {rest}");
            transforms += usize::from(node.has_tag_name("animateTransform"));
        }
        assert_eq!(transforms, usize::from(robots));
    }
}
