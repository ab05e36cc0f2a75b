"""The page of a diagnosis: one HTML file, no network."""

import html
from collections.abc import Sequence
from pathlib import Path

from modeler.compare.report import figure_html
from modeler.core.files import write_atomically
from modeler.diagnose import Diagnosis, Finding
from modeler.diagnose.sentences import blind_spots, percent, unit, where
from modeler.effects import effect_named
from modeler.pages.event_pictures import play_picture, push_picture
from modeler.pages.evidence import evidence_picture, rivals_picture
from modeler.pages.sheet import page, section
from modeler.pages.shown import figures, shown


def write_diagnosis(path: Path, diagnosis: Diagnosis, provenance: Sequence[str] = ()) -> Path:
    """Write the page of a diagnosis; the path of the file written.

    Args:
        path: of an .html file.
        diagnosis: what it shows.
        provenance: lines on how the data came about.

    Raises:
        ModelerError: the place cannot be written.
    """
    text = page(
        title=f"{diagnosis.robot}: which effect is missing",
        headline=_headline(diagnosis),
        facts=_facts(diagnosis),
        sections="\n".join(_sections(diagnosis)),
        provenance=[*diagnosis.sentences, *provenance],
    )
    write_atomically(Path(path), text)
    return Path(path)


def _headline(diagnosis: Diagnosis) -> tuple[str, str]:
    """The size of the prize, and what wins it."""
    if not diagnosis.effects:
        verdict, _, reason = diagnosis.sentences[0].partition(": ")
        return verdict, reason
    first = diagnosis.effects[0]
    effect = effect_named(first.effect, diagnosis.search.start.data.known.catalogue)
    assert effect is not None
    size = f"{percent(first.error_before)} \u2192 {percent(first.error_after)}"
    if first.closure is None:  # no column, so that the error stays
        size = percent(first.error_before)
    return size, f"{diagnosis.verdict}: {effect.title}, {where(first.joint)}"


def _facts(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    facts = []
    if diagnosis.effects:
        first = diagnosis.effects[0]
        ties = ", ".join(f"{effect} on {where(joint)}" for effect, joint in first.ties)
        facts.append(("What the data do not tell apart", ties or _runner_up(diagnosis)))
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
    if not diagnosis.rivals:
        return "nothing"
    effect, joint, gain = diagnosis.rivals[0]
    share = percent(max(0.0, gain))
    return f"nothing; the runner-up is {effect} on {where(joint)}, {share} within these logs"


def _sections(diagnosis: Diagnosis) -> list[str]:
    found = [section("Effects", _table(diagnosis)), section("Joints", _joints(diagnosis))]
    for step in diagnosis.search.steps:
        item = shown(diagnosis.search, step)
        pictures = f'<p class="lead">{html.escape(figures(item))}</p>\n'
        pictures += figure_html(evidence_picture(item))
        if step is diagnosis.search.steps[0]:
            pictures += figure_html(rivals_picture(step))
        found.append(section(_name(step.pick.effect.id, step.pick.joint), pictures))
    found += _events(diagnosis)
    found.append(section("What these logs cannot show", _blind(diagnosis)))
    return found


def _events(diagnosis: Diagnosis) -> list[str]:
    """Play and pushes, which are no columns."""
    end = diagnosis.search.end
    names = [joint.name for joint in end.data.compiled.spec.joints]
    found = []
    for finding in diagnosis.effects:
        if finding.pick is None and finding.joint is not None:
            picture = play_picture(end, names.index(finding.joint))
            found.append(section(_name(finding.effect, finding.joint), figure_html(picture)))
    if diagnosis.window is not None:
        picture = push_picture(end, diagnosis.window)
        found += [section(f.effect, figure_html(picture)) for f in diagnosis.effects if f.event]
    return found


def _name(effect: str, joint: str | None) -> str:
    return f"{effect}, {where(joint)}"


def _table(diagnosis: Diagnosis) -> str:
    findings = [*diagnosis.effects, *diagnosis.refinements]
    if not findings:
        return f"<p>{html.escape(diagnosis.sentences[0])}</p>"
    head = (
        '<tr><th class="text">effect</th><th class="text">joint</th><th class="text">values</th>'
        '<th>error before</th><th>error after</th><th class="text">gain</th>'
        '<th class="text">why</th></tr>'
    )
    return f"<table>{head}{''.join(_row(f) for f in findings)}</table>"


def _row(finding: Finding) -> str:
    values = "; ".join(
        f"{name} = {value:.4g}"
        + (f" \u00b1 {finding.sigmas[name]:.2g}" if name in finding.sigmas else "")
        + unit(finding, name)
        for name, value in finding.parameters.items()
    )
    mark = " (refinement)" if finding.refines else ""
    cells = [
        f'<td class="text">{finding.effect}{mark}</td>',
        f'<td class="text">{html.escape(finding.joint or "all")}</td>',
        f'<td class="text values">{html.escape(values)}</td>',
        f"<td>{percent(finding.error_before)}</td>",
        f"<td>{percent(finding.error_after)}</td>",
        f'<td class="bar"><span style="width:{round(110 * max(0.0, finding.gain))}px"></span>'
        f"{percent(finding.gain)}</td>",
        f'<td class="text why">{html.escape(finding.evidence)}</td>',
    ]
    return f"<tr>{''.join(cells)}</tr>"


def _joints(diagnosis: Diagnosis) -> str:
    """Share of each joint's torque: explained, systematic, noise."""
    head = (
        "<tr><th>joint</th><th>error</th><th>with the effects</th><th>explained</th>"
        "<th>systematic, unexplained</th><th>noise</th></tr>"
    )
    rows = "".join(
        f"<tr><td>{html.escape(name)}</td><td>{percent(j.error_before)}</td>"
        f"<td>{percent(j.error_after)}</td><td>{100 * j.explained:.3f} %</td>"
        f"<td>{100 * j.systematic:.4f} %</td><td>{100 * j.noise:.4f} %</td></tr>"
        for name, j in diagnosis.joints.items()
    )
    note = (
        "<caption>Shares of the torque's variance with the effects in. Systematic is what smooth "
        "functions of the motion predict, what returns in the next lap, what lasts, and "
        "outbursts.</caption>"
    )
    return f"<table>{note}{head}{rows}</table>"


def _blind(diagnosis: Diagnosis) -> str:
    lines = [
        f"<li>{html.escape(what)}: {html.escape(why)}</li>" for what, why in blind_spots(diagnosis)
    ]
    return f"<ul>{''.join(lines)}</ul>" if lines else "<p>Nothing of the catalogue.</p>"
