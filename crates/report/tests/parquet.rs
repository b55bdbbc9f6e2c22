//! The file of a run, read back with the reader of the crate that wrote it.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use bytes::Bytes;
use closeranks_report::parquet::{Metadata, write};
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::output::record::{Record, outcome_name};
use closeranks_sim::scenario::Limits;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, run};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

const METADATA: Metadata<'_> = Metadata {
    scenario: "name = \"a <b> & 'c'\"\n",
    seed: u64::MAX,
    version: "0.1.0",
    commit: "abc",
    weight: [2.1, 0.3],
};

fn record(scenario: &Scenario) -> Record {
    run(scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap().record.unwrap()
}

fn file(record: &Record) -> Vec<u8> {
    let mut file = Vec::new();
    write(record, &METADATA, &mut file).unwrap();
    file
}

fn short() -> Scenario {
    Scenario { duration_s: 0.05, attack: LevelAttack::Bias(-2.5).into(), ..Scenario::default() }
}

fn cube() -> Scenario {
    Scenario {
        dimension: 3,
        start: Start::Random { half_side_m: 0.9, distance_min_m: 0.4 },
        limits: Limits {
            input_min_m_s: vec![-1.5; 3],
            input_max_m_s: vec![1.5; 3],
            ..short().limits.clone()
        },
        ..short()
    }
}

/// What row `row` of the file should hold.
fn expected(record: &Record, row: usize) -> Vec<Field> {
    let robots = usize::from(record.robots);
    let (tick, index) = (row / robots, row % robots);
    let number = |column: &Vec<f64>| Field::Double(column[row]);
    let input = |column: &Vec<f64>| if tick == record.last_tick() { Field::Null } else { number(column) };
    let mut fields = vec![
        Field::UInt(u32::try_from(tick).unwrap()),
        Field::Double(record.time_s(tick)),
        Field::UShort(u16::try_from(index + 1).unwrap()),
        Field::Bool(record.malicious[index]),
    ];
    fields.extend(record.positions_m.iter().map(number));
    fields.extend(record.inputs_m_s.iter().map(input));
    fields.push(Field::UShort(record.degree[row]));
    let known = |column: &Vec<f64>| if column[row].is_nan() { Field::Null } else { number(column) };
    fields.extend([number(&record.level), known(&record.told)]);
    fields.extend([&record.h, &record.phi, &record.value].map(number));
    fields.extend([&record.value_told, &record.degree_sensed, &record.level_sensed].map(known));
    fields.push(Field::Str(outcome_name(record.outcome[row]).into()));
    fields
}

#[test]
fn every_field_of_every_row_comes_back() {
    for scenario in [short(), cube(), Scenario { duration_s: 0.0, ..short() }] {
        let record = record(&scenario);
        let reader = SerializedFileReader::new(Bytes::from(file(&record))).unwrap();
        let rows: Vec<Row> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
        assert_eq!(rows.len(), record.rows());
        for (row, fields) in rows.iter().enumerate() {
            let fields: Vec<Field> = fields.get_column_iter().map(|(_, field)| field.clone()).collect();
            assert_eq!(fields, expected(&record, row), "row {row}");
        }
    }
}

#[test]
fn columns_are_those_of_the_contract() {
    let names = |scenario: &Scenario| {
        let reader = SerializedFileReader::new(Bytes::from(file(&record(scenario)))).unwrap();
        let schema = reader.metadata().file_metadata().schema_descr_ptr();
        schema.columns().iter().map(|column| column.name().to_owned()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        names(&short()),
        "tick time_s robot malicious x_m y_m ux_m_s uy_m_s degree level told h phi_i value \
         value_told degree_sensed level_sensed outcome"
    );
    assert_eq!(
        names(&cube()),
        "tick time_s robot malicious x_m y_m z_m ux_m_s uy_m_s uz_m_s degree level told h phi_i value \
         value_told degree_sensed level_sensed outcome"
    );
}

#[test]
fn the_file_says_what_it_is() {
    let reader = SerializedFileReader::new(Bytes::from(file(&record(&short())))).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let pairs: Vec<(&str, &str)> =
        pairs.iter().map(|pair| (pair.key.as_str(), pair.value.as_deref().unwrap())).collect();
    let seed = u64::MAX.to_string();
    let about = [("scenario", METADATA.scenario), ("seed", &seed), ("version", "0.1.0"), ("commit", "abc")];
    assert_eq!(pairs[..4], about);
    let names: Vec<&str> = pairs[4..].iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["q1", "q2"], "the weight that h is about");
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    assert_eq!(file(&record(&cube())), file(&record(&cube())));
}
