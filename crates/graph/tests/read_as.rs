//! What a text is read as, in one line, or why it is refused: nothing is guessed in silence.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use closeranks_graph::formats::{Options, read};

/// `format: names; edges; notes`, or the complaint.
fn told(text: &str, options: &Options<'_>) -> String {
    let reading = match read(text, options) {
        Ok(reading) => reading,
        Err(error) => return error.to_string(),
    };
    let (graph, names) = (&reading.named.graph, &reading.named.names);
    let sign = if graph.is_directed() { ">" } else { "-" };
    let edges: Vec<String> =
        graph.edges().map(|(from, to)| format!("{}{sign}{}", names[from], names[to])).collect();
    let head = format!("{}: {} | {}", reading.format.name(), names.join(" "), edges.join(" "));
    reading.notes.iter().fold(head, |told, note| format!("{told}; {note}"))
}

fn check(cases: &[(&str, &str)], options: &Options<'_>) {
    for (text, expected) in cases {
        let found = told(text, options);
        assert!(found.contains(expected), "{text:?}\n   found {found}\nexpected {expected}");
    }
}

#[test]
fn edge_lists() {
    check(
        &[
            ("a b\nb c\n", "edges: a b c | a-b b-c"),
            ("a -> b\nb <- c\n", "edges: a b c | a>b c>b"),
            ("0 -- 1\n1 -- 2\n", "edges: 0 1 2 | 0-1 1-2"),
            ("a->b\nb--c\n", "edges: a b c | a>b b>c c>b; 1 link without a direction counts in both"),
            ("a-->b\nb<->c\n", "edges: a b c | a>b b>c c>b"),
            ("\"Ann B\",\"C, D\"\nE,F\n", "edges: Ann B C, D E F | Ann B-C, D E-F"),
            ("a;b;0.5\nb;c;2\n", "edges: a b c | a-b b-c"),
            ("0 1 {'weight': 3, 'color': 'red'}\n1 2 {}\n", "edges: 0 1 2 | 0-1 1-2"),
            (
                "Source,Target,Type,Id,Weight\n1,2,Undirected,0,1.0\n2,3,Undirected,1,1.0\n",
                "edges: 1 2 3 | 1-2 2-3; line 1 is a header and was skipped: \"Source,Target,Type,Id,Weight\"; 1 column beside",
            ),
            (",source,target\n0,a,b\n1,b,c\n", "edges: a b c | a-b b-c; line 1 is a header"),
            ("Knoten Nachbar\n1 2\n2 3\n", "edges: 1 2 3 | 1-2 2-3; line 1 is a header"),
            (
                "source target\ntarget source2\n",
                "edges: source target source2 | source-target target-source2",
            ),
            (
                "a b\nb a\na a\n",
                "1 parallel link counts once; 1 loop is left out: a robot does not count itself",
            ),
            ("# Undirected graph\n1 2\n", "edges: 1 2 | 1-2"),
            ("% asym unweighted\n% 2 3 3\n1 2\n2 3\n", "edges: 1 2 3 | 1>2 2>3"),
            ("undirected\na\nb\na b\n", "edges: a b | a-b"),
        ],
        &Options::default(),
    );
}

#[test]
fn edge_lists_that_are_refused() {
    check(
        &[
            ("0 1\n0 1 2\n", "line 2: 3 columns, but 2 in line 1"),
            ("0 1\n1 2\n2\n", "line 3: 1 column, but 2 in line 1"),
            ("# directed or not\n1 2\n", "line 1: a comment speaks of direction, but not plainly"),
            ("0 1\n2\n", "line 2: 1 column, but 2 in line 1"),
            ("1 2 0.5 7\n2 3 0.5 8\n", "found \"7\", expected two names, and at most a weight after them"),
            ("a likes b\n", "found \"b\", expected two names"),
            ("0 1 0\n1 2 1\n", "a weight other than 0: nobody can know whether 0 is a link"),
            ("0 1 nan\n1 2 1\n", "found \"nan\""),
            ("*a b\n", "found \"*a\", expected the name of a robot"),
            (":a b\n", "found \":a\""),
            ("a %b\n", "found \"%b\""),
            ("a b;c\nd e\n", "found \"b;c\""),
            ("(a b\n", "found \"a b\", expected pairs such as (0, 1)"),
            ("a( b\n", "found \"a(\""),
            ("a|b c\n", "found \"a|b\""),
            ("a->b--c\n", "line 1: the text is one word"),
            ("hello\n", "line 1: the text is one word, \"hello\""),
            (
                "a\nb\nc\n",
                "line 1: found \"a\", expected two names; single ones are allowed after a first line",
            ),
            ("0 1, 2 3\n", "found \"0 1\""),
            ("1 2\n01 3\n", "the names \"1\" and \"01\" are the same number"),
            ("# was directed once\n1 2\n", "line 1: a comment speaks of direction, but not plainly"),
            ("% bip\n1 1\n", "expected a graph with one numbering"),
            ("0.5 1.0\n1.0 0.5\n", "this does not look like an edge list"),
            ("a,,b\n", "found \"b\""),
            ("a,\n", "line 1: found \"a\", expected two names"),
        ],
        &Options::default(),
    );
}

#[test]
fn what_may_be_two_graphs_is_refused() {
    check(
        &[
            // Edges with weights, or a node and two neighbours a line.
            (
                "0 1 3\n1 0 2\n2 1 3\n3 0 2\n",
                "may be an edge list or an adjacency list, which are different graphs: expected the format edges or adjacency",
            ),
            // Three nodes and two links, or the edges 3-2, 0-1 and 1-2.
            ("3 2\n0 1\n1 2\n", "may be an edge list or an edge list after a line of counts"),
            ("1 0\n0 1\n", "may be a matrix or an edge list"),
            ("1 2 2\n1 0 2\n0 0 1\n", "may be a matrix or an edge list"),
            ("0 2\n2 0\n", "may be a matrix or an edge list"),
            ("4 4\n2 4\n1 3\n2 4\n1 3\n", "may be an edge list after a line of counts or METIS"),
            ("# hub\na 1\nb 2\n", "may be an edge list or LGL"),
            ("1 2\n2 3\n3 1\n#\n1 2\n", "may be an edge list or TGF"),
        ],
        &Options::default(),
    );
    // The ending settles if it is used for nothing else.
    let ring = "4 4\n2 4\n1 3\n2 4\n1 3\n";
    let ending = |ending| Options { ending: Some(ending), ..Options::default() };
    assert_eq!(told(ring, &ending("graph")), "metis: 1 2 3 4 | 1-2 1-4 2-3 3-4");
    assert!(told(ring, &ending("edges")).contains("may be"));
    // The same graph either way needs no choice.
    check(
        &[("0 1\n1 0\n", "matrix: 0 1 | 0-1"), ("# GMT Thu\n0 1\n1 2\n2\n", "adjacency: 0 1 2 | 0-1 1-2")],
        &Options::default(),
    );
}

#[test]
fn content_beats_ending() {
    let dot = Options { ending: Some("csv"), ..Options::default() };
    assert_eq!(told("graph { a -- b }", &dot), "dot: a b | a-b");
    assert_eq!(
        told("0 1\n1 2\n", &Options { ending: Some("json"), ..Options::default() }),
        "edges: 0 1 2 | 0-1 1-2"
    );
}

#[test]
fn tables_are_edge_lists_where_they_are_not_square() {
    let csv = Options { ending: Some("csv"), ..Options::default() };
    check(
        &[
            ("Source,Target,Weight\na,b,1\nb,c,0\n", "line 3: found \"0\", expected a weight other than 0"),
            ("0,1,0\n0,0,x\n0,1,0\n", "line 2: found \"x\", expected 0 or 1"),
        ],
        &csv,
    );
}

#[test]
fn matrices() {
    check(
        &[
            (",a,b\na,0,1\nb,1,0\n", "matrix: a b | a-b"),
            ("\"\";\"a\";\"b\";\"c\"\n\"a\";0;1;0\n\"b\";1;0;1\n\"c\";0;1;0\n", "matrix: a b c | a-b b-c"),
            ("a b c\na 0 1 0\nb 1 0 1\nc 0 1 0\n", "matrix: a b c | a-b b-c"),
            ("x,y,z\n0,1,0\n1,0,1\n0,1,0\n", "matrix: x y z | x-y y-z"),
            ("False True False\nTrue False True\nFalse True False\n", "matrix: 0 1 2 | 0-1 1-2"),
            ("0.0,1.0,0.0\n1.0,0.0,1.0\n0.0,1.0,0.0\n", "matrix: 0 1 2 | 0-1 1-2"),
            ("1 1 0\n1 1 1\n0 1 1\n", "3 loops are left out"),
            ("0 1 0\n0 0 1\n0 0 0\n", "row 0 column 1 is a link but row 1 column 0 is not"),
            ("0 0.5 0\n0.5 0 1\n0 1 0\n", "0 or 1, or that weights are asked for"),
            (",a,b\na,0,1\nc,1,0\n", "line 3: "),
            (
                "%%MatrixMarket matrix coordinate pattern symmetric\n% a comment\n3 3 2\n2 1\n3 2\n",
                "matrix-market: 0 1 2 | 0-1 1-2",
            ),
            (
                "%%MatrixMarket matrix coordinate pattern symmetric\n3 3 3\n2 1\n3 2\n",
                "3 entries promised, 2 found",
            ),
            ("%%MatrixMarket matrix array real symmetric\n2 2\n0\n1\n0\n", "matrix-market: 0 1 | 0-1"),
        ],
        &Options::default(),
    );
    check(
        &[("0 0.5 0\n0.5 0 -1\n0 -1 0\n", "matrix: 0 1 2 | 0-1 1-2")],
        &Options { weights: true, ..Options::default() },
    );
    check(
        &[("0 1 0\n0 0 1\n0 0 0\n", "matrix: 0 1 2 | 0>1 1>2")],
        &Options { directed: Some(true), ..Options::default() },
    );
}

#[test]
fn formats_of_programs() {
    check(
        &[
            ("[(0, 1), (1, 2, {'weight': 3})]", "tuples: 0 1 2 | 0-1 1-2"),
            ("('a', 'b')\n('b', 'c')\n", "tuples: a b c | a-b b-c"),
            ("EdgeView([(0, 1)])", "tuples: 0 1 | 0-1"),
            ("# GMT Thu\na 1\nb {}\nb 0\n", "multiline-adjacency: a b | a-b"),
            ("c d\np tw 3 2\n1 2\n2 3\n", "dimacs: 1 2 3 | 1-2 2-3"),
            ("p sp 2 1\na 1 2 7\n", "dimacs: 1 2 | 1>2"),
            ("p edge 3 4\ne 1 2\n", "4 links promised, 1 found: is the text cut off?"),
            ("1: 2 3\n2: 1 3\n3: 1 2\n", "adjacency: 1 2 3 | 1-2 1-3 2-3"),
            ("edges:\n1: 2 3\n2: 1 3\n3: 1 2\n", "line 2: 3 columns, but 1 in line 1"),
            ("*Vertices 2\n1 \"a b\"\n2 c\n*Arcs\n*Edges\n1 2 1.5\n", "pajek: a b c | a b-c"),
            (
                "*Vertices 3\n*Arcs\n1 2\n*Edges\n2 3\n",
                "pajek: 1 2 3 | 1>2 2>3 3>2; 1 link without a direction",
            ),
            ("3 2\n2\n1 3\n2\n", "metis: 1 2 3 | 1-2 2-3"),
            ("%c\n2 1 001\n2 5\n1 5\n", "metis: 1 2 | 1-2"),
            ("# a\nb\nc\n# b\nc\n", "lgl: a b c | a-b a-c b-c"),
            ("1 x\n2 y\n#\n1 2 likes\n", "tgf: x y | x-y"),
            ("LEDA.GRAPH\nvoid\nvoid\n-1\n2\n|{}|\n|{}|\n1\n1 2 0 |{}|\n", "leda: 1 2 | 1>2"),
            ("LEDA.GRAPH\nvoid\nvoid\n-1\n2\n|{}|\n|{}|\n2\n1 2 0 |{}|\n", "ends here, expected an edge"),
            (">>sparse6<<:DaW\n", "graph6: 0 1 2 3 4 | 0-1 0-3 1-2"),
            ("Bw\nBg\n", "2 graphs in the text, choose one: 1 to 2"),
            (
                "graph [ directed 1 node [ id 0 label \"a\" ] node [ id 1 label \"b\" ] edge [ source 0 target 1 ] ]",
                "gml: a b | a>b",
            ),
            ("graph { subgraph s { a; b } -- c; a -- {d e} }", "dot: a b c d e | a-c a-d a-e b-c"),
            ("digraph { a -> b [dir=both]; b -> c [dir=back] }", "dot: a b c | a>b b>a c>b"),
            ("graph { \"a\" + \"b\" -- c }", "dot: ab c | ab-c"),
            (
                "<gexf><graph defaultedgetype='directed'><nodes><node id='0'/><node id='1'/></nodes><edges><edge source='0' target='1' type='undirected'/></edges></graph></gexf>",
                "gexf: 0 1 | 0>1 1>0",
            ),
            ("<svg/>", "found \"svg\", expected graphml or gexf as the first element"),
            (
                "{\"directed\": true, \"nodes\": [{\"id\": 0}, {\"id\": 1}], \"adjacency\": [[{\"id\": 1}], []]}",
                "json: 0 1 | 0>1",
            ),
            (
                "{\"elements\": {\"nodes\": [{\"data\": {\"id\": \"0\"}}, {\"data\": {\"id\": \"1\"}}], \"edges\": [{\"data\": {\"source\": 0, \"target\": 1}}]}}",
                "json: 0 1 | 0-1",
            ),
            ("\u{feff}a b\r\nb c\r\n", "edges: a b c | a-b b-c"),
        ],
        &Options::default(),
    );
    check(
        &[("Bw\nBg\n", "graph6: 0 1 2 | 0-1 1-2; graph 2 of the 2 in the file")],
        &Options { which: Some(2), ..Options::default() },
    );
}

#[test]
fn what_no_format_is_sure_of_is_refused() {
    check(
        &[
            // A heading of networkx, and names with blanks: a star of the robot called robot it is not.
            ("# GMT Thu\nrobot 0\nrobot 1\n", "this does not look like an edge list, nor like anything else"),
            ("# GMT Thu\nrobot 0 1\nrobot 1 {}\nrobot 1 0\n", "found"),
            (
                "robot 0 2\nrobot 1 {}\nrobot 2 {}\n",
                "line 1: found \"2\", expected {…} behind the names, as in other lines",
            ),
        ],
        &Options::default(),
    );
    let adjlist = Options { ending: Some("adjlist"), ..Options::default() };
    check(&[("robot 0\trobot 1\nrobot 1\n", "this does not look like an adjacency list")], &adjlist);
}

#[test]
fn strict_refuses_what_is_told_twice() {
    let strict = Options { strict: true, ..Options::default() };
    check(
        &[
            ("10 20\n20 10\n", "line 2: edge from \"20\" to \"10\" appears twice"),
            ("a a\na b\n", "line 1: loop: \"a\" would hear itself"),
            ("strict graph { a -- b -- a }", "dot: a b | a-b"),
            ("2 1\n2\n1\n", "metis: 1 2 | 1-2"),
        ],
        &strict,
    );
}
