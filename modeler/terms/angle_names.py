"""Names of sines and cosines: s23 of q2 + q3, c2m7 of q2 - q7."""

from collections.abc import Iterable, Mapping

from modeler.symbolic import Graph


def angle_names(
    graph: Graph, nodes: Iterable[int], letters: Mapping[str, str], taken: set[str]
) -> tuple[dict[int, str], dict[str, int]]:
    """Names of sines and cosines, and the angles that they belong to.

    Args:
        graph: of the nodes.
        nodes: of sines and cosines; those of constants keep their function.
        letters: how symbols are written.
        taken: names that are given away; those found are added.

    Returns:
        {node: name} and {label: reference of the angle}, the label being the name without s or c.
    """
    trig: dict[int, str] = {}
    labels: dict[int, str] = {}
    for node in nodes:
        found = graph.nodes[node]
        if found.static:
            continue
        angle = found.args[0]
        if angle not in labels:
            label = _label(graph, angle, letters)
            while {f"s{label}", f"c{label}"} & taken:
                label += "_"
            labels[angle] = label
            taken |= {f"s{label}", f"c{label}"}
        trig[node] = found.op[0] + labels[angle]
    order = sorted(labels, key=lambda ref: (len(labels[ref]), labels[ref]))
    return trig, {labels[ref]: ref for ref in order}


def _label(graph: Graph, angle: int, letters: Mapping[str, str]) -> str:
    parts = sorted(_summed(graph, angle, letters), key=lambda part: part[0] < 0)
    if all(sign > 0 and len(text) == 1 for sign, text in parts):
        return "".join(sorted(text for _, text in parts))
    return "".join(("m" if sign < 0 else "p") + text for sign, text in parts).removeprefix("p")


def _summed(graph: Graph, ref: int, letters: Mapping[str, str]) -> list[tuple[int, str]]:
    """The terms of an angle: (sign, letters)."""
    node, sign = graph.nodes[abs(ref)], 1 if ref > 0 else -1
    if node.op == "add":
        return [(sign * s, t) for arg in node.args for s, t in _summed(graph, arg, letters)]
    if node.op == "sym":
        return [(sign, letters.get(node.args[0], node.args[0]).removeprefix("q"))]
    if node.op == "mul" and graph.nodes[abs(node.args[0])].op == "num":
        number = str(graph.nodes[abs(node.args[0])].args[0]).replace("/", "by")
        return [(sign * s, f"{number}x{t}") for s, t in _summed(graph, node.args[1], letters)]
    return [(sign, f"n{abs(ref)}")]
