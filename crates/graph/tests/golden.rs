//! The golden file: 80 graphs, every number found by five other programs.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use closeranks_graph::definition::Witness;
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::makers::{fixed, random};
use closeranks_graph::table;
use common::{NO_TABLE, full_analysis, with_meter};
use serde_json::Value;

#[test]
fn analysis_has_the_golden_numbers() {
    for entry in golden() {
        let graph = graph_of(&entry);
        let analysis = full_analysis(&graph, &NO_TABLE);
        assert_eq!(i64::from(analysis.r_max.exactly().unwrap()), entry["r_robustness"], "{}", entry["name"]);
        assert_eq!(i64::from(analysis.f_max.exactly().unwrap()), entry["F_max"], "{}", entry["name"]);
        assert_eq!(analysis.degree_min, number(&entry["min_in_degree"]));
        assert_eq!(analysis.degree_max, number(&entry["max_in_degree"]));
        for (index, (s_max, _)) in analysis.s_max.iter().enumerate() {
            let golden = &entry["s_max_by_r"][(index + 1).to_string()];
            assert_eq!(i64::from(s_max.exactly().unwrap()), *golden, "{} {}", entry["name"], index + 1);
        }
        assert_eq!(entry["s_max_by_r"].as_object().unwrap().len(), analysis.s_max.len());
    }
}

#[test]
fn the_table_has_the_golden_numbers() {
    for entry in golden() {
        let graph = graph_of(&entry);
        let (r_max, s_max) = with_meter(|meter| {
            let r_max = table::r_max(&graph, 1 << 12, meter).unwrap().0;
            (r_max, table::s_max_table(&graph, 1 << 12, meter).unwrap())
        });
        assert_eq!(r_max, number(&entry["r_robustness"]), "{}", entry["name"]);
        for (index, s_max) in s_max.iter().enumerate() {
            assert_eq!(*s_max, number(&entry["s_max_by_r"][(index + 1).to_string()]), "{}", entry["name"]);
        }
    }
}

#[test]
fn the_golden_witnesses_hold() {
    for entry in golden() {
        let graph = graph_of(&entry);
        for name in ["witness_not_r_plus_1", "witness_not_F_plus_2"] {
            let golden = &entry[name];
            let set = |key: &str| -> NodeSet { golden[key].as_array().unwrap().iter().map(number).collect() };
            let (r, s) = (number(&golden["r"]), number(&golden["s"]));
            assert!(Witness::new(&graph, r, s, set("S1"), set("S2")).holds(&graph), "{}", entry["name"]);
        }
    }
}

#[test]
fn makers_make_the_golden_graphs() {
    let made = [
        ("K9", fixed::complete(9)),
        ("C8", fixed::ring(8)),
        ("P6", fixed::path(6)),
        ("star_K1_6", fixed::star(7)),
        ("wheel_W5", fixed::wheel(5)),
        ("wheel_W9", fixed::wheel(9)),
        ("K3_4", fixed::bipartite(3, 4)),
        ("petersen", fixed::petersen()),
        ("hypercube_Q3", fixed::hypercube(3)),
        ("moebius_ladder_8", fixed::circulant(8, &[1, 4], false)),
        ("circulant_11_1_2_3", fixed::k_circulant(11, 3, false)),
        ("k_circulant_digraph_10_4", fixed::k_circulant(10, 4, true)),
        ("F_elemental_type_F1", fixed::elemental(1)),
        ("F_elemental_type_F2", fixed::elemental(2)),
        ("tight_n8_F1", fixed::tight(8, 1)),
        ("tight_n10_F2", fixed::tight(10, 2)),
    ];
    let golden = golden();
    for (name, graph) in made {
        let entry = golden.iter().find(|entry| entry["name"] == name).unwrap();
        assert_eq!(graph.unwrap(), graph_of(entry), "{name}");
    }
    let entry = golden.iter().find(|entry| entry["name"] == "pref_attach_n10_m3_seedK5").unwrap();
    let like = random::preferential_attachment(10, 5, 3, 1).unwrap();
    assert_eq!(like.edge_count(), graph_of(entry).edge_count());
}

fn golden() -> Vec<Value> {
    let file: Value = serde_json::from_str(include_str!("golden/robustness.json")).unwrap();
    file["graphs"].as_array().unwrap().clone()
}

fn graph_of(entry: &Value) -> Graph {
    let edges = entry["edges"].as_array().unwrap().iter();
    let edges: Vec<_> = edges.map(|edge| (number(&edge[0]), number(&edge[1]))).collect();
    let make = if entry["directed"] == true { Graph::directed } else { Graph::undirected };
    make(number(&entry["n"]), &edges).unwrap()
}

fn number(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}
