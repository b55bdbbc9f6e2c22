//! `closeranks graph MAKER`: graphs by name, on standard output.

use core::fmt::Write as _;
use core::num::NonZeroU8;

use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};
use closeranks_graph::formats::{self, Named};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{MakerError, delaunay, fixed, large, minimal, random, symmetric};
use closeranks_graph::network::Network;

use crate::check::Format;
use crate::{invocation, output};

/// Shown by `closeranks graph --help`.
pub(crate) const HELP: &str = "\
Examples, one for each maker; N is the number of nodes, at most 128, or four million for the last three:

    closeranks graph complete 7              all joined
    closeranks graph path 5                  in a row
    closeranks graph ring 8                  in a circle
    closeranks graph circulant 9 1 3         node i is heard by i + 1 and i + 3; --directed: one way only
    closeranks graph k-circulant 11 4        the same with steps 1 to 4
    closeranks graph wheel 9                 a hub and a ring
    closeranks graph star 6                  a hub and its ends
    closeranks graph bipartite 3 4           each of 3 with each of 4
    closeranks graph grid 3 4                rows and columns
    closeranks graph hypercube 4             2^4 nodes
    closeranks graph petersen                ten nodes, 3-connected, survives nobody
    closeranks graph elemental 2             (2F+1)-robust on 4F + 1 nodes, F = 2
    closeranks graph tight 10 2              two cliques with F = 2 links each across: one degree short
    closeranks graph erdos-renyi 12 0.5 --seed 3   every link with probability 0.5; --directed
    closeranks graph regular 12 5 --seed 3   all degrees 5
    closeranks graph geometric 20 0.4 --seed 3     points in a square, joined up to a distance of 0.4
    closeranks graph preferential 20 5 3 --seed 3  5 joined at first, each newcomer joins 3
    closeranks graph multipartite 5 6              5 parts of 6, all joined but within parts
    closeranks graph rook-complement 6 6           fields of a board that share neither row nor column
    closeranks graph kneser 9 2                    pairs of 9 points, joined if disjoint
    closeranks graph paley 41                      numbers below a prime 4k + 1, joined if they differ by a square
    closeranks graph merg 12                       the largest r that 12 nodes can have, on the fewest links
    closeranks graph merg-f 12                     the largest F that 12 nodes can have, on the fewest links
    closeranks graph ranked 100000 2 --seed 3      survives 2 liars around each node, as sparse as its order allows
    closeranks graph triangular 40 50              rows and columns of a lattice of triangles
    closeranks graph delaunay 1000 --seed 3        points in a square, each joined to those next to it in every direction

    closeranks graph tight 10 2 | closeranks check -
    closeranks graph petersen --format dot | dot -Tsvg > petersen.svg";

/// Which graph, and how to write it down.
#[derive(Args, Debug)]
pub(crate) struct Make {
    #[command(subcommand)]
    maker: Maker,
    /// How to write it down.
    #[arg(long, value_enum, default_value_t = Format::Edges, global = true)]
    format: Format,
    /// Seed of graphs by chance: one seed is one graph, on every machine.
    #[arg(long, default_value_t = 1, global = true, value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: u64,
}

#[derive(Debug, Subcommand)]
enum Maker {
    /// All nodes joined.
    Complete { nodes: NonZeroU8 },
    /// Nodes in a row.
    Path { nodes: NonZeroU8 },
    /// Nodes in a circle, 3 or more.
    Ring { nodes: NonZeroU8 },
    /// Node i is heard by i + step for each of the steps.
    Circulant {
        nodes: NonZeroU8,
        #[arg(required = true)]
        steps: Vec<NonZeroU8>,
        /// One way only: i + step hears i.
        #[arg(long)]
        directed: bool,
    },
    /// The circulant with steps 1 to REACH.
    KCirculant {
        nodes: NonZeroU8,
        reach: u8,
        /// One way only.
        #[arg(long)]
        directed: bool,
    },
    /// A hub joined to a ring, 4 nodes or more.
    Wheel { nodes: NonZeroU8 },
    /// A hub joined to all others.
    Star { nodes: NonZeroU8 },
    /// Each of LEFT joined to each of RIGHT.
    Bipartite { left: NonZeroU8, right: NonZeroU8 },
    /// Rows and columns.
    Grid { rows: NonZeroU8, columns: NonZeroU8 },
    /// Corners of a cube of DIMENSION 0 to 7.
    Hypercube { dimension: u8 },
    /// The Petersen graph.
    Petersen,
    /// (2F+1)-robust on 4F + 1 nodes.
    Elemental { f: u8 },
    /// Two complete graphs joined F times at every node: one degree short of surviving F liars.
    Tight { nodes: NonZeroU8, f: u8 },
    /// Every edge with PROBABILITY 0 to 1.
    ErdosRenyi {
        nodes: NonZeroU8,
        probability: f64,
        /// Each direction by itself.
        #[arg(long)]
        directed: bool,
    },
    /// All degrees DEGREE.
    Regular { nodes: NonZeroU8, degree: u8 },
    /// Points in the unit square, joined up to RADIUS.
    Geometric { nodes: NonZeroU8, radius: f64 },
    /// START joined at first, each newcomer joins LINKS, the likelier the higher their degree.
    Preferential { nodes: NonZeroU8, start: NonZeroU8, links: u8 },
    /// PARTS parts of SIZE nodes, all joined but those of one part.
    Multipartite { parts: NonZeroU8, size: NonZeroU8 },
    /// Fields of a board, joined if they share neither row nor column.
    RookComplement { rows: NonZeroU8, columns: NonZeroU8 },
    /// All sets of CHOSEN of POINTS points, joined if disjoint.
    Kneser { points: NonZeroU8, chosen: u8 },
    /// Numbers below a PRIME of the form 4k + 1, joined if they differ by a square.
    Paley { prime: NonZeroU8 },
    /// The largest r that NODES can have, on the fewest links.
    Merg { nodes: NonZeroU8 },
    /// The largest F that NODES can have, on the fewest links.
    MergF { nodes: NonZeroU8 },
    /// 2F + 1 joined, each newcomer joins 2F + 1 of those before it: of any size.
    Ranked { nodes: u32, f: u16 },
    /// A lattice of triangles, of any size.
    Triangular { rows: u32, columns: u32 },
    /// The Delaunay triangulation of points in a square, of any size.
    Delaunay { nodes: u32 },
}

/// Writes the graph to standard output.
pub(crate) fn make(arguments: &Make) -> Result<bool> {
    if let Some(network) = arguments.maker.network(arguments.seed) {
        return say_network(&network.context("no such graph")?, arguments.format);
    }
    let graph = arguments.maker.graph(arguments.seed).context("no such graph")?;
    output::say(&formats::write(&Named::from(graph), arguments.format.of_library())?);
    Ok(true)
}

/// Writes a network, as links a line if it is large.
fn say_network(network: &Network, format: Format) -> Result<bool> {
    if let Ok(graph) = network.graph() {
        output::say(&formats::write(&Named::from(graph), format.of_library())?);
        return Ok(true);
    }
    if format != Format::Edges {
        bail!(
            "--format is for graphs of up to 128 nodes, and this has {}; allowed is edges",
            network.node_count()
        );
    }
    let lines = network.edges().fold(String::new(), |mut text, (from, to)| {
        let _ = writeln!(text, "{from} {to}");
        text
    });
    output::say(&lines);
    Ok(true)
}

impl Maker {
    /// The network of a maker that has no limit.
    fn network(&self, seed: u64) -> Option<Result<Network, MakerError>> {
        match self {
            Self::Ranked { nodes, f } => Some(large::ranked(*nodes as usize, usize::from(*f), seed)),
            Self::Triangular { rows, columns } => Some(large::triangular(*rows as usize, *columns as usize)),
            Self::Delaunay { nodes } => Some(delaunay::delaunay(*nodes as usize, seed)),
            _ => None,
        }
    }

    fn graph(&self, seed: u64) -> Result<Graph, MakerError> {
        let at = |number: &NonZeroU8| usize::from(number.get());
        match self {
            Self::Complete { nodes } => fixed::complete(at(nodes)),
            Self::Path { nodes } => fixed::path(at(nodes)),
            Self::Ring { nodes } => fixed::ring(at(nodes)),
            Self::Circulant { nodes, steps, directed } => {
                fixed::circulant(at(nodes), &steps.iter().map(at).collect::<Vec<usize>>(), *directed)
            }
            Self::KCirculant { nodes, reach, directed } => {
                fixed::k_circulant(at(nodes), usize::from(*reach), *directed)
            }
            Self::Wheel { nodes } => fixed::wheel(at(nodes)),
            Self::Star { nodes } => fixed::star(at(nodes)),
            Self::Bipartite { left, right } => fixed::bipartite(at(left), at(right)),
            Self::Grid { rows, columns } => fixed::grid(at(rows), at(columns)),
            Self::Hypercube { dimension } => fixed::hypercube(usize::from(*dimension)),
            Self::Petersen => fixed::petersen(),
            Self::Elemental { f } => fixed::elemental(usize::from(*f)),
            Self::Tight { nodes, f } => fixed::tight(at(nodes), usize::from(*f)),
            Self::ErdosRenyi { nodes, probability, directed } => {
                random::erdos_renyi(at(nodes), *probability, *directed, seed)
            }
            Self::Regular { nodes, degree } => random::regular(at(nodes), usize::from(*degree), seed),
            Self::Geometric { nodes, radius } => random::random_geometric(at(nodes), *radius, seed),
            Self::Preferential { nodes, start, links } => {
                random::preferential_attachment(at(nodes), at(start), usize::from(*links), seed)
            }
            Self::Multipartite { parts, size } => symmetric::multipartite(at(parts), at(size)),
            Self::RookComplement { rows, columns } => symmetric::rook_complement(at(rows), at(columns)),
            Self::Kneser { points, chosen } => symmetric::kneser(at(points), usize::from(*chosen)),
            Self::Paley { prime } => symmetric::paley(at(prime)),
            Self::Merg { nodes } => minimal::merg(at(nodes)),
            Self::MergF { nodes } => minimal::merg_f(at(nodes)),
            Self::Ranked { .. } | Self::Triangular { .. } | Self::Delaunay { .. } => {
                let network = self.network(seed).transpose()?;
                network.map_or(Graph::empty(0, false), |network| network.graph()).map_err(MakerError::from)
            }
        }
    }
}
