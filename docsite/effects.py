"""Gallery of the effects: what each leaves in the residual of a machine that has it.

Every picture is made by the commands that stand below it: a machine with the effect hidden is
simulated, fitted without it and diagnosed.
"""

import dataclasses
import io
import textwrap
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from typing import Any

from docsite.days import has_its_turn
from docsite.markdown import block, cell, code, table
from modeler import api
from modeler.core.errors import DataError
from modeler.core.figure import Picture
from modeler.diagnosis import Diagnosis, Finding, format_lines
from modeler.effects import CATALOGUE, Effect, EffectTarget, NonlinearParameter
from modeler.robot import Robot, insert_effect, replace_robot_effects
from modeler.simulation import HIDDEN
from modeler.views import build_diagnosis_page
from modeler.views.figures import draw_picture

FAMILIES = {
    "friction": "Friction",
    "load": "Springs, loads, gravity",
    "transmission": "Gears and motors",
    "measurement": "Sensors, drives, clocks",
    "inertia": "Inertia",
}
"""Of the catalogue -> heading of the index."""


@dataclass(frozen=True)
class Scene:
    """A machine that has the effect, and the model that lacks it.

    Attributes:
        at: joint and values, as `--hide` takes them behind the effect; empty: drawn.
        robot: built-in robot.
        effects: those of the model; None: those of the robot file.
        unloaded: True if the model is fitted to a log of the machine without the effect, which its
            inertial parameters would absorb.
        duration: s.
    """

    at: str = "@2"
    robot: str = "two-link"
    effects: str | None = None
    unloaded: bool = False
    duration: int = 15

    def commands(self, effect: str) -> list[str]:
        """From the machine to the pictures, for a shell."""
        with_them = f" --effects {self.effects}" if self.effects is not None else ""
        measured = f"--duration {self.duration} --rate {RATE}"
        first = f"modeler simulate {self.robot}{with_them}"
        before = [f"{first} {measured} --seed 1 --out before.parquet"] * self.unloaded
        return [
            *before,
            f"{first} --hide {effect}{self.at} {measured} --out run.parquet",
            f"modeler fit {self.robot}{with_them} {'before' if before else 'run'}.parquet "
            "--out arm.model.json",
            "modeler diagnose arm.model.json run.parquet --picture pictures",
        ]


RATE = 250  # Hz

SCENES: Mapping[str, Scene] = {
    "viscous": Scene(effects="coulomb"),
    "coulomb": Scene(effects="viscous"),
    "coupled_inertia": Scene("@1", "demo-arm"),
    "coupled_friction": Scene(""),
    "passive_friction": Scene("", "five-bar"),
    "payload": Scene("", "demo-arm", unloaded=True),
    "link_inertia": Scene("@2:x=0.1,y=0.2,mass=1.5", "demo-arm", unloaded=True),
    "base_tilt": Scene("", "demo-arm"),
    "external_force": Scene("", "demo-arm"),
    "presliding": Scene("@2", "demo-arm"),
    "elasticity": Scene("@3:stiffness=600,damping=2", "demo-arm"),
    "backlash": Scene("@3:gap=0.005", "demo-arm"),
    "motor_ripple": Scene("@2:gear=101,order=1"),
    "encoder_offset": Scene("@2:angle=0.08", "demo-arm"),
    "drive_gain": Scene("@2", "demo-arm"),
    "time_delay": Scene("", "demo-arm"),
}
"""Effect -> its machine, where it is not the arm of two links with the effect on joint 2."""


@dataclass(frozen=True)
class Portrait:
    """An effect as the gallery shows it.

    Attributes:
        effect: of the catalogue.
        page: Markdown.
        picture: PNG of the residual; None where nothing simulates it.
        thumbnail: PNG of the part that shows the effect best.
    """

    effect: Effect
    page: str
    picture: bytes | None
    thumbnail: bytes | None


def portraits() -> list[Portrait]:
    """All effects of the catalogue, as many at a time as there are processors.

    One that has not its turn today stands without a picture.
    """
    drawn = [effect.id for place, effect in enumerate(CATALOGUE) if has_its_turn(place)]
    with ProcessPoolExecutor() as pool:
        table = dict(zip(drawn, pool.map(portrait, drawn), strict=True))
    return [table.get(e.id) or _without_picture(e, "No picture was made today.") for e in CATALOGUE]


def portrait(name: str) -> Portrait:
    """All that the gallery says of an effect; takes two seconds."""
    effect = next(effect for effect in CATALOGUE if effect.id == name)
    if name not in HIDDEN:
        text = "Nothing simulates this effect, so there is no picture of its residual."
        return _without_picture(effect, text)
    scene = SCENES.get(name, Scene())
    shown = _shown(effect, scene)
    picture = _picture(effect, shown.diagnosis)
    parts = [
        _scene_words(shown, scene),
        "",
        f'<div class="wide" markdown="1">![Residual with {cell(effect.title)} hidden]'
        f"({name}.png)</div>",
        "",
        cell(picture.caption.removeprefix(f"Look for: {effect.signature}. ")),
        "",
        "What the diagnosis says of it:",
        "",
        block("\n".join(_list_findings(shown.diagnosis)), "text"),
        "The same by hand; the picture is "
        f"{code(f'pictures/{picture.name}.png')}, with its numbers as CSV beside it:",
        "",
        block("\n".join(scene.commands(name)), "sh"),
    ]
    page = _page(effect, "\n".join(parts), _apart(effect, shown), _shapes(effect, shown.diagnosis))
    return Portrait(effect, page, _png(picture), _png(_small(picture), (4.0, 2.7)))


def _without_picture(effect: Effect, told: str) -> Portrait:
    return Portrait(effect, _page(effect, told, "", {}), None, None)


def effects_index(portraits: Sequence[Portrait]) -> str:
    """The page that shows all effects, family by family."""
    parts = [
        "# Effects\n\nWhat a model may lack, and what that leaves behind. Each picture is of a "
        "simulated machine that has the effect and is fitted without it: dots and black means are "
        "the torque that is left to the effect, the orange line is the effect as the diagnosis "
        "finds it. In a terminal: `modeler effects`.\n"
    ]
    for family, title in FAMILIES.items():
        rows = [
            (
                f"[![{item.effect.id}]({item.effect.id}-small.png)]({item.effect.id}.md)"
                if item.thumbnail
                else "",
                f"[{cell(item.effect.id)}]({item.effect.id}.md): {cell(item.effect.title)}<br>"
                f"{cell(item.effect.signature)}",
            )
            for item in portraits
            if item.effect.family == family
        ]
        parts += [f"## {title}\n", table(("picture", "effect, and how it shows"), rows)]
    return "\n".join(parts)


@dataclass(frozen=True, eq=False)
class _Shown:
    """What came of a scene: the model that lacks the effect, what was hidden, what was found."""

    model: api.Model
    hidden: str
    diagnosis: Diagnosis


def _shown(effect: Effect, scene: Scene) -> _Shown:
    robot, derivation, emitted = _machine(scene.robot, scene.effects)
    measured: dict[str, Any] = {"duration": float(scene.duration), "rate": float(RATE)}
    run = api.simulate(robot, hide=[f"{effect.id}{scene.at}"], **measured)
    fitted = api.simulate(robot, seed=1, **measured) if scene.unloaded else run
    compiled = api.compile_model(emitted)
    model = api.fit(derivation, emitted, api.observe(compiled, [fitted]))
    (hidden,) = run.truth.hidden_effects
    values = ", ".join(f"{name} = {value:.4g}" for name, value in hidden.values.items())
    where = f", joint {hidden.joint}" if hidden.joint else ""
    return _Shown(model, f"{effect.id}{where}: {values}", api.diagnose(model, [run]))


@cache
def _machine(name: str, effects: str | None) -> tuple[Robot, api.Derivation, api.EmittedModule]:
    robot = api.load(name)
    robot = robot if effects is None else replace_robot_effects(robot, effects, "effects")
    derivation = api.derive(robot)
    return robot, derivation, api.generate(derivation)


def _picture(effect: Effect, diagnosis: Diagnosis) -> Picture:
    """Of the effect, or of that which the diagnosis finds in its place."""
    drawn = [
        p
        for p in build_diagnosis_page(diagnosis).collect_pictures()
        if not p.name.startswith("torque_")
    ]
    items = [p for p in drawn if p.name.startswith(f"evidence_{effect.id}")]
    return (items or drawn)[0]


def _small(picture: Picture) -> Picture:
    """What shows the effect best: its law, where the picture has one; else the first panel."""
    first, *others = picture.panels[0]
    panel = next((panel for panel in others if panel.title == "its law"), first)
    panel = dataclasses.replace(panel, title="")
    return dataclasses.replace(picture, title="", panels=((panel,),), widths=(), heights=())


def _png(picture: Picture, size: tuple[float, float] | None = None) -> bytes:
    figure, stream = draw_picture(picture), io.BytesIO()
    if size is not None:
        figure.set_size_inches(*size)
        for legend in figure.legends:
            legend.remove()
    figure.savefig(stream, format="png", dpi=100, metadata={"Software": None})
    return stream.getvalue()


# The words of a page.


def _page(effect: Effect, shown: str, apart: str, shapes: Mapping[str, float]) -> str:
    also = f" Also called {', '.join(map(code, effect.aliases))}." if effect.aliases else ""
    return "\n\n".join(
        [
            f"# {cell(effect.title[0].upper() + effect.title[1:])}",
            f"{code(effect.id)} in a robot file and in commands.{also}",
            "\n".join([block(effect.equation, "text"), *_parameters(effect)]),
            f"**Range.** {cell(effect.range)}.",
            f"**Source.** {cell(effect.source)}.",
            "## What it leaves in the residual",
            f"Look for: {cell(effect.signature)}.",
            shown,
            f"## Confounders\n\n{cell(_sentence(effect.confounders))}",
            apart,
            f"## In a robot file\n\n{_written(effect, shapes)}",
        ]
    )


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _parameters(effect: Effect) -> list[str]:
    """Tables of parameters and of shapes, for every form."""
    acts = f"It {cell(effect.acts.value)}."
    if effect.acts in (
        EffectTarget.LINK,
        EffectTarget.GRAVITY,
        EffectTarget.WINDOW,
    ):  # one column for several parameters
        return [acts]
    columns: list[tuple[str, ...]] = []
    shapes: dict[str, NonlinearParameter] = {}
    for form in effect.forms:
        for c in form.columns:
            units = dict.fromkeys(cell(unit) for unit in (c.unit_revolute, c.unit_prismatic))
            sign = "not below 0" if c.nonnegative else "either sign"
            columns.append((code(c.prefix), code(c.equation.text), " or ".join(units), sign))
        shapes |= {shape.name: shape for shape in form.free_parameters}
    head = ("parameter", "equation, times it", "unit: joint turns, slides", "sign")
    values = [f"{acts[:-1]}:", "", table(head, columns)]
    if shapes:
        rows = [
            (
                code(s.name),
                cell(s.meaning),
                " or ".join(dict.fromkeys(map(s.get_unit, (False, True)))),
            )
            for s in shapes.values()
        ]
        values += ["", table(("shape", "what it is", "unit"), rows)]
    return values


def _scene_words(shown: _Shown, scene: Scene) -> str:
    fitted = "fitted to a log of the machine before that" if scene.unloaded else "fitted without it"
    return f"The machine: `{scene.robot}` with {cell(shown.hidden)}. Its model is {fitted}."


def _list_findings(diagnosis: Diagnosis) -> list[str]:
    """The verdict and what is said of each effect that is named, at 88 letters a line."""
    said = format_lines(diagnosis)
    named = {finding.joint for finding in diagnosis.effects}
    of_effects = tuple(f"joint {joint}: " if joint else "the whole robot: " for joint in named)
    lines = [said[0], *(line for line in said[1:] if line.startswith(of_effects or ("?",)))]
    return [textwrap.fill(line, 88, subsequent_indent="  ") for line in lines]


def _apart(effect: Effect, shown: _Shown) -> str:
    """Ties and alternatives in these logs, and the motion that distinguishes the strongest."""
    finding = next((f for f in shown.diagnosis.effects if f.effect == effect.id), None)
    if finding is None:
        return ""
    ties = [_place(name, joint) for name, joint in finding.equivalents]
    others = [
        (_place(name, joint), f"{100 * max(gain, 0.0):.3g} %")
        for name, joint, gain in shown.diagnosis.alternatives
        if joint == finding.joint and name != effect.id
    ][:5]
    parts = []
    if ties:
        parts += [f"Not distinguished by this log: {', '.join(ties)}.", ""]
    if others and shown.diagnosis.effects[0] is finding:
        parts += [
            "What others would explain of the variance that it explains here:",
            "",
            table(("rival", "explains"), others),
        ]
    if between := _between(finding, shown):
        parts += [
            "",
            "The motion that makes the difference large, for the model above:",
            "",
            block(f"modeler excite arm.model.json --between {between} --out motion.csv", "sh"),
        ]
    return "\n".join(parts)


def _between(finding: Finding, shown: _Shown) -> str:
    """The effect and its strongest distinguishable alternative; empty without one."""
    from modeler.api.motion import build_subject, parse_question

    subject = build_subject(shown.model)
    others = [
        *finding.equivalents,
        *((name, joint) for name, joint, _ in shown.diagnosis.alternatives),
    ]
    for name, joint in others:
        if name == finding.effect or joint != finding.joint or joint is None:
            continue
        text = f"{finding.effect}@{finding.joint},{name}@{joint}"
        try:
            parse_question(subject, text)
        except DataError:
            continue
        return text
    return ""


def _place(name: str, joint: str | None) -> str:
    return f"[{cell(name)}]({name}.md)" + (f" on joint {joint}" if joint else "")


def _shapes(effect: Effect, diagnosis: Diagnosis) -> Mapping[str, float]:
    """What the diagnosis finds of the shapes that a robot file states, three digits."""
    free = {shape.name for form in effect.forms for shape in form.free_parameters}
    picks = (f.pick for f in diagnosis.effects if f.effect == effect.id and f.pick is not None)
    shapes = next((pick.candidate.nonlinear_parameters for pick in picks), {})
    return {name: float(f"{value:.3g}") for name, value in shapes.items() if name in free}


def _written(effect: Effect, shapes: Mapping[str, float]) -> str:
    """The lines of a robot file that carry the effect, or why there are none."""
    if effect.can_be_stated:
        joint = "21" if effect.acts is EffectTarget.PASSIVE else "2"
        text = insert_effect('name = "arm"\n', effect.id, joint, shapes)
        shaft = '\n[coupling]\n2 = "q1 + q2"  # the motor of joint 2 also turns with joint 1\n'
        return block(text[text.index("[effects]") :] + shaft * effect.is_coupled, "toml")
    if effect.obstacle:
        return f"No column carries it: {cell(effect.obstacle)}."
    return (
        f"No robot file names it. `modeler add arm.model.json {effect.id} run.parquet --out "
        "better.model.json` puts it into the model."
    )
