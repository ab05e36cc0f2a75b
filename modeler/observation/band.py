"""How fast the motion is, and the cut-offs that follow from it."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.core.contract import JointSpec
from modeler.observation.motion import HIGHEST
from modeler.observation.motion_band import MotionBands, motion_bands
from modeler.observation.processing import Processing
from modeler.observation.ringing import Ringing, ringing
from modeler.observation.segments import Piece
from modeler.observation.spectrum import Spectrum, spectrum
from modeler.observation.weighted_median import weighted_median

POSITION_BANDS = 25.0
LEAST_POSITION = 30.0  # Hz
ENOUGH_POSITION = 100.0  # Hz; above it only 5 bands are kept: the rest would be noise
PARALLEL_BANDS = 4.0
LEAST_PARALLEL = 5.0  # Hz

_TOLD = 2.0  # times the band is what trembling would have made of it, or nothing is said


@dataclasses.dataclass(frozen=True)
class JointMotion:
    """What one joint does in all logs.

    Attributes:
        name: joint.
        unit: of its position, rad or m.
        moves: False at rest.
        band: Hz below which 99 % of its velocity's energy lies; 0 at rest.
        shaken: Hz, the same with all that is not white noise.
        trembling: rms of the position that is not motion, rad or m.
    """

    name: str
    unit: str
    moves: bool
    band: float
    shaken: float
    trembling: float

    def trembles(self) -> str:
        """A sentence on what was left out."""
        return (
            f"joint {self.name}: its position trembles by {1e3 * self.trembling:.2g} m{self.unit} "
            f"up to {self.shaken:.3g} Hz, beside a motion of up to {self.band:.3g} Hz: noise of "
            "its sensor, or a controller that shakes it; the cut-offs are chosen without it, but "
            "look at both"
        )


def joint_motions(
    joints: Sequence[JointSpec], pieces: Sequence[Piece], spectra: Sequence[Spectrum]
) -> tuple[JointMotion, ...]:
    """What each joint does: medians over the pieces in which it moves, by their lengths.

    Args:
        joints: of the robot.
        pieces: of all logs.
        spectra: of their positions.
    """
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    found = [motion_bands(*pair) for pair in zip(pieces, spectra, strict=True)]
    return tuple(_joint_motion(joint, j, found, lengths) for j, joint in enumerate(joints))


def _joint_motion(
    joint: JointSpec, j: int, found: Sequence[MotionBands], lengths: np.ndarray
) -> JointMotion:
    values = np.array([(own.band[j], own.shaken[j], own.trembling[j]) for own in found])
    moves = np.isfinite(values[:, 0])
    kept, weights = (values[moves], lengths[moves]) if moves.any() else (values, lengths)
    band, shaken, trembling = (weighted_median(column, weights) for column in kept.T)
    if not moves.any():
        band = 0.0
    return JointMotion(joint.name, joint.unit, bool(moves.any()), band, shaken, trembling)


def shown_band(motions: Sequence[JointMotion], pieces: Sequence[Piece]) -> float:
    """Hz of the fastest joint, as the window of a piece shows it: 2/T at least."""
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    return float(np.hypot(max(m.band for m in motions), 2.0 / weighted_median(lengths, lengths)))


def spectra_of(pieces: Sequence[Piece]) -> list[Spectrum]:
    """The spectrum of each piece's positions."""
    return [spectrum(piece.q, piece.step) for piece in pieces]


def what_rings(spectra: Sequence[Spectrum]) -> list[Ringing]:
    """Joints that ring in the longest of some pieces."""
    if not spectra:
        return []
    longest = max(spectra, key=lambda own: len(own.frequency))
    speed = longest.above * longest.frequency[:, None] ** 2
    found = [ringing(longest.frequency, own, j)[0] for j, own in enumerate(speed.T)]
    return [ring for ring in found if ring is not None]


def choose_cutoffs(
    processing: Processing, pieces: Sequence[Piece], motions: Sequence[JointMotion]
) -> tuple[Processing, tuple[str, ...]]:
    """The processing with both cut-offs chosen, and a sentence for each choice.

    The motion band is that of the fastest joint. Position filter: 25 times the motion band within
    30 to 100 Hz, never less than 5 times, at most 0.4 of the sampling rate; a filter too close to
    the motion looks like a flexible joint. Parallel filter: 4 times the motion band, at least 5 Hz,
    at most half the position filter. The EMPS benchmark, whose authors chose 100 Hz and 16 Hz by
    hand, comes out at 90 Hz and 14 Hz.

    Args:
        processing: what is given is kept.
        pieces: of all logs.
        motions: of the joints.
    """
    fastest = max(motions, key=lambda motion: motion.band)
    band = fastest.band
    rate = 1.0 / float(np.median([piece.step for piece in pieces]))
    slowest = 1.0 / max(piece.step for piece in pieces)
    shown = (
        f"{band:.3g} Hz" if band else "of less than the pieces of motion are long enough to show"
    )
    said = [f"motion band {shown} (99 % of the velocity's energy), sampled at {rate:.4g} Hz"]
    said += _at_rest(motions)
    position = processing.position_cutoff
    logged = all(piece.qdd is not None for piece in pieces)
    unused = " (not needed: accelerations are logged)" if logged else ""
    if position is None:
        wanted = max(LEAST_POSITION, min(POSITION_BANDS * band, ENOUGH_POSITION), 5.0 * band)
        position = _two_digits(min(wanted, HIGHEST * slowest))
        said.append(
            f"position filter {position:g} Hz{unused}: {POSITION_BANDS:g} x the band within "
            f"{LEAST_POSITION:g} to {ENOUGH_POSITION:g} Hz, never less than 5 x, at most "
            f"{HIGHEST:g} of the sampling rate"
        )
    if not logged and 0.0 < position < 5.0 * band:
        said.append(
            f"position filter {position:g} Hz is less than 5 x the motion band of joint "
            f"{fastest.name}, {band:.3g} Hz: accelerations are damped; {_remedy(processing)}"
        )
    parallel = processing.parallel_cutoff
    if parallel is None:
        highest = 0.5 * (position or HIGHEST * slowest)
        parallel = _two_digits(min(max(LEAST_PARALLEL, PARALLEL_BANDS * band), highest))
        said.append(
            f"parallel filter {parallel:g} Hz: {PARALLEL_BANDS:g} x the band, at least "
            f"{LEAST_PARALLEL:g} Hz, at most half the position filter"
        )
    own = [n for n in ("position_cutoff", "parallel_cutoff") if getattr(processing, n) is None]
    chosen = dataclasses.replace(
        processing,
        position_cutoff=position,
        parallel_cutoff=parallel,
        chosen=(*processing.chosen, *own),
    )
    return chosen, tuple(said)


def _at_rest(motions: Sequence[JointMotion]) -> list[str]:
    rest = [motion.name for motion in motions if not motion.moves]
    if not rest or len(rest) == len(motions):
        return []
    some = len(rest) > 1
    return [
        f"joint{'s' if some else ''} {', '.join(rest)} rest{'' if some else 's'}: "
        "not counted in the motion band"
    ]


def what_trembles(motions: Sequence[JointMotion]) -> tuple[str, ...]:
    """A sentence on each joint that would have made the motion look twice as fast as it is."""
    fast = _TOLD * max(LEAST_PARALLEL / PARALLEL_BANDS, *(motion.band for motion in motions))
    return tuple(motion.trembles() for motion in motions if motion.moves and motion.shaken > fast)


def _remedy(processing: Processing) -> str:
    if processing.position_cutoff is not None:
        return "give a higher --cutoff, or leave it out"
    return "sample faster or move slower"


def _two_digits(value: float) -> float:
    return float(f"{value:.2g}")
