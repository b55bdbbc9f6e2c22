//! Rows of a sweep: written, read back, counted, drawn.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use bytes::Bytes;
use closeranks_report::png::png;
use closeranks_report::sweep::entry;
use closeranks_report::sweep::figure::{gyrations, shares};
use closeranks_report::sweep::file::{Writer, read};
use closeranks_report::sweep::rows::{Cell, Head, Kind, Rows};
use closeranks_report::sweep::spread::Spread;
use closeranks_report::sweep::tables::{controllers, percent, values};
use closeranks_report::sweep::tally::Tally;
use closeranks_report::table::text;
use closeranks_sim::sweep::{Field, Plan};

/// Polars and others refuse a file with two columns of one name: a table `controller` that is chosen had the name of the controller's.
#[test]
fn no_two_columns_of_a_sweep_have_the_same_name() {
    for file in ["campaign.toml", "campaign-ranks.toml", "campaign-swarm.toml", "campaign-bodies.toml"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(file);
        let plan = Plan::read(&std::fs::read_to_string(path).unwrap()).unwrap();
        let mut names: Vec<String> = entry::heads(plan.fields()).into_iter().map(|head| head.name).collect();
        assert!(names.len() > 60);
        names.sort();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{file}: {names:?}");
    }
}

fn heads() -> Vec<Head> {
    let named = Tally::COLUMNS.map(|name| match name {
        "run" | "redraws" | "first_robot" | "first_other_robot" => Head::new(name, Kind::Whole),
        "controller" | "violated" | "first_law" => Head::new(name, Kind::Text),
        _ => Head::new(name, Kind::Number),
    });
    named.into_iter().chain([Head::new("team.robots", Kind::Number)]).collect()
}

/// Run `run` under a controller; violating runs break two laws.
fn push(rows: &mut Rows, run: i64, controller: &str, violating: bool) {
    let word = |word: &str| Some(Cell::Text(word.to_owned()));
    let number = |number: f64| Some(Cell::Number(number));
    let first = |value: Option<Cell>| value.filter(|_| violating);
    let size = |number: i64| f64::from(i32::try_from(number).unwrap());
    rows.push(vec![
        Some(Cell::Whole(run)),
        word(controller),
        Some(Cell::Whole(2)),
        first(word("degree,distance")),
        number(1.0 + 0.01 * size(run)),
        first(word("degree")),
        first(number(0.5)),
        first(Some(Cell::Whole(2))),
        None,
        first(number(3.0)),
        first(number(4.0)),
        number(4.0 + size(run % 7)),
    ]);
}

fn some() -> Rows {
    let mut rows = Rows::empty(&heads());
    for run in 0..100 {
        push(&mut rows, run, "budget", false);
        push(&mut rows, run, "composed", run % 4 == 1);
    }
    rows
}

fn tally() -> Tally {
    let mut tally = Tally::new(&[Field { path: "team.robots".into(), number: true, few: true }]);
    tally.add(&some());
    tally
}

#[test]
fn rows_come_back_as_they_were_written() {
    let mut writer = Writer::new(Vec::new(), &heads(), &[("seed", "7".to_owned())]).unwrap();
    (0..3).for_each(|_| writer.add(some()).unwrap());
    assert!(writer.add(Rows::empty(&heads()[1..])).is_err(), "other columns");
    let file = Bytes::from(writer.finish().unwrap());
    let mut back = Rows::empty(&heads());
    read(file.clone(), &[], &mut |rows| assert!(back.append(rows))).unwrap();
    let mut all = some();
    (0..2).for_each(|_| assert!(all.append(some())));
    assert_eq!(back, all);
    let mut columns = Vec::new();
    read(file.clone(), &["gyration_m", "run"], &mut |rows| columns.extend(rows.heads().to_vec())).unwrap();
    assert_eq!(columns, [Head::new("run", Kind::Whole), Head::new("gyration_m", Kind::Number)]);
    for length in [0, 4, 100, file.len() - 9] {
        assert!(read(file.slice(..length), &[], &mut |_| ()).is_err(), "{length}");
    }
}

#[test]
fn counts_are_by_controller_law_and_value() {
    let tally = tally();
    assert_eq!((tally.runs, tally.redraws), (100, 200), "redraws count once a run");
    let composed = &tally.controllers["composed"];
    assert_eq!((composed.runs, composed.violating, composed.laws["distance"]), (100, 25, 25));
    assert!((composed.gyration_mean_m().unwrap() - 1.495).abs() < 1e-12);
    assert_eq!(tally.violating.iter().map(|one| one.run).collect::<Vec<_>>(), [1, 5, 9]);
    let table = text(&controllers(&tally, &["degree", "input"]));
    assert!(
        table.contains("composed     100          25  25.0 %   33.1 %      25      0     1.495"),
        "{table}"
    );
    let table = values(&tally);
    assert_eq!(table.rows[0], ["team.robots", "4", "0 of 15", "3 of 15"]);
    assert_eq!(table.rows[6][..2], ["", "10"]);
}

#[test]
fn figures_are_whole_also_of_nothing() {
    let tally = tally();
    let mut spread = Spread::new(&tally);
    spread.add(&some());
    let laws = shares(&tally, &["degree", "distance"]);
    assert!(laws.contains("25 of 100") && laws.contains("0 of 100") && laws.contains("composed (100 runs)"));
    assert!(png(&laws, 1.0).is_ok() && png(&gyrations(&tally, &spread), 1.0).is_ok());
    let nothing = Tally::default();
    assert!(png(&shares(&nothing, &[]), 1.0).is_ok());
    assert!(png(&gyrations(&nothing, &Spread::new(&nothing)), 1.0).is_ok());
}

#[test]
fn shares_read_well() {
    assert_eq!(
        [0.0, 3e-7, 0.000_3, 0.0312, 0.5, 1.0].map(percent),
        ["0 %", "0.000030 %", "0.0300 %", "3.12 %", "50.0 %", "100.0 %"]
    );
}
