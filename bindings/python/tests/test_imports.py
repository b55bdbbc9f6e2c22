"""Modules do not import each other in a circle. What stands under `TYPE_CHECKING` is for annotations and is never imported."""

from __future__ import annotations

import ast
import graphlib
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "python/closeranks"


def module(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


class Imports(ast.NodeVisitor):
    """Which of `known` a module imports, at its head or within its functions."""

    def __init__(self, known: set[str]) -> None:
        self.known, self.found = known, set[str]()

    def visit_If(self, node: ast.If) -> None:
        if not (isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"):
            self.generic_visit(node)

    def visit_Import(self, node: ast.Import) -> None:
        self.found |= {name.name for name in node.names} & self.known

    def visit_ImportFrom(self, node: ast.ImportFrom) -> None:
        assert node.level == 0, "imports are written in full"
        inner = {f"{node.module}.{name.name}" for name in node.names} & self.known
        self.found |= inner or ({str(node.module)} & self.known)


def imports() -> dict[str, set[str]]:
    texts = {module(path): path.read_text() for path in PACKAGE.rglob("*.py")}
    graph = {}
    for name, text in texts.items():
        visitor = Imports(set(texts))
        visitor.visit(ast.parse(text))
        # What a module needs of its own package is there before it, and native code is no module of ours.
        graph[name] = visitor.found - {"closeranks"}
    return graph


def test_no_circles() -> None:
    graph = imports()
    assert "closeranks._run" in graph["closeranks._world"], "imports are found at all"
    assert list(graphlib.TopologicalSorter(graph).static_order())
