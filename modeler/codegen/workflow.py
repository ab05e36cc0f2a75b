"""The deriving half of the chain: a robot, its model, its base parameters, its C."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler.core.choices import Machine, Precision
from modeler.core.formula import Formulas
from modeler.core.manifest import EmittedModule, FittedSpec
from modeler.core.result import Result
from modeler.derivation import (
    BaseParameters,
    SymbolicModel,
    derive_base_parameters,
    derive_model,
    relations,
)
from modeler.robot import Robot

if TYPE_CHECKING:
    from modeler.codegen.control import Control


_FORMS = ("text", "latex", "markdown")


@dataclass(frozen=True)
class Derivation(Result):
    """A robot, its symbolic model and its base parameters."""

    robot: Robot
    model: SymbolicModel
    base: BaseParameters

    @property
    def relations(self) -> Formulas:
        """Returns the base parameters as sums of standard ones; a notebook typesets them."""
        title = f"base parameters of {self.robot.name}"
        forms = (relations.format_base_parameters(self.base, form) for form in _FORMS)
        return Formulas(title, *forms)

    def to_json(self) -> dict[str, Any]:
        """Returns what scripts read: base parameters, their sums, the proof."""
        return relations.serialise_base_parameters(self.robot.name, self.base)

    def closed_form(self, nonzero: bool = False) -> Formulas:
        """Returns j(q), S(q), g(q) and e of tau = J qdd + S [qd qd] + g + e.

        E all effects but rotors.

        Args:
            nonzero: True to leave out parameters that the robot file states as 0.
        """
        from modeler.formulas import derive_short_form, drop_zero_parameters

        base = drop_zero_parameters(self.model, self.base) if nonzero else self.base
        return derive_short_form(self.model, base).format_formulas()

    def regressor(self, nonzero: bool = False) -> Formulas:
        """Returns the columns phi of tau = phi beta.

        Args:
            nonzero: as of `closed_form`.
        """
        from modeler.formulas import derive_regressor_form, drop_zero_parameters

        base = drop_zero_parameters(self.model, self.base) if nonzero else self.base
        return derive_regressor_form(self.model, base).format_formulas()


def derive(robot: Robot) -> Derivation:
    r"""Returns the symbolic model and the base parameters with their proof.

    >>> from modeler.robot import read_robot
    >>> derivation = derive(read_robot("two-link"))
    >>> derivation.base.rank, derivation.base.proof.kind
    (10, 'exact')
    >>> print(derivation.table("base").to_markdown().splitlines()[2])
    | $\mathit{ZZ}_{1R}$ | $\mathit{ZZ}_{1} + L_{1}^{2} M_{2}$ | kg m2 | inertial |
    """
    model = derive_model(robot)
    return Derivation(robot, model, derive_base_parameters(model))


def generate(
    derivation: Derivation,
    folder: str | Path | None = None,
    force: bool = False,
    fitted: FittedSpec | None = None,
    precision: Precision = "double",
    cuda: bool = False,
    control: "Control | None" = None,
    measure: Machine | None = None,
) -> EmittedModule:
    """Returns the C module; written to `folder` if one is given, with the controller's unit.

    Args:
        derivation: of the robot.
        folder: made if it is not there.
        force: write also over files that no earlier run wrote, or that were edited since.
        fitted: values of its base parameters; functions that have them are added.
        precision: `double`, or `single`: then all numbers of the C are `float`.
        cuda: add the base regressor in CUDA, of a robot without loops.
        control: what of the controller's unit is emitted; where a folder is given, all.
        measure: add what calls cost on this machine or a Cortex-M, with the controller's unit.

    Raises:
        BuildError: the compiler for that machine is missing.
        ModelerError: the folder holds files of these names that no earlier `generate` wrote, or
            that were edited since, and `force` is not given; or it cannot be written.
    """
    from modeler.codegen.control import Control  # who derives need not wait for it
    from modeler.codegen.emit import emit
    from modeler.codegen.package import write_emitted

    if control is None and folder is not None:
        control = Control()
    emitted = emit(derivation.model, derivation.base, fitted, precision, cuda, control)
    if measure is not None:
        from modeler.codegen.cost import add_cost

        emitted = add_cost(emitted, measure)
    emitted = dataclasses.replace(emitted, log=derivation.robot.log_mapping)
    if folder is not None:
        write_emitted(emitted, Path(folder), force)
    return emitted
