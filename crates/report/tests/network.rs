//! Pictures of graphs, and recordings read back.

use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::makers::fixed::{k_circulant, tight};
use closeranks_report::network::{Network, network};
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::png::png;
use closeranks_report::recording::{ReadError, read};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, run};

#[test]
fn sets_are_told_apart_by_shape_and_names_are_escaped() {
    let graph = tight(8, 1).unwrap();
    let names: Vec<String> = (0..8).map(|node| format!("<{node}>")).collect();
    let (first, second) = (NodeSet::first(4), NodeSet::from_bits(0b111_0000));
    let exempt = NodeSet::from_bits(0b1_0000);
    let labels = ["one", "other", "lie"];
    let shown = Network { graph: &graph, names: &names, title: "a & b", first, second, exempt, labels };
    let svg = network(&shown);
    let count = |part: &str| svg.matches(part).count();
    // Four of the set and one other, with a sample of each in the legend.
    assert_eq!(count("<circle"), 4 + 1 + 2);
    // The ground, the exempt node, its sample.
    assert_eq!(count("<rect"), 1 + 1 + 1);
    assert!(svg.contains("&lt;0&gt;") && svg.contains("a &amp; b") && svg.contains("other robots"));
    assert_eq!(svg, network(&shown));
    assert!(png(&svg, 1.0).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn arrows_are_drawn_where_edges_have_a_direction() {
    let picture = |directed| {
        let graph = k_circulant(7, 2, directed).unwrap();
        let [first, second, exempt] = [NodeSet::EMPTY; 3];
        network(&Network { graph: &graph, names: &[], title: "", first, second, exempt, labels: [""; 3] })
    };
    assert_eq!(picture(true).matches("<path").count(), 2);
    assert_eq!(picture(false).matches("<path").count(), 1);
}

#[test]
fn a_recording_comes_back_and_a_broken_one_is_an_error() {
    let scenario = Scenario { duration_s: 0.05, ..Scenario::default() };
    let options = Options { record: true, ..Options::default() };
    let record = run(&scenario, options, &mut |_| ()).unwrap().record.unwrap();
    let mut file = Vec::new();
    write(&record, &Metadata { scenario: "seed = 1", ..Metadata::default() }, &mut file).unwrap();
    let found = read(file.clone()).unwrap();
    assert_eq!((found.robots, found.ticks(), found.scenario.as_deref()), (11, 11, Some("seed = 1")));
    for tick in 0..found.ticks() {
        for (index, point) in found.at(tick).iter().enumerate() {
            let row = record.row(tick, index);
            assert_eq!(*point, [record.positions_m[0][row], record.positions_m[1][row], 0.0]);
        }
    }
    assert!(matches!(read(b"PAR1PAR1".to_vec()), Err(ReadError::Parquet(_))));
    // Every byte of the file wrong once: an error or other numbers, never a panic.
    for place in 0..file.len() {
        let mut broken = file.clone();
        broken[place] ^= 0x55;
        if let Ok(found) = read(broken) {
            assert_eq!(found.positions_m.len(), found.robots * found.ticks());
        }
    }
}
