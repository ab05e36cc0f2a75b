"""The comparison in plain sentences."""

from modeler.core.table import WORDS, format_percent
from modeler.validation import residual_structure
from modeler.validation.comparison import Comparison, JointComparison, Region
from modeler.validation.thresholds import THRESHOLDS


def write_headline(comparison: Comparison) -> str:
    """Writes one sentence on the whole robot."""
    if not comparison.joints:
        return f"{comparison.prediction.robot}: no joint could be judged."
    ranked = sorted(comparison.joints, key=lambda item: item.relative_error)
    parts = [
        f"{format_percent(error)} of the {WORDS[unit]}"
        for unit, error in collect_unit_errors(comparison)
    ]
    text = f"{' and '.join(parts)} is unexplained"
    if len(ranked) == 1:
        return f"{text}."
    best, worst = ranked[0], ranked[-1]
    return (
        f"{text}; joint by joint from {format_percent(best.relative_error)} (joint "
        f"{best.joint.name}) to {format_percent(worst.relative_error)} (joint {worst.joint.name})."
    )


def collect_unit_errors(comparison: Comparison) -> list[tuple[str, float]]:
    """Returns the units of the judged joints, and the error over the joints of each."""
    judged = {item.joint.effort_unit for item in comparison.joints}
    return [(unit, error) for unit, error in comparison.by_unit.items() if unit in judged]


def write_verdict(comparison: Comparison) -> tuple[str, ...]:
    """Writes one line per joint: how good, what is left, when it is worst."""
    lines = [write_joint_verdict(item) for item in comparison.joints]
    lines += [
        f"Joint {name} is not judged: {reason}." for name, reason in comparison.excluded_joints
    ]
    return tuple(lines)


def write_joint_verdict(item: JointComparison) -> str:
    """Writes the line of one joint."""
    return (
        f"Joint {item.joint.name}: {format_percent(item.relative_error)} of the "
        f"{WORDS[item.joint.effort_unit]} is unexplained "
        f"({item.rms:.2g} {item.joint.effort_unit} rms); {'; '.join(describe_findings(item))}."
    )


def describe_findings(item: JointComparison) -> list[str]:
    """Describes what is left in the residual of a joint, most useful first; never empty."""
    if item.rms <= 1e-12 * item.measured_rms:
        return ["prediction and measurement agree to rounding"]
    wrong = describe_wrong_scale(item)
    if wrong:  # everything else would follow from it
        return [wrong, _describe_worst(item)]
    patterns = _describe_patterns(item)
    if not patterns:  # a pattern that follows the motion has the frequencies of the motion
        patterns.append(_describe_oscillation(item) or _describe_no_pattern(item))
    return [*patterns, _describe_worst(item)]


def _describe_patterns(item: JointComparison) -> list[str]:
    """What the residual is a function of."""
    every = (
        _describe_pattern(item),
        _describe_predictor(item) or _describe_other_joint(item),
        _describe_ripple(item),
        _describe_bias(item),
        _describe_repeatable(item),
    )
    return [text for text in every if text]


def describe_wrong_scale(item: JointComparison) -> str | None:
    """Describes what to check where the prediction is right but for its sign or a factor."""
    scale, name = item.scale, item.joint.name
    if scale is None:
        return None
    times = f"measured is {scale.factor:.3g} times predicted"
    if scale.has_opposite_sign:
        return (
            f"the prediction of joint {name} has the opposite sign: {times}; check the sign of "
            f"tau{name} (or of its drive gain) and of q{name} in this log"
        )
    if scale.has_wrong_factor:
        return (
            f"the prediction of joint {name} is off by a factor: {times}; check the unit and the "
            "drive gain of this log, and what the robot carries"
        )
    return None


def compute_repeatable_share(item: JointComparison) -> float:
    """Returns the repeatable share of the residual; 0 within three standard errors of 0."""
    shares = item.shares
    if shares is None or (
        shares.sigma is not None and shares.systematic_share < 3.0 * shares.sigma
    ):
        return 0.0
    return shares.repeatable_share


def find_best_pattern(item: JointComparison) -> tuple[residual_structure.Coordinate, float] | None:
    """Finds the coordinate that explains most, or a simpler one nearly as good, and its share."""
    if item.structure is None:
        return None
    top = max(share for _, share in item.structure.shares)
    if top < THRESHOLDS.min_pattern_share:
        return None
    for coordinate in residual_structure.COORDINATES:
        share = item.structure.get_share(coordinate.id)
        if share >= THRESHOLDS.parsimony_share * top:
            return coordinate, share
    raise AssertionError("the best share is at least 0.9 of itself")


def find_best_other(item: JointComparison) -> tuple[str, float] | None:
    """Finds what explains clearly more by its velocity than the joint itself, and its share.

    "joint 3", or "the motor that turns with joints 5 and 6" where the model has friction there.
    """
    if item.structure is None:
        return None
    others = [(f"joint {k}", x) for k, x in item.structure.other_joints if k != item.joint.name]
    for name, share in item.structure.motors:
        first, _, last = name.replace("+", ", ").rpartition(", ")
        others.append((f"the motor that turns with joints {first} and {last}", share))
    if not others:
        return None
    name, share = max(others, key=lambda entry: entry[1])
    joint_share = max(item.structure.get_share("velocity"), item.structure.get_share("direction"))
    return (name, share) if share >= joint_share + THRESHOLDS.min_pattern_share else None


def classify_residual(item: JointComparison) -> str:
    """Returns `pattern`, `noise` or `other`, the class of the residual."""
    patterns = (
        describe_wrong_scale,
        _describe_ripple,
        _describe_repeatable,
        _describe_predictor,
        find_best_pattern,
        find_best_other,
    )
    if any(pattern(item) for pattern in patterns):
        return "pattern"
    return "noise" if is_noise_like(item) else "other"


def is_too_large(item: JointComparison) -> bool:
    """Returns whether the error is too large to be noise."""
    return item.relative_error >= THRESHOLDS.max_noise_error


def is_noise_like(item: JointComparison) -> bool:
    """Returns True without a pattern, autocorrelation or narrow line."""
    return (
        item.structure is not None
        and not _describe_patterns(item)
        and not _is_autocorrelated(item)
        and _describe_oscillation(item) is None
        and not is_too_large(item)
        and item.worst.energy_share < THRESHOLDS.max_burst_share
    )


def _describe_pattern(item: JointComparison) -> str | None:
    best, structure = find_best_pattern(item), item.structure
    if structure is None:
        return None
    if best is None:
        if structure.own_motion < THRESHOLDS.min_pattern_share:
            return None
        return (
            f"{format_percent(structure.own_motion)} of that is a repeatable function of the "
            "joint's own motion, spread over several coordinates"
        )
    coordinate, share = best
    text = f"{format_percent(share)} of that is a repeatable function of {coordinate.phrase}"
    if coordinate.id in ("velocity", "direction"):
        text += _describe_region(item.regions)
    if coordinate.id != "time" and structure.own_motion > share + 0.1:
        text += f" ({format_percent(structure.own_motion)} with its other coordinates)"
    return text


def _describe_region(regions: tuple[Region, ...]) -> str:
    groups = {
        "around zero speed": (2,),
        "at low speed": (1, 2, 3),
        "at high speed": (0, 4),
        "moving in the negative direction": (0, 1),
        "moving in the positive direction": (3, 4),
    }
    for text, members in groups.items():
        energy = sum(regions[member].energy_share for member in members)
        time = sum(regions[member].time_share for member in members)
        if energy > 0.6 and energy > 1.5 * time:
            return f", mostly {text}"
    return ""


def _describe_other_joint(item: JointComparison) -> str | None:
    best = find_best_other(item)
    if best is None:
        return None
    text = f"{format_percent(best[1])} of that follows the velocity of {best[0]} more than its own"
    if best[0].startswith("joint"):
        text += ", as where one motor turns with both ([coupling] in the robot file)"
    return text


def _describe_ripple(item: JointComparison) -> str | None:
    if item.orders is None:
        return None
    orders, per = residual_structure.convert_orders(item.orders, item.joint.unit)
    # the slowest waves of the spectrum are patterns over position, named elsewhere
    drawn = residual_structure.find_order_peaks(item.orders, item.joint.unit)
    fast = [line for line in drawn if line.waves > 2.0 * orders[0]]
    strong = [line for line in fast if line.share >= THRESHOLDS.min_pattern_share]
    if not strong:
        return None
    line = strong[0]
    return (
        f"ripple of {line.waves:.4g} waves per {per}, {line.amplitude:.2g} "
        f"{item.joint.effort_unit} high"
    )


def _describe_predictor(item: JointComparison) -> str | None:
    """What all that was measured predicts, where it is clearly more than single coordinates do."""
    structure = item.structure
    if structure is None or structure.best_predictor.share < THRESHOLDS.min_pattern_share:
        return None
    single = (*structure.shares, *structure.other_joints, *structure.motors)
    explained_share = max(structure.own_motion, *(share for _, share in single))
    if (
        explained_share > THRESHOLDS.min_pattern_share
        and structure.best_predictor.share < explained_share + THRESHOLDS.min_further_share
    ):
        return None
    name, coordinate = (
        structure.best_predictor.joint,
        structure.best_predictor.coordinate or "motion",
    )
    whose = f"joint {name}" if name else "the joints together"
    share = format_percent(structure.best_predictor.share)
    return f"{share} of that follows the {coordinate} of {whose}"


def _describe_repeatable(item: JointComparison) -> str | None:
    """The repeatable share, where it is more than the coordinates and the mean account for."""
    share, structure = compute_repeatable_share(item), item.structure
    explained_share = item.bias**2 / item.rms**2 + (
        structure.own_motion if structure is not None else 0.0
    )
    if (
        item.shares is None
        or item.shares.method == "smooth"
        or share
        < max(
            THRESHOLDS.min_pattern_share,
            explained_share + 0.1 if explained_share > THRESHOLDS.min_pattern_share else 0.0,
        )
    ):
        return None
    return {
        "laps": f"{format_percent(share)} of it returns in every lap",
        "logs": f"{format_percent(share)} of it returns in every log of this motion",
    }[item.shares.method]


def _describe_bias(item: JointComparison) -> str | None:
    if item.bias**2 < 2 * THRESHOLDS.min_pattern_share * item.rms**2:
        return None
    return f"the prediction is off by {item.bias:+.2g} {item.joint.effort_unit} on average"


def _describe_oscillation(item: JointComparison) -> str | None:
    spectrum = item.spectrum
    if spectrum is None or spectrum.peak_share < THRESHOLDS.min_line_share:
        return None
    # the lowest frequencies are slow patterns, named elsewhere, not oscillations
    if spectrum.peak <= 4 * spectrum.frequency[0] or 5 / spectrum.frequency.size > 0.1:
        return None
    return f"{format_percent(spectrum.peak_share)} of it oscillates near {spectrum.peak:.3g} Hz"


def _is_autocorrelated(item: JointComparison) -> bool:
    spectrum = item.spectrum
    return (
        spectrum is not None
        and spectrum.correlation_time > THRESHOLDS.max_noise_samples * spectrum.period
    )


def _describe_no_pattern(item: JointComparison) -> str:
    if item.structure is None:
        return f"too few samples ({item.samples}) to show whether the residual has structure"
    if _is_autocorrelated(item) and item.spectrum is not None:
        return (
            f"no function of its own motion or of time explains it, yet it is not noise: it stays "
            f"alike for {item.spectrum.correlation_time:.2g} s (look at other joints, flexibility, "
            "contact)"
        )
    return "the residual looks like noise"


def _describe_worst(item: JointComparison) -> str:
    window = item.worst
    text = f"the worst moment is {window.start:.2f}-{window.end:.2f} s of {window.log}"
    if (
        window.energy_share > THRESHOLDS.min_concentration * window.time_share
        and window.energy_share > 0.1
    ):
        text += (
            f", {format_percent(window.energy_share)} of the squared residual in "
            f"{format_percent(window.time_share)} of the time"
        )
    return text
