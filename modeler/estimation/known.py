"""What a fit takes for known, tested against the data: weights of loads, drive gains."""

import contextlib
import dataclasses
from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.doubts import find_heterogeneous_logs
from modeler.estimation.drive_gains import GainFit, identify_gains
from modeler.estimation.identify import fit_equations
from modeler.estimation.payload import LoadedEquations, Payload, build_loaded_equations
from modeler.regression import DataWarning, Observation
from modeler.runtime import CompiledModel

FAR = 4.0
"""Standard deviations between what is given and what the logs say, from which on it is told."""

WORTH = 0.01
"""Share of a known quantity below which no deviation is told: a load is weighed to this."""


def check_known_quantities(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload], currents: bool
) -> list[DataWarning]:
    """Known quantities that the logs contradict, each with the factor.

    First that a load sits alike in all its logs, and that all are of one robot; if not, nothing
    else is asked.

    Each is set free with all parameters: the mass of a load as the factor of its torques, drive
    gains as in `identify_gains`. Its value is doubted if it is farther than FAR of its own standard
    deviations, memory of the residuals included, and WORTH of it, from what was given.

    Args:
        model: the robot.
        observation: of bare and loaded logs.
        payloads: of which those of known mass are tested.
        currents: True if the torques are logged currents times the gains of the robot file.
    """
    apart = find_heterogeneous_logs(model, observation, payloads)
    if apart or not any(payload.mass is not None for payload in payloads):
        return [DataWarning(line, affects_values=True) for line in apart]
    warnings = _check_weights(
        observation, build_loaded_equations(model, observation, payloads), currents
    )
    lines: list[str] = []
    if currents:
        with contextlib.suppress(DataError):  # logs that do not tell the gains contradict none
            gains = identify_gains(model, observation, payloads)
            lines = describe_deviations(model.spec, gains, only_doubtful=True)
    if lines:
        line = (
            "by the weight of the load, the drive gains are not those of the robot file: "
            f"{'; '.join(lines)}; check them, or let --method tls take the ones found"
        )
        warnings.append(DataWarning(line, affects_values=True))
    return warnings


def _check_weights(
    observation: Observation, loaded: LoadedEquations, currents: bool
) -> list[DataWarning]:
    warnings = []
    for i, payload in enumerate(loaded.weighed):
        if not loaded.can_identify_mass(i):
            continue
        # The factor on its torques that the logs ask for; 1 if its mass is right.
        column = loaded.torques[:, i]
        equations = loaded.equations.append_columns(column, ["factor"])
        equations = dataclasses.replace(equations, y=loaded.equations.y + column)
        fit = fit_equations(observation, equations, "weighted", noise_only=True)
        factor = fit.loads[-1]
        if factor.sigma is None or not _is_contradicted(factor.value, factor.sigma):
            continue
        assert payload.mass is not None
        mass, sigma = factor.value * payload.mass, factor.sigma * payload.mass
        more = (
            f"{format_percent(abs(factor.value - 1.0))} {'more' if factor.value > 1.0 else 'less'}"
        )
        gains = (
            f"or all drive gains are {1.0 / factor.value:.3g} times what the robot file says; "
            "--method tls finds the gains"
            if currents
            else f"or all torques are logged {factor.value:.3g} times as large as they are: the "
            "drive gains that the controller assumes are wrong by that"
        )
        line = (
            f"payload {payload.name}: the logs say that it weighs {mass:.4g} +- {sigma:.1g} kg, "
            f"{more} than the {payload.mass:g} kg given; check the weight, {gains}"
        )
        warnings.append(DataWarning(line, affects_values=True))
    return warnings


def _is_contradicted(factor: float, sigma: float) -> bool:
    return abs(factor - 1.0) > max(FAR * sigma, WORTH)


def describe_deviations(
    spec: ModuleSpec, gain_fit: GainFit, only_doubtful: bool = False
) -> list[str]:
    """How far identified gains are from those of the robot file, a phrase for each that has one."""
    lines = []
    for joint in spec.joints:
        if (gain := gain_fit.gains.get(joint.name)) is None:
            continue
        sigma, stated = gain_fit.sigmas[joint.name], joint.drive_gain
        label = f"joint {joint.name} {gain:.4g} +- {sigma:.1g}"
        if stated is None:
            fits, beside = gain >= 0.0, "negative"
        else:
            fits = only_doubtful and not _is_contradicted(gain / stated, sigma / abs(stated))
            beside = f"of the other sign than {stated:.4g}"
        if fits:
            continue
        if stated is None or gain * stated < 0.0:
            lines.append(
                f"{label}, {beside}: current{joint.name} or q{joint.name} is counted the other way "
                "round; if that is a mistake of the log, give the one that is wrong sign = -1 in "
                "[log]"
            )
        else:
            share = gain / stated - 1.0
            side = "above" if share > 0.0 else "below"
            lines.append(f"{label}, {format_percent(abs(share))} {side} {stated:.4g}")
    return lines
