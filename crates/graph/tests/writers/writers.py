"""Random graphs through every writer of networkx and igraph, and back through closeranks.

A file is read as the graph that was written, or refused; never as another one. What a writer leaves out (direction, nodes
without links, names) is known for each writer, and so is whether its files can be read at all.
"""

import collections
import contextlib
import io
import json
import pathlib
import random
import subprocess
import sys
import warnings

import igraph
import networkx as nx
import numpy
import scipy.io

warnings.filterwarnings("ignore")


class Written:
    """A file and the graph that it should be read as."""

    def __init__(self, writer, path, graph, words="", lonely=True, names=None, directed=None, refused=False, edges=None):
        """lonely: nodes without links are in the file. names: node -> name in the file. refused: no reader for it."""
        self.writer, self.path, self.words, self.refused = writer, path, words, refused
        names = names or str
        self.directed = graph.is_directed() if directed is None else directed
        pairs = edges if edges is not None else [(u, v) for u, v in graph.edges() if u != v]
        ends = ((names(u), names(v)) for u, v in pairs)
        self.edges = {pair if self.directed else tuple(sorted(pair)) for pair in ends}
        touched = {end for edge in graph.edges() for end in edge}
        self.nodes = {names(node) for node in graph if lonely or node in touched}

    def is_read_as(self, answer):
        edges = {tuple(edge) if answer["directed"] else tuple(sorted(edge)) for edge in answer["edges"]}
        same_nodes = set(answer["nodes"]) == self.nodes
        return same_nodes and edges == self.edges and answer["directed"] == self.directed


def graphs(count, seed):
    """Graphs of 2 to 12 nodes: directed or not, with parallel links and loops or not, names of several kinds."""
    draw = random.Random(seed)
    for number in range(count):
        kind = [nx.Graph, nx.DiGraph, nx.MultiGraph, nx.MultiDiGraph][number % 4]
        nodes = draw.randint(2, 12)
        probability = draw.choice([0.1, 0.3, 0.6, 1.0])
        names = draw.choice(["zero", "one", "words", "blanks", "gaps"])
        graph = kind()
        label = {
            "zero": lambda i: i,
            "one": lambda i: i + 1,
            "words": lambda i: f"robot_{i}",
            "blanks": lambda i: f"robot {i}",
            "gaps": lambda i: 7 * i + 3,
        }[names]
        graph.add_nodes_from(label(i) for i in range(nodes))
        weighted = draw.random() < 0.3
        for u in list(graph):
            for v in list(graph):
                again = 1 + (graph.is_multigraph() and draw.random() < 0.2)
                if (u != v or draw.random() < 0.1) and draw.random() < probability:
                    for _ in range(again):
                        weight = {"weight": round(draw.uniform(0.1, 9), 2)} if weighted else {}
                        graph.add_edge(u, v, **weight)
        yield graph


# What each writer of networkx leaves out. Those that no reader of ours knows are "refused".
NETWORKX = {
    "write_adjlist": {"open": True},
    "write_edgelist": {"open": True, "lonely": False},
    "write_weighted_edgelist": {"open": True, "lonely": False},
    "write_multiline_adjlist": {"open": True},
    "write_gexf": {"ending": "gexf"},
    "write_gml": {"ending": "gml"},
    "write_graph6": {"index": 0},
    "write_sparse6": {"index": 0, "order": sorted},
    "write_graphml": {"ending": "graphml"},
    "write_graphml_lxml": {"ending": "graphml"},
    "write_graphml_xml": {"ending": "graphml"},
    "write_pajek": {"ending": "net"},
    "write_latex": {"refused": True},
    "write_network_text": {"refused": True},
}

IGRAPH = {
    "write_adjacency": {"index": 0, "open": True},
    "write_dimacs": {"index": 1, "directed": True},
    "write_dot": {"index": 0},
    "write_edgelist": {"index": 0, "open": True, "lonely": False},
    "write_gml": {"index": 0},
    "write_graphml": {"prefix": "n", "index": 0},
    "write_leda": {},
    "write_lgl": {"directed": False},
    "write_ncol": {"open": True, "lonely": False},
    "write_pajek": {},
    "write_graphmlz": {"refused": True},
    "write_pickle": {"refused": True},
    "write_picklez": {"refused": True},
    "write_svg": {"refused": True},
}


def numbered(nodes, first, prefix=""):
    place = {node: f"{prefix}{first + number}" for number, node in enumerate(nodes)}
    return lambda node: place[node]


def networkx_files(graph, stem):
    for name, facts in NETWORKX.items():
        path = stem.with_name(f"{stem.name}-{name}.{facts.get('ending', 'txt')}")
        try:
            getattr(nx, name)(graph, path if name != "write_network_text" else str(path))
        except (nx.NetworkXError, nx.NetworkXNotImplemented):
            continue
        words = "directed" if facts.get("open") and graph.is_directed() else ""
        names = numbered(facts.get("order", list)(graph), 0) if "index" in facts else None
        yield Written(name, path, graph, words, facts.get("lonely", True), names, refused=facts.get("refused", False))
    yield from networkx_texts(graph, stem)


def networkx_texts(graph, stem):
    """What people do with networkx and its neighbours beside its writers."""
    words = "directed" if graph.is_directed() else ""
    index = numbered(graph, 0)

    def text(writer, content, ending="txt", words="", **facts):
        path = stem.with_name(f"{stem.name}-{writer}.{ending}")
        path.write_text(content)
        return Written(writer, path, graph, words, **facts)

    for writer, form in [("node_link", nx.node_link_data), ("adjacency", nx.adjacency_data), ("cytoscape", nx.cytoscape_data)]:
        yield text(writer, json.dumps(form(graph)), "json")
    yield text("node_link_links", json.dumps(nx.node_link_data(graph, edges="links")), "json")
    yield text("print_edges", str(list(graph.edges())), words=words, lonely=False)
    yield text("print_data", "\n".join(map(str, graph.edges(data=True))), words=words, lonely=False)
    for writer, sign in [("comma", ","), ("tab", "\t"), ("semicolon", ";")]:
        buffer = io.BytesIO()
        nx.write_edgelist(graph, buffer, delimiter=sign, data=False)
        yield text(f"edgelist_{writer}", buffer.getvalue().decode(), words=words, lonely=False)
        buffer = io.BytesIO()
        nx.write_adjlist(graph, buffer, delimiter=sign)
        yield text(f"adjlist_{writer}", buffer.getvalue().decode(), "adjlist", words=words)
    yield text("pydot", nx.nx_pydot.to_pydot(graph).to_string(), "dot")
    matrix = nx.to_numpy_array(graph)
    for writer, square, more in [("savetxt", matrix, " weights"), ("savetxt_bits", (matrix != 0).astype(int), "")]:
        buffer = io.StringIO()
        numpy.savetxt(buffer, square, fmt="%g" if more == "" else "%.6e")
        yield text(writer, buffer.getvalue(), words=words + more, names=index)
    frame = nx.to_pandas_adjacency(graph)
    yield text("pandas_adjacency", frame.to_csv(), "csv", words=words + " weights")
    yield text("pandas_bools", (frame != 0).to_csv(sep=";"), "csv", words=words)
    if graph.edges:
        yield text("pandas_edges", nx.to_pandas_edgelist(graph).to_csv(), "csv", words=words, lonely=False)
    path = stem.with_name(f"{stem.name}-mmwrite.mtx")
    scipy.io.mmwrite(path, nx.to_scipy_sparse_array(graph))
    yield Written("mmwrite", path, graph, words, names=index)


def igraph_files(graph, stem):
    place = {node: number for number, node in enumerate(graph)}
    other = igraph.Graph(len(place), [(place[u], place[v]) for u, v in graph.edges()], directed=graph.is_directed())
    other.vs["name"] = [str(node) for node in graph]
    for name, facts in IGRAPH.items():
        path = stem.with_name(f"{stem.name}-ig-{name}.txt")
        if name == "write_adjacency" and len(place) <= 3 and graph.is_multigraph():
            continue  # Two rows of counts, such as `0 2` and `1 0`, are edges to anybody, and three rows with weights.
        with contextlib.suppress(igraph.InternalError):
            write = getattr(other, name)
            write(str(path), 0, len(place) - 1) if name == "write_dimacs" else write(str(path))
            words = "directed" if facts.get("open") and graph.is_directed() else ""
            names = numbered(graph, facts["index"], facts.get("prefix", "")) if "index" in facts else None
            directed = facts.get("directed")
            own = list(graph)
            # The format has directed edges only, so those of an undirected graph are read as igraph has them.
            edges = [(own[a], own[b]) for a, b in other.get_edgelist() if a != b] if directed else None
            lonely, refused = facts.get("lonely", True), facts.get("refused", False)
            yield Written(f"igraph {name}", path, graph, words, lonely, names, directed, refused, edges)


def check_tables():
    """A new version of a library may have a writer that nobody has looked at."""
    known = {name for name in dir(nx) if name.startswith("write_")}
    assert known == set(NETWORKX), known ^ set(NETWORKX)
    known = {name for name in dir(igraph.Graph) if name.startswith("write_")}
    assert known == set(IGRAPH), known ^ set(IGRAPH)


def main():
    reader, folder, count, seed = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    check_tables()
    files = []
    for number, graph in enumerate(graphs(count, seed)):
        stem = folder / f"{number:04}"
        files += [*networkx_files(graph, stem), *igraph_files(graph, stem)]
    asked = "".join(f"{file.path}\t{file.words}\n" for file in files)
    answers = subprocess.run([reader], input=asked, capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(answers) == len(files)
    sys.exit(judge(files, [json.loads(answer) for answer in answers]))


def judge(files, answers):
    """Prints what was read of every writer; 1 if a file was misread, or if nothing of a known format was read."""
    right, refused, reasons, wrong = collections.Counter(), collections.Counter(), {}, []
    for file, answer in zip(files, answers):
        if "error" in answer:
            refused[file.writer] += 1
            reasons.setdefault(file.writer, collections.Counter())[answer["error"].split(": ", 1)[-1][:100]] += 1
        elif file.is_read_as(answer):
            right[file.writer] += 1
        else:
            wrong.append((file, answer))
    for writer in dict.fromkeys(file.writer for file in files):
        print(f"{writer:32} read {right[writer]:4}  refused {refused[writer]:4}")
        for reason, times in reasons.get(writer, collections.Counter()).most_common(3):
            print(f"{'':34}{times:4} x {reason}")
    for file, answer in wrong[:5]:
        print(f"\nMISREAD {file.writer}: {file.path}\n{file.path.read_text()[:600]}\n{answer}")
        print(f"expected directed={file.directed} {sorted(file.nodes)} {sorted(file.edges)}")
    unread = {file.writer for file in files if not file.refused and right[file.writer] == 0}
    never = {file.writer for file in files if file.refused and right[file.writer] > 0}
    print(f"\n{len(files)} files: {sum(right.values())} read, {sum(refused.values())} refused, {len(wrong)} misread")
    for what, writers in [("never read", unread), ("read, but said to be refused", never)]:
        if writers:
            print(f"{what}: {', '.join(sorted(writers))}")
    return 1 if wrong or unread or never else 0


main()
