"""What is done next, as tasks made of a project: what each button carries out."""

import dataclasses
from collections.abc import Sequence
from typing import Any

from modeler.studio.project import Project
from modeler.studio.tasks import LogPart, Step, Task, build_command_line


def build_command_words(project: Project, work: Task | Step) -> tuple[str, ...]:
    """Builds the words after `modeler` of a step, or of a task as the next step.

    Raises:
        DataError: a value that cannot stand in a command line.
    """
    step = work if isinstance(work, Step) else project.make_next_step(work)
    return build_command_line(step, project.steps)


def fit(project: Project, options: Sequence[tuple[str, Any]] = ()) -> Task:
    """Makes the task of a fit of the training ranges.

    Args:
        project: with a robot and logs.
        options: fields of the task, as ("method", "robust").
    """
    task = Task("fit", logs=project.collect_parts("train"), mapping=project.mapping)
    return dataclasses.replace(task, **dict(options))


def compare(project: Project, parts: Sequence[LogPart] = ()) -> Task:
    """Makes the task of a comparison: on held-out ranges, else on training ranges."""
    logs = tuple(parts) or project.collect_judged_parts()
    return Task("compare", logs=logs, mapping=select_guess_mapping(project))


def compare_models(project: Project, models: tuple[int, int]) -> Task:
    """Makes the task that compares the models of two steps on the same logs."""
    return dataclasses.replace(compare(project), verb="contest", models=models)


def diagnose(project: Project) -> Task:
    """Makes the task that finds what the current model lacks."""
    return dataclasses.replace(_build_diagnosis_task(project), without=project.without)


def add(project: Project, effect: str, joint: str | None) -> Task:
    """Makes the task that adds an effect to the current model."""
    return dataclasses.replace(
        _build_diagnosis_task(project), verb="add", effect=effect, joint=joint or ""
    )


def _build_diagnosis_task(project: Project) -> Task:
    held_out_parts = project.collect_parts("test")
    return Task(
        "diagnose", project.collect_parts("train"), held_out_parts, select_guess_mapping(project)
    )


def inspect_log(project: Project, file: str) -> Task:
    """Makes the task that inspects a log, with the robot if there is one."""
    return Task("log", file=file, robot=bool(project.robot), mapping=project.mapping)


def fleet(project: Project, parts: Sequence[LogPart], names: str) -> Task:
    """Makes the task that finds changes from log to log.

    Args:
        project: with a robot.
        parts: of its logs.
        names: how paths end, with machine and period; "": by folders and files.
    """
    return Task("fleet", tuple(parts), mapping=project.mapping, name=names)


def select_guess_mapping(project: Project) -> tuple[str, ...]:
    """Returns the mapping if it is "auto"; a model keeps that of the first log."""
    return project.mapping if "auto" in project.mapping else ()


def build_viewer_words(project: Project, parts: Sequence[LogPart]) -> list[str]:
    """Builds the words for the viewer: logs, then their mapping."""
    maps = [word for map_word in select_guess_mapping(project) for word in ("--map", map_word)]
    return [*(part.command_word for part in parts), *maps]
