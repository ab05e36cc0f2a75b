"""A change of a machine is named, and none where there is none.

The whole suite: `python -m tests.changed_machines`.
"""

import re

import pytest

from modeler.api.checks import compare_with_provenance
from tests.changed_machines.judge import name_changes
from tests.changed_machines.machines import KINDS, NONE, ROBOTS, make_machine, open_machine
from tests.rotation import ROTATING, rotating

FIRST = 100
"""Seed of the arm for demonstrations; the next ones are those of the other robots."""
DAILY = [("friction", FIRST), ("load", FIRST + 3)]
REST = [(kind, FIRST + k) for kind in KINDS for k in range(len(ROBOTS))]
LONG = [pytest.param(*case, marks=ROTATING) for case in REST if case not in DAILY]


@pytest.mark.rotating("long tests of changed_machines")
@pytest.mark.parametrize(("kind", "seed"), [*rotating(*DAILY), *LONG])
def test_a_change_is_named_and_no_other(kind, seed):
    machine = make_machine(kind, seed)
    lines = name_changes(machine)
    assert len(lines) == 1 and re.search(machine.pattern, lines[0]), (machine.about, lines)


@pytest.mark.parametrize("seed", [FIRST, *rotating(*range(FIRST + 1, FIRST + 2 * len(ROBOTS)))])
def test_nothing_is_named_of_a_machine_that_stayed(seed):
    assert name_changes(make_machine(NONE, seed)) == []


@pytest.mark.parametrize(("kind", "seed"), [("friction", FIRST), *rotating((NONE, FIRST))])
def test_compare_names_it_from_the_model_alone(kind, seed):
    machine = make_machine(kind, seed)
    run = compare_with_provenance(
        open_machine(machine.robot).fit([machine.before]), [machine.after]
    )
    changed = [line for line in run.format_lines() if line.startswith("changed between")]
    assert len(changed) == (kind != NONE) and all(re.search(machine.pattern, x) for x in changed)
    assert len(run.to_json()["machine_changed"]) == len(run.machine.changes)
