"""What is said of the logs of a machine before and after."""

from modeler import api
from modeler.estimation import compare_machines, fit_machine, sum_observation
from tests.changed_machines.machines import ChangedMachine, open_machine


def name_changes(machine: ChangedMachine) -> list[str]:
    """The sentences on what differs, by rows in the band of the first log."""
    compiled = open_machine(machine.robot).compiled
    before = api.observe(compiled, [machine.before])
    after = api.observe(compiled, [machine.after], before.report.processing)
    fit = fit_machine(sum_observation(before))
    return compare_machines(compiled.spec, fit, sum_observation(after)).describe("both logs")
