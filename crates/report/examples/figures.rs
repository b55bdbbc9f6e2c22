//! Writes every kind of picture and file into a folder: `cargo run --release --example figures -- FOLDER`.

use closeranks_core::settings::Team;
use closeranks_sim::scenario::Limits;
use std::fs;
use std::path::Path;

use closeranks_report::content::{Claim, Figure, Page, Section, Table};
use closeranks_report::figure::{Case, figure1, figure2, overview};
use closeranks_report::html::html;
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, run};

type Failure = Box<dyn core::error::Error>;

const TITLES: [&str; 3] = ["nominal updating", "understating", "overstating"];

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).ok_or("usage: figures FOLDER")?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    paper(folder, "published", &Start::Published)?;
    paper(folder, "inside", &Start::Inside)?;
    let crowd = Scenario {
        start: Start::Hexagon { spacing_m: 0.5 },
        duration_s: 2.0,
        team: Team { robots: 200, ..spread().team },
        ..spread()
    };
    single(folder, "crowd", &crowd)?;
    let cube = Scenario {
        dimension: 3,
        start: Start::Random { half_side_m: 0.9, distance_min_m: 0.5 },
        limits: Limits {
            input_min_m_s: vec![-1.5; 3],
            input_max_m_s: vec![1.5; 3],
            ..spread().limits.clone()
        },
        ..spread()
    };
    single(folder, "cube", &cube)?;
    single(folder, "instant", &Scenario { duration_s: 0.0, ..spread() })
}

fn spread() -> Scenario {
    Scenario { attack: LevelAttack::Bias(3.5).into(), ..Scenario::default() }
}

fn record(scenario: &Scenario) -> Result<Record, Failure> {
    let run = run(scenario, Options { record: true, ..Options::default() }, &mut |_| ())?;
    run.record.ok_or_else(|| "no record".into())
}

fn paper(folder: &Path, name: &str, start: &Start) -> Result<(), Failure> {
    let attacks = [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5)];
    let scenarios = attacks.map(|level_attack| Scenario {
        attack: level_attack.into(),
        start: start.clone(),
        ..Scenario::default()
    });
    let records = scenarios.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    let cases: Vec<Case<'_>> = (0..3)
        .map(|index| Case { title: TITLES[index], scenario: &scenarios[index], record: &records[index] })
        .collect();
    let figures = [("figure1", figure1(&cases)), ("figure2", figure2(&cases))];
    for (figure, svg) in &figures {
        picture(folder, &format!("{name}-{figure}"), svg)?;
    }
    fs::write(folder.join(format!("{name}.html")), html(&page(name, &cases, figures.map(|(_, svg)| svg))))?;
    for (case, file) in cases.iter().zip(["nominal", "understating", "overstating"]) {
        table_file(folder, &format!("{name}-{file}"), case.record)?;
    }
    let long = Case { title: "a title that is too long for its panel", ..cases[2] };
    for some in [vec![long], [&cases[..], &[long]].concat()] {
        let count = some.len();
        picture(folder, &format!("{name}-{count}-figure1"), &figure1(&some))?;
        picture(folder, &format!("{name}-{count}-figure2"), &figure2(&some))?;
    }
    picture(folder, &format!("{name}-overview"), &overview(cases[0]))
}

fn single(folder: &Path, name: &str, scenario: &Scenario) -> Result<(), Failure> {
    let record = record(scenario)?;
    table_file(folder, name, &record)?;
    picture(folder, name, &overview(Case { title: name, scenario, record: &record }))
}

fn table_file(folder: &Path, name: &str, record: &Record) -> Result<(), Failure> {
    let metadata = Metadata { scenario: "# none", seed: 1, version: "0.1.0", commit: "none" };
    Ok(write(record, &metadata, fs::File::create(folder.join(format!("{name}.parquet")))?)?)
}

fn picture(folder: &Path, name: &str, svg: &str) -> Result<(), Failure> {
    fs::write(folder.join(format!("{name}.svg")), svg)?;
    fs::write(folder.join(format!("{name}.png")), png(svg, SCALE_200_DPI)?)?;
    Ok(())
}

/// Enough of everything to see how it looks; the real page is made by the command line.
fn page(name: &str, cases: &[Case<'_>], figures: [String; 2]) -> Page {
    let captions = ["Formations at the start and after 10 s.", "Barriers (a-c) and values (d-f)."];
    let figures = figures.into_iter().zip(captions);
    let figures = figures.map(|(svg, caption)| Figure { caption: caption.into(), svg }).collect();
    let sentences = [
        ("Each simulation begins with every robot having at least seven neighbors.", true),
        ("Notably, one malicious robot fails to maintain seven neighbors.", false),
    ];
    let numbers = format!("least h of all robots {}", least(&cases[0].record.h));
    let claim = |(sentence, holds): (&str, bool)| Claim {
        sentence: sentence.into(),
        holds,
        numbers: numbers.clone(),
    };
    let section = Section {
        title: name.into(),
        paragraphs: vec![format!("Three scenarios from the start <{name}>.")],
        tables: vec![("One row a scenario & what it came to.".into(), table(cases))],
        claims: sentences.map(claim).into(),
        figures,
    };
    Page {
        title: "Distributed resilience-aware control, section V".into(),
        lead: "Eleven robots, two of them malicious, pull in four directions and stay connected enough to agree.".into(),
        sections: vec![section, Section { title: "Another part".into(), ..Section::default() }],
        footer: "closeranks 0.1.0, commit none, `closeranks paper`".into(),
    }
}

fn table(cases: &[Case<'_>]) -> Table {
    let heads =
        "scenario,least degree,least h,least phi_i,links,gyration (m),rounds,infeasible,negative phi,time";
    let row = |case: &Case<'_>| {
        let degree = case.record.degree.iter().min().map(u16::to_string).unwrap_or_default();
        let (h, phi) = (least(&case.record.h), least(&case.record.phi));
        [case.title, &degree, &h, &phi, "46", "1.48", "4", "0", "120", "18 ms"].map(String::from).to_vec()
    };
    Table { heads: heads.split(',').map(String::from).collect(), rows: cases.iter().map(row).collect() }
}

fn least(numbers: &[f64]) -> String {
    format!("{:.3}", numbers.iter().copied().fold(f64::INFINITY, f64::min))
}
