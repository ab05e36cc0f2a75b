"""All base parameters as people and programs read them: text, LaTeX, Markdown, JSON."""

import textwrap
from typing import Any

from modeler.base.relation_text import coefficient_text, relation_latex, relation_text
from modeler.base.result import (
    BallRank,
    BaseParameters,
    Certificate,
    ExactState,
    ModularRank,
    Proof,
    SampledRank,
    Sampling,
)
from modeler.core.latex_lines import Equation, display

_WIDTH = 96


def as_text(base: BaseParameters) -> str:
    """All relations, one line each, then the parameters without effect."""
    lines = [relation_text(parameter) for parameter in base.parameters]
    return "\n".join([*lines, "", f"no effect: {' '.join(base.unidentifiable) or 'none'}"])


def as_markdown(base: BaseParameters) -> str:
    """A table of the relations, for a page."""
    lines = ["| base parameter | is | unit |", "| --- | --- | --- |"]
    for parameter in base.parameters:
        right = relation_text(parameter).split(" = ", 1)[1]
        lines.append(f"| {parameter.name} | `{right}` | {base.columns[parameter.column].unit} |")
    lines += ["", f"Without effect: {', '.join(base.unidentifiable) or 'none'}."]
    return "\n".join(lines)


def as_latex(base: BaseParameters) -> str:
    """The relations as an align environment, in lines that fit the page."""
    sides = [relation_latex(p).split(" = ", 1) for p in base.parameters]
    return display([Equation(left, (right,)) for left, right in sides], numbered=True)


def as_json(robot: str, base: BaseParameters) -> dict[str, Any]:
    """What `modeler derive --json` writes (contract section 5)."""
    return {
        "robot": robot,
        "standard": [column.name for column in base.columns],
        "base": [
            {
                "name": parameter.name,
                "column_of": base.columns[parameter.column].name,
                "unit": base.columns[parameter.column].unit,
                "terms": [
                    {
                        "coefficient": coefficient_text(term.coefficient),
                        "parameter": term.parameter,
                    }
                    for term in parameter.terms
                ],
            }
            for parameter in base.parameters
        ],
        "unidentifiable": list(base.unidentifiable),
        "rank": base.rank,
        "counts": dict(base.counts()),
        "rank_gap": [value or None for value in base.proof.gap],  # 0: there is none
        "proof": base.proof.kind,
        "certificate": _certificate(base.proof),
    }


def _certificate(proof: Proof) -> dict[str, Any]:
    found = proof.certificate
    modular = found if isinstance(found, ModularRank) else None
    return {
        "statement": proof.statement,
        "prime": modular and modular.prime,
        "points": modular and modular.points,
        "seed": proof.seed,
        "exact_rank": None if isinstance(found, SampledRank) else found.rank,
        "independence": _independence(found),
        "numeric_rank": proof.numeric_rank,
        "tolerance": proof.tolerance,
        "scale": proof.scale,
        "base_against_standard_torque": proof.agreement,
        "sampling": None if proof.sampling is None else _sampling(proof.sampling),
    }


def _independence(found: Certificate) -> dict[str, Any]:
    told: dict[str, Any] = {"rank": found.rank, "seed": found.seed}
    if isinstance(found, ModularRank):
        return {"kind": "modular", **told, "prime": found.prime, "points": found.points}
    if isinstance(found, SampledRank):
        return {"kind": "sampled", **told, "why": found.why}
    states = [_state(state) for state in found.states]
    rows = [list(row) for row in found.rows]
    return {"kind": "balls", **told, "bits": found.bits, "states": states, "rows": rows}


def _state(state: ExactState) -> dict[str, Any]:
    return {
        "positions": dict(state.positions),
        "speeds": dict(state.speeds),
        "accelerations": dict(state.accelerations),
        "signals": list(state.signals),
    }


def _sampling(sampling: Sampling) -> dict[str, Any]:
    return {
        "postures": sampling.postures,
        "ranges": {name: list(ends) for name, ends in sampling.ranges.items()},
        "distance_to_singularity": sampling.distance,
    }


def proof_text(proof: Proof) -> str:
    """The proof in a few lines."""
    return "\n".join(textwrap.fill(text, _WIDTH) for text in proof_paragraphs(proof))


def proof_paragraphs(proof: Proof) -> list[str]:
    """The proof, a paragraph for each of its parts."""
    return [
        f"proof: {proof.kind}. {proof.statement}",
        _independence_text(proof.certificate),
        f"rank {proof.numeric_rank} in floating point at the nominal geometry: singular values "
        f"{proof.gap[0]:.3g} (last kept) and {proof.gap[1]:.1e} (first dropped), tolerance "
        f"{proof.tolerance:g} of the largest; {proof.scale}",
        *([] if proof.sampling is None else [_sampling_text(proof.sampling, proof.seed)]),
        f"base torque against standard torque: {proof.agreement:.1e} of the largest",
    ]


def _independence_text(found: Certificate) -> str:
    if isinstance(found, ModularRank):
        return (
            f"rank {found.rank} modulo {found.prime} ({found.points} random points, seed "
            f"{found.seed})"
        )
    if isinstance(found, BallRank):
        return (
            f"rank {found.rank} in balls of {found.bits} bits (a minor of {found.rank} rows at "
            f"{len(found.states)} exact states, seed {found.seed}; --json lists them)"
        )
    return f"rank {found.rank} in floating point only (seed {found.seed}): {found.why}"


def _sampling_text(sampling: Sampling, seed: int) -> str:
    ranges = ", ".join(f"q{n} {low:.3g}..{high:.3g}" for n, (low, high) in sampling.ranges.items())
    return (
        f"at {sampling.postures} closed postures on walks from [home] (seed {seed}): {ranges}; "
        f"distance to the nearest singularity {sampling.distance:.2g} (least singular value of the "
        "loops' Jacobian by the passive joints, rows of usual length 1)"
    )
