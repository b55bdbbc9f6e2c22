//! The formats and what they are called.

/// How a graph is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Format {
    /// Rows of 0 and 1: row u, column v is the edge u → v. A line `directed` may come first; names may stand at the head of
    /// columns and rows. The diagonal does not count.
    Matrix,
    /// One edge `u v` a line; `#` and `%` begin comments. Names are separated by blanks, tabs, commas or semicolons; an arrow
    /// may stand between them, and a number or `{…}` (a weight) after them. After a first line `directed` or `undirected`
    /// a line may also be a single node.
    EdgeList,
    /// An edge list after a line with the numbers of nodes and links.
    CountedEdges,
    /// Edges as Python prints them: `[(0, 1), (1, 2)]`.
    Tuples,
    /// A node and its neighbours a line, as `networkx.write_adjlist` has them.
    Adjacency,
    /// A node and its number of neighbours, then one of them a line: `networkx.write_multiline_adjlist`.
    MultilineAdjacency,
    /// METIS: a line of counts, then the neighbours of node 1, 2, … a line.
    Metis,
    /// Large Graph Layout: `# node`, then its neighbours, one a line.
    Lgl,
    /// Trivial Graph Format of yEd: nodes with labels, a line `#`, edges.
    Tgf,
    /// graph6 and sparse6 for undirected graphs, digraph6 for directed ones; one graph a line.
    Graph6,
    /// MatrixMarket, coordinates and arrays: row u, column v is the edge u → v.
    MatrixMarket,
    /// DIMACS and PACE: `p edge n m`, then `e u v`, `a u v` (directed) or `u v` a line.
    Dimacs,
    /// Pajek: `*Vertices`, `*Edges`, `*Arcs`, and the lists of both.
    Pajek,
    /// LEDA's native format.
    Leda,
    /// GML: `graph [ node [ id 0 ] edge [ source 0 target 1 ] ]`.
    Gml,
    /// GraphML: `graph`, `node` and `edge` elements; the rest is passed over.
    GraphMl,
    /// GEXF of Gephi.
    Gexf,
    /// DOT of Graphviz.
    Dot,
    /// JSON in networkx's node-link, adjacency or Cytoscape form; links may be listed under `edges` or `links`.
    Json,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 19] = [
        Self::Matrix,
        Self::EdgeList,
        Self::CountedEdges,
        Self::Tuples,
        Self::Adjacency,
        Self::MultilineAdjacency,
        Self::Metis,
        Self::Lgl,
        Self::Tgf,
        Self::Graph6,
        Self::MatrixMarket,
        Self::Dimacs,
        Self::Pajek,
        Self::Leda,
        Self::Gml,
        Self::GraphMl,
        Self::Gexf,
        Self::Dot,
        Self::Json,
    ];

    /// What users call it, in small letters.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.words()[0]
    }

    /// The format in a sentence, after "read as".
    #[must_use]
    pub fn title(self) -> &'static str {
        self.words()[1]
    }

    /// The format with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }

    /// Its name and its title.
    const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Matrix => ["matrix", "a matrix"],
            Self::EdgeList => ["edges", "an edge list"],
            Self::CountedEdges => ["counted-edges", "an edge list after a line of counts"],
            Self::Tuples => ["tuples", "tuples of Python"],
            Self::Adjacency => ["adjacency", "an adjacency list"],
            Self::MultilineAdjacency => ["multiline-adjacency", "an adjacency list of many lines"],
            Self::Metis => ["metis", "METIS"],
            Self::Lgl => ["lgl", "LGL"],
            Self::Tgf => ["tgf", "TGF"],
            Self::Graph6 => ["graph6", "graph6"],
            Self::MatrixMarket => ["matrix-market", "MatrixMarket"],
            Self::Dimacs => ["dimacs", "DIMACS"],
            Self::Pajek => ["pajek", "Pajek"],
            Self::Leda => ["leda", "LEDA"],
            Self::Gml => ["gml", "GML"],
            Self::GraphMl => ["graphml", "GraphML"],
            Self::Gexf => ["gexf", "GEXF"],
            Self::Dot => ["dot", "DOT"],
            Self::Json => ["json", "JSON"],
        }
    }
}
