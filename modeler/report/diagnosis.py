"""The page of a diagnosis: one HTML file, no network."""

from collections.abc import Sequence

from modeler.core.table import percent, printed
from modeler.diagnosis import Diagnosis, Finding, Step, blind_spots, tie_names, tied, unit, where
from modeler.effects import effect_named
from modeler.report.blocks import Block, Code, Figure, Items, PageCell, PageTable, Paragraph
from modeler.report.effect_evidence import evidence_of, figures
from modeler.report.evidence import evidence_picture, rivals_of, rivals_table
from modeler.report.page import Origin, Page, Section
from modeler.report.torque_picture import play_picture, push_picture, torque_picture


def diagnosis_page(
    diagnosis: Diagnosis, provenance: Sequence[str] = (), origin: Origin | None = None
) -> Page:
    """The page of a diagnosis.

    Args:
        diagnosis: what it shows.
        provenance: lines on how the data came about.
        origin: model, logs, and whether some were held out; what the diagnosis knows of them if it
            is left out.
    """
    return Page(
        title=f"{diagnosis.robot}: which effect is missing",
        headline=_headline(diagnosis),
        sections=_sections(diagnosis),
        origin=origin or Origin(diagnosis.robot, diagnosis.held_out, bool(diagnosis.held_out)),
        facts=_facts(diagnosis),
        provenance=[*diagnosis.sentences, *provenance],
        command="diagnose",
    )


def _headline(diagnosis: Diagnosis) -> tuple[str, str]:
    """The size of the prize, and what wins it."""
    if not diagnosis.effects:
        verdict, _, reason = diagnosis.sentences[0].partition(": ")
        return verdict, reason
    first = diagnosis.effects[0]
    effect = effect_named(first.effect, diagnosis.search.start.data.known.catalogue)
    assert effect is not None
    size = " \u2192 ".join(printed(first.error_before, first.error_after))
    return size, f"{diagnosis.verdict}: {effect.title}, {where(first.joint)}{tied(first)}"


def _facts(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    facts = []
    if diagnosis.effects:
        first = diagnosis.effects[0]
        facts.append(("What the data do not tell apart", tie_names(first) or _runner_up(diagnosis)))
    left = [
        f"joint {name}: {percent(j.systematic / (j.systematic + j.noise))} systematic"
        for name, j in diagnosis.joints.items()
        if j.unexplained
    ]
    facts.append(("What is still systematic", ", ".join(left) or "nothing worth a word"))
    if diagnosis.data:
        facts.append(("Doubts about the logs", "; ".join(diagnosis.data)))
    held = ", ".join(diagnosis.held_out) or "none: errors are cross-validated within the logs"
    facts.append(("Held-out motion", held))
    return facts


def _runner_up(diagnosis: Diagnosis) -> str:
    """Of the same joint: an effect on another one is no rival."""
    first = diagnosis.effects[0]
    rivals = [gain_of for gain_of in diagnosis.rivals if gain_of[1] == first.joint]
    if not rivals:
        return "nothing"
    effect, joint, gain = rivals[0]
    share = percent(max(0.0, gain))
    return f"nothing; the runner-up is {effect} on {where(joint)}, {share} within these logs"


def by_error(diagnosis: Diagnosis) -> list[Finding]:
    """All that was found, refinements too, the largest error before first."""
    found = [*diagnosis.effects, *diagnosis.refinements]
    return sorted(found, key=lambda finding: -finding.error_before)


def _sections(diagnosis: Diagnosis) -> list[Section]:
    found = [Section("Effects", _table(diagnosis)), Section("Joints", [_joints(diagnosis)])]
    order = [(finding.effect, finding.joint) for finding in by_error(diagnosis)]
    steps = sorted(
        diagnosis.search.steps,
        key=lambda step: order.index(step.pick.key) if step.pick.key in order else len(order),
    )
    ids: list[str] = []
    for step in steps:
        own = _id(*step.pick.key)
        ids.append(own)  # two ripples of a joint differ by their orders only
        again = ids.count(own)
        found.append(_shown(diagnosis, step, own if again == 1 else f"{own}-{again}"))
    found += [*_events(diagnosis), *_proposed(diagnosis)]
    blind = [(f"{what}:", why) for what, why in blind_spots(diagnosis)]
    nothing = Paragraph("Nothing of the catalogue.")
    found.append(Section("What these logs cannot show", [Items(blind) if blind else nothing]))
    return found


def _shown(diagnosis: Diagnosis, step: Step, own: str) -> Section:
    """One effect: what it explains, before and after, and what else could stand for it."""
    item = evidence_of(diagnosis.search, step)
    effect, joint = step.pick.effect.id, step.pick.joint
    alone = Paragraph(f"No other effect of the catalogue explains anything of {where(joint)}.")
    return Section(_name(effect, joint), [
        Paragraph(figures(item)), Figure(torque_picture(item)), Figure(evidence_picture(item)),
        rivals_table(step) if rivals_of(step) else alone,
    ], own)  # fmt: skip


def _id(effect: str, joint: str | None) -> str:
    return f"effect-{effect}-{joint or 'robot'}"


def _events(diagnosis: Diagnosis) -> list[Section]:
    """Play and pushes, which are no columns."""
    end = diagnosis.search.end
    names = [joint.name for joint in end.data.compiled.spec.joints]
    found = []
    for finding in diagnosis.effects:
        if finding.pick is None and finding.joint is not None:
            picture = play_picture(end, names.index(finding.joint))
            found.append(Section(_name(finding.effect, finding.joint), [Figure(picture)]))
    if diagnosis.window is not None:
        picture = push_picture(end, diagnosis.window)
        found += [Section(f.effect, [Figure(picture)]) for f in diagnosis.effects if f.event]
    return found


def _proposed(diagnosis: Diagnosis) -> list[Section]:
    """Equations for what has no name."""
    found = []
    for own in diagnosis.discoveries or ():
        name = f"Equations proposed, {where(own.joint)}"
        if not own.proposals:
            found.append(Section(name, [Paragraph(f"{own.why}.")]))
        for proposal in own.proposals:
            item = evidence_of(proposal.drawn, proposal.drawn.steps[-1])
            found.append(Section(f"{proposal.equation}, {where(own.joint)}", [
                *(Paragraph(line) for line in proposal.told), Code(proposal.text),
                Figure(torque_picture(item)), Figure(evidence_picture(item)),
            ], _id(proposal.finding.effect, own.joint)))  # fmt: skip
    return found


def _name(effect: str, joint: str | None) -> str:
    return f"{effect}, {where(joint)}"


def _table(diagnosis: Diagnosis) -> list[Block]:
    findings = by_error(diagnosis)
    if not findings:
        return [Paragraph(diagnosis.sentences[0])]
    head = ("effect", "joint", "values", "error before", "error after", "gain", "why")
    kinds = {"joint": "text", "values": "values", "gain": "bar", "why": "why"}
    drawn = {step.pick.key for step in diagnosis.search.steps}
    rows = [_row(finding, (finding.effect, finding.joint) in drawn) for finding in findings]
    return [PageTable(head, rows, _ERRORS, kinds)]


_ERRORS = (
    "The largest error first. Errors are those of the joint that is named, in parts of its own rms "
    "torque or force; of an effect that several joints feel, of all of them, each in units of what "
    "is left of it, so that N m and N are never added. Before and after: without the effect and "
    "with it, all others that were named before it in the model. Gain: share of the residual's "
    "variance that is gone."
)


def _row(finding: Finding, drawn: bool) -> list[str | PageCell]:
    values = "; ".join(
        f"{name} = {value:.4g}"
        + (f" \u00b1 {finding.sigmas[name]:.2g}" if name in finding.sigmas else "")
        + unit(finding, name)
        for name, value in finding.parameters.items()
    )
    status = "refinement" if finding.refines else finding.status
    return [
        PageCell(
            f"{finding.effect} ({status})", link=_id(finding.effect, finding.joint) if drawn else ""
        ),
        finding.joint or "all",
        values,
        *printed(finding.error_before, finding.error_after),
        PageCell(percent(finding.gain), max(0.0, finding.gain)),
        "; ".join(text for text in (finding.evidence, finding.doubt) if text),
    ]


def _joints(diagnosis: Diagnosis) -> PageTable:
    """Share of each joint's torque: explained, systematic, noise."""
    rows = [
        [
            name,
            *printed(j.error_before, j.error_after),
            *(percent(share, 5) for share in (j.explained, j.systematic, j.noise)),
        ]
        for name, j in diagnosis.joints.items()
    ]
    return PageTable(
        ("joint", "error", "with the effects", "explained", "systematic, unexplained", "noise"),
        rows,
        "Errors of each joint in parts of its own rms torque or force. Shares of its variance with "
        "the effects in. Systematic is what smooth functions "
        "of the motion predict, what returns in the next lap, what lasts, and outbursts.",
    )
