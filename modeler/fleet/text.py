"""What a fleet shows, in words and as tables of text."""

from collections.abc import Sequence

from modeler.compare.table import aligned
from modeler.effects import CATALOGUE, effect_named
from modeler.fleet.layout import GAIN, LOAD, Quantity
from modeler.fleet.result import Finding, Fleet, Followed, Warmth
from modeler.fleet.times import Unit


def effect_title(quantity: Quantity) -> str:
    """What drifts, in words of the catalogue."""
    if quantity.effect == GAIN:
        return "drive gain"
    if quantity.effect == LOAD:
        return "load on the last link"
    effect = effect_named(quantity.effect, CATALOGUE)
    return quantity.effect.replace("_", " ") if effect is None else effect.title


def sentence(found: Finding, unit: Unit) -> str:
    """One finding, with what it may be instead."""
    quantity = found.quantity
    where = f"machine {found.machine}" + (
        "" if quantity.joint is None else f", joint {quantity.joint}"
    )
    named = effect_title(quantity) + ("" if quantity.column < 0 else f" ({quantity.parameter})")
    line = f"{where}: {named} {_happens(found, unit)}"
    return line + _warmth(found.warmth)


def _warmth(warmth: Warmth | None) -> str:
    if warmth is None or not warmth.along:
        return ""
    told = (
        f"; the temperature of the logs moves along, {warmth.lowest:.4g} to {warmth.highest:.4g} "
        f"(correlation {warmth.correlation:.2f})"
    )
    if warmth.shared is False:
        return f"{told}, but machines that warm alike do not change so"
    return f"{told}, and may be the cause: compare periods of one temperature"


def _happens(found: Finding, unit: Unit) -> str:
    up = found.change > 0.0
    size = _size(found)
    after = f"{found.before:.4g} to {found.before + found.change:.4g} {found.quantity.unit}"
    if found.shape == "odd machine":
        side = "above" if up else "below"
        return f"is {size} {side} that of the other machines ({found.score:+.1f} of their spread)"
    if found.shape == "trend":
        verb = "rises" if up else "falls"
        span = f"{found.length:.3g} {unit}"
        return f"{verb} by {size} over {span}, from {after} ({abs(found.score):.1f} sigma)"
    verb = "leaps up" if up else "leaps down"
    told = f"from {after} ({abs(found.score):.1f} sigma)"
    return f"{verb} by {size} at {found.begin}{_stays(found)}, {told}"


def _stays(found: Finding) -> str:
    """What is known of the time after a leap: of one in the last period, nothing."""
    if found.shape != "jump":
        return " and is back after it"
    return " and stays" if found.since > 1 else ", the last period (whether it stays is not known)"


def _size(found: Finding) -> str:
    if found.percent is None:
        return f"{abs(found.change):.3g} {found.quantity.unit}"
    return f"{abs(found.percent):.3g} %"


def headline_of(found: Fleet) -> tuple[str, str]:
    """A figure and what it is."""
    machines = f"{len(found.machines)} machine{'s' * (len(found.machines) != 1)}"
    less = ""
    if found.left:
        less = f"; {len(found.left)} log{'s' * (len(found.left) > 1)} left out"
    if not found.findings:
        return "nothing", f"drifts beyond doubt on {machines} in {found.logs} logs{less}"
    hit = len({one.machine for one in found.findings})
    return f"{hit} of {machines}", f"drift or are apart from the others, beyond doubt{less}"


def fleet_lines(found: Fleet) -> list[str]:
    """All of it, for people."""
    figure, what = headline_of(found)
    lines = [f"{found.robot}: {figure} {what}"]
    lines += [f"  {sentence(one, found.unit)}" for one in found.findings]
    lines += ["", *aligned(rows_of(found), (0, 1)), ""]
    lines.append(
        "told: the smallest straight drift over all periods that would be a finding; chance of any "
        f"finding where nothing drifts: {100 * found.false_alarm:.2g} %"
    )
    lines += [*found.notes, *_gain_note(found)]
    lines += left_lines(found)
    if found.aside:
        lines.append(f"not told by any log, taken as 0: {', '.join(found.aside)}")
    return lines


def left_lines(found: Fleet) -> list[str]:
    """Logs that were not used, and why; most reasons begin with the place already."""
    return [f"left out: {why if place in why else f'{place}: {why}'}" for place, why in found.left]


def rows_of(found: Fleet) -> list[list[str]]:
    """Header, and a row for each quantity."""
    head = ["joint", "effect", "parameter", "level", "unit", "scatter", "told"]
    return [head, *(_row(each) for each in found.followed)]


def _row(each: Followed) -> list[str]:
    quantity = each.quantity
    return [
        quantity.joint or "-",
        effect_title(quantity),
        quantity.parameter,
        f"{each.level:.4g}" if each.level == each.level else "-",
        quantity.unit,
        f"{each.factor:.2f}",
        "-" if each.told is None else f"{each.told:.2g}",
    ]


def _gain_note(found: Fleet) -> Sequence[str]:
    if not any(one.quantity.effect == GAIN for one in found.findings):
        return ()
    return (
        "a drive gain above the others: the logged torque (current times gain) is more than the "
        "motion needs, as with a weaker magnet, or a torque sensor that reads too much",
    )
