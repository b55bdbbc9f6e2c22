//! Writes every kind of picture and file into a folder: `cargo run --release --example figures -- FOLDER`.

use std::fs;
use std::path::Path;

use closeranks_report::figure::{Case, figure1, figure2, overview};
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::record::Record;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::start::Start;
use closeranks_sim::world::{Options, run};

type Failure = Box<dyn std::error::Error>;

const TITLES: [&str; 3] = ["nominal updating", "understating", "overstating"];

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).ok_or("usage: figures FOLDER")?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    paper(folder, "published", &Start::Published)?;
    paper(folder, "inside", &Start::Inside)?;
    let crowd =
        Scenario { robots: 200, start: Start::Hexagon { spacing_m: 0.5 }, duration_s: 2.0, ..spread() };
    single(folder, "crowd", &crowd)?;
    let cube = Scenario {
        dimension: 3,
        input_min_m_s: vec![-1.5; 3],
        input_max_m_s: vec![1.5; 3],
        start: Start::Random { half_side_m: 0.9, distance_min_m: 0.5 },
        ..spread()
    };
    single(folder, "cube", &cube)?;
    single(folder, "instant", &Scenario { duration_s: 0.0, ..spread() })
}

fn spread() -> Scenario {
    Scenario { level_attack: LevelAttack::Bias(3.5), ..Scenario::default() }
}

fn record(scenario: &Scenario) -> Result<Record, Failure> {
    let run = run(scenario, Options { record: true, ..Options::default() }, &mut |_| ())?;
    run.record.ok_or_else(|| "no record".into())
}

fn paper(folder: &Path, name: &str, start: &Start) -> Result<(), Failure> {
    let attacks = [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5)];
    let scenarios =
        attacks.map(|level_attack| Scenario { level_attack, start: start.clone(), ..Scenario::default() });
    let records = scenarios.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    let cases: Vec<Case<'_>> = (0..3)
        .map(|index| Case { title: TITLES[index], scenario: &scenarios[index], record: &records[index] })
        .collect();
    for (figure, svg) in [("figure1", figure1(&cases)), ("figure2", figure2(&cases))] {
        picture(folder, &format!("{name}-{figure}"), &svg)?;
    }
    for (case, file) in cases.iter().zip(["nominal", "understating", "overstating"]) {
        let metadata = Metadata { scenario: "# none", seed: 1, version: "0.1.0", commit: "none" };
        write(case.record, &metadata, fs::File::create(folder.join(format!("{name}-{file}.parquet")))?)?;
    }
    picture(folder, &format!("{name}-overview"), &overview(cases[0]))
}

fn single(folder: &Path, name: &str, scenario: &Scenario) -> Result<(), Failure> {
    let record = record(scenario)?;
    picture(folder, name, &overview(Case { title: name, scenario, record: &record }))
}

fn picture(folder: &Path, name: &str, svg: &str) -> Result<(), Failure> {
    fs::write(folder.join(format!("{name}.svg")), svg)?;
    fs::write(folder.join(format!("{name}.png")), png(svg, SCALE_200_DPI)?)?;
    Ok(())
}
