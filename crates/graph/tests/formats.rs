//! Every format: what is written reads back, what others write is read, what is wrong is named, nothing panics.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use closeranks_graph::formats::{
    Format, Named, Options, Problem, ToldBy, WriteError, read, recognise, write,
};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{fixed, random};

/// The formats that are written.
fn written() -> Vec<Format> {
    Format::ALL.into_iter().filter(|format| format.is_written()).collect()
}

fn asked(format: Format) -> Options<'static> {
    Options { format: Some(format), ..Options::default() }
}

#[test]
fn the_table_of_formats_is_in_order() {
    for format in Format::ALL {
        assert_eq!(Format::from_name(format.name()), Some(format));
    }
    assert_eq!(written().len(), 6);
    assert_eq!(Format::from_name("pickle"), None);
}

#[test]
fn what_is_written_reads_back() {
    for seed in 0..200_u64 {
        let count = 1 + usize::try_from(seed * 7 % 128).unwrap();
        let graph = random::erdos_renyi(count, 0.3, seed.is_multiple_of(2), seed).unwrap();
        let named = Named::from(graph);
        for format in written() {
            let text = write(&named, format).unwrap();
            assert_eq!(read(&text, &asked(format)).unwrap().named, named, "{format:?}");
            if count > 2 {
                assert_eq!(recognise(&text, &Options::default()), Ok((format, ToldBy::Content)), "{text}");
            }
        }
    }
}

#[test]
fn strange_names_read_back() {
    let names = ["a b", "\"", "\\", "<&>'\"", "ü→", "\\n", "graph", "01", "x\ty", "-3", "node"];
    let names: Vec<String> = names.into_iter().map(String::from).collect();
    let named = Named { graph: fixed::ring(names.len()).unwrap(), names };
    for format in [Format::GraphMl, Format::Dot, Format::Json] {
        let text = write(&named, format).unwrap();
        assert_eq!(read(&text, &asked(format)).unwrap().named, named, "{format:?}\n{text}");
    }
    assert_eq!(write(&named, Format::EdgeList), Err(WriteError::Name { name: "a b".into() }));
}

#[test]
fn what_others_write_is_read() {
    // networkx.write_edgelist, nx.to_graph6_bytes(nx.petersen_graph()), numpy.savetxt, networkx 2 and 3 node_link_data.
    let path = Graph::undirected(3, &[(0, 1), (1, 2)]).unwrap();
    let arrow = Graph::directed(3, &[(0, 1), (1, 2)]).unwrap();
    let graph_of = |text: &str, format| read(text, &asked(format)).unwrap().named.graph;
    assert_eq!(graph_of("# made by hand\n2 1 {'weight': 3}\n0 1 {}\n", Format::EdgeList), path);
    assert_eq!(graph_of("Bg\n", Format::Graph6).edge_count(), 2);
    assert_eq!(graph_of(">>graph6<<IheA@GUAo\n", Format::Graph6).edge_count(), 15);
    let savetxt = "0.0e+00 1.0e+00 0.0e+00\n1.0e+00 0.0e+00 1.0e+00\n0.0e+00 1.0e+00 0.0e+00\n";
    assert_eq!(graph_of(savetxt, Format::Matrix), path);
    assert_eq!(recognise(savetxt, &Options::default()), Ok((Format::Matrix, ToldBy::Content)));
    let json = r#"{"directed": true, "multigraph": false, "graph": {"name": "x"},
        "nodes": [{"id": 0}, {"id": 1, "label": null}, {"id": 2}],
        "links": [{"weight": NaN, "source": 0, "target": 1}, {"source": 1, "target": 2}]}"#;
    assert_eq!(graph_of(json, Format::Json), arrow);
    let dot = "strict digraph \"G\" { // comment\n node [shape=box];\n rankdir=LR\n a -> b -> c [label=\"x]\"]; a -> b }";
    let named = read(dot, &asked(Format::Dot)).unwrap().named;
    assert_eq!((named.graph, named.names.join("")), (arrow.clone(), "abc".into()));
    let graphml = r#"<?xml version='1.0' encoding='utf-8'?>
        <graphml xmlns="http://graphml.graphdrawing.org/xmlns"><key id="d0" for="edge" attr.name="weight"/>
        <!-- <node id="no"/> --><graph edgedefault="directed"><node id="0"/><node id="1">
        <data key="d0">3</data></node><node id='2'/><edge source="0" target="1"><data key="d0">1</data></edge>
        <edge id="e" source="1" target="2"/></graph></graphml>"#;
    assert_eq!(graph_of(graphml, Format::GraphMl), arrow);
}

#[test]
fn a_number_is_the_rank_of_its_node() {
    let plain =
        |text: &str, directed| read(text, &Options { directed, ..asked(Format::EdgeList) }).unwrap().named;
    let named = plain("10 2\n2 7\n", None);
    assert_eq!(named.names, ["2", "7", "10"]);
    assert!(named.graph.has_edge(0, 2) && named.graph.has_edge(0, 1));
    let named = plain("directed\nb a\n", None);
    assert_eq!(named.names, ["b", "a"]);
    assert!(named.graph.has_edge(0, 1) && !named.graph.has_edge(1, 0));
    assert!(!plain("directed\nb a\n", Some(false)).graph.is_directed());
}

#[test]
fn transposing_turns_every_edge_round() {
    let options = Options { directed: Some(true), transpose: true, ..Options::default() };
    let turned = read("0 1 1\n0 0 1\n0 0 0\n", &options).unwrap();
    assert_eq!(turned.named.graph, Graph::directed(3, &[(1, 0), (2, 0), (2, 1)]).unwrap());
    let undirected = read("a b\n", &Options { transpose: true, ..Options::default() }).unwrap();
    assert_eq!(undirected.notes[0].to_string(), "undirected, so there was nothing to transpose");
}

#[test]
fn what_is_wrong_is_named() {
    use Format::{Dot, EdgeList, GraphMl, Json, Matrix};
    let double = |from: &str, to: &str| Problem::DoubleEdge { from: from.into(), to: to.into() };
    let unknown = |name: &str| Problem::UnknownNode { name: name.into() };
    let json = "{\"nodes\": [1, 2],\n\"edges\": [{\"source\": 1,\n\"target\": 3}]}";
    let xml = "<graph edgedefault='undirected'>\n<node id='a'/>\n<edge source='a' target='b'/></graph>";
    let cases = [
        (EdgeList, "a b\n\nc c\n", 3, Problem::Loop { node: "c".into() }),
        (EdgeList, "a b\nb a\n", 2, double("b", "a")),
        (EdgeList, "", 1, Problem::NoNodes),
        (Matrix, "0,1\n0,0\n", 1, Problem::OneSided { row: 0, column: 1 }),
        (Matrix, "0,0\n0,1\n", 2, Problem::Loop { node: "1".into() }),
        (Json, json, 3, unknown("3")),
        (GraphMl, xml, 3, unknown("b")),
        (Dot, "graph {\n a -- b -- a }", 2, double("b", "a")),
        (Dot, "graph {\n a -- a }", 2, Problem::Loop { node: "a".into() }),
        (Json, "{\"nodes\": [1,\n1]}", 2, Problem::NodeTwice { name: "1".into() }),
    ];
    for (format, text, line, problem) in cases {
        let error = read(text, &Options { strict: true, ..asked(format) }).unwrap_err();
        assert_eq!((error.line, error.problem), (line, problem), "{text}");
    }
}

#[test]
fn what_is_unexpected_is_shown() {
    let cases = [
        (Format::Matrix, "0,x\nx,0\n", "line 1: found \"x\", expected 0 or 1"),
        (
            Format::Matrix,
            "0,1,0\n1,0\n0,1,0",
            "line 2: found \"0\", expected as many entries in every row as rows",
        ),
        (Format::Dot, "graph {\n a -> b }", "line 2: found \"->\", expected -> in a digraph, -- in a graph"),
        (
            Format::Dot,
            "graph {\n a -- b",
            "line 2: ends here, expected a node, an edge, a subgraph, an attribute or }",
        ),
        (Format::Json, "{\"nodes\": [\n}", "line 2: found \"}\", expected a value of JSON"),
        (
            Format::Json,
            "{\n\"nodes\": 3}",
            "line 2: expected an object with \"nodes\" and \"edges\", \"links\" or \"adjacency\", or with \"elements\"",
        ),
        (
            Format::EdgeList,
            "a b c",
            "line 1: found \"c\", expected two names, and at most a weight after them",
        ),
        (Format::Graph6, "B", "line 1: found \"B\", expected six bits to a byte for every pair of nodes"),
        (Format::GraphMl, "<graphml/>", "line 1: ends here, expected a graph element"),
        (
            Format::GraphMl,
            "<graphml>\n<graph>\n",
            "line 2: not well-formed XML: it ends before its first element does",
        ),
    ];
    for (format, text, message) in cases {
        assert_eq!(read(text, &asked(format)).unwrap_err().to_string(), message);
    }
    let many: String = (0..129).fold("directed\n".into(), |text: String, node| text + &format!("n{node}\n"));
    let error = read(&many, &asked(Format::EdgeList)).unwrap_err();
    assert_eq!((error.line, error.problem), (130, Problem::TooManyNodes));
    for (format, sign) in [
        (Format::Json, "["),
        (Format::Dot, "graph {{"),
        (Format::Gml, "graph [ a "),
        (Format::GraphMl, "<a>"),
    ] {
        assert!(read(&sign.repeat(100_000), &asked(format)).is_err());
    }
    let long = " ".repeat(1 << 23);
    assert!(matches!(read(&long, &asked(Format::Dot)).unwrap_err().problem, Problem::TextTooLong { .. }));
}

#[test]
fn no_text_makes_a_reader_panic() {
    let named = Named::from(random::erdos_renyi(9, 0.4, true, 1).unwrap());
    let letters: Vec<char> = "01 ,;\n\t\"'\\<>/&#?!={}[]:-~@ae_ü→\u{0}gu".chars().collect();
    let mut state = 1_u64;
    let mut next = |bound: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).unwrap() % bound
    };
    for round in 0..10_000 {
        let format = written()[round % 6];
        let mut text: Vec<char> = write(&named, format).unwrap().chars().collect();
        for _ in 0..=next(4) {
            let place = next(text.len());
            match next(4) {
                0 => text.truncate(place + 1),
                1 => drop(text.remove(place)),
                2 => text[place] = letters[next(letters.len())],
                _ => text.insert(place, letters[next(letters.len())]),
            }
            text.push('\n');
        }
        let text: String = text.into_iter().collect();
        for format in Format::ALL.map(Some).into_iter().chain([None]) {
            if let Ok(found) = read(&text, &Options { format, ..Options::default() }) {
                assert!(found.named.names.len() == found.named.graph.node_count());
            }
        }
    }
}
