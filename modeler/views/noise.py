"""The noise of the motion as a picture: where it exceeds the motion, and the torques."""

import numpy as np

from modeler.core import figure as fig
from modeler.regression import Bands, ChannelNoise
from modeler.views import page
from modeler.views.thresholds import THRESHOLDS

_ROW = 210  # pixels

_POWER = {"positions": 4, "speeds": 2, "accelerations": 0}
_SPECTRUM, _FLOOR, _MEETS = (
    fig.Style(fig.BLUE, 1.6),
    fig.Style(fig.ORANGE, 1.6),
    fig.Style(fig.SLATE, 1.2, dash=True),
)
_TORQUE, _OF_NOISE = fig.Style(fig.GREEN, 1.6), fig.Style(fig.VERMILLION, 1.6)
_POSITION, _PARALLEL = fig.Style(fig.PINK, 1.4), fig.Style(fig.BLACK, 1.4)


def build_noise_blocks(bands: Bands | None) -> list[page.Block]:
    """Returns how the cut-offs were chosen, and the picture; nothing where nothing moves."""
    picture = draw_noise_picture(bands)
    if bands is None or picture is None:
        return []
    said = [page.Items([("", line) for line in bands.reasons])] if bands.reasons else []
    return [*said, page.Figure(picture, titled=False)]


def draw_noise_picture(bands: Bands | None) -> fig.Picture | None:
    """Draws spectrum and noise floor of each moving joint, and its torque noise if fitted."""
    moving = [one for one in bands.noise if one.is_moving and any(one.spectrum)] if bands else []
    if bands is None or not moving:
        return None
    fitted = any(one.torque_noise for one in moving)
    rows = tuple(
        (_build_motion_panel(one, bands), *[_build_torque_panel(one, bands)] * fitted)
        for one in moving
    )
    caption = _write_caption(bands, moving[0].quantity, fitted)
    height = 60 + _ROW * len(rows)
    return fig.Picture("noise_of_the_motion", "Noise of the motion", caption, rows, height)


def _build_motion_panel(one: ChannelNoise, bands: Bands) -> fig.Panel:
    """Its spectrum, and the floor that it meets."""
    f, S = np.array(one.frequency), np.array(one.spectrum)
    f, S = f[S > 0.0], S[S > 0.0]
    ends = min(S.min(initial=np.inf), one.density or np.inf), S.max(initial=one.density)
    series: list[fig.Series] = [fig.Curve(f"spectrum of the {one.quantity}", f, S, _SPECTRUM)]
    if one.density and one.noise_crossover_hz:
        along = np.array([one.noise_crossover_hz, f[-1]])
        series.append(fig.Curve("floor: its noise", along, np.full(2, one.density), _FLOOR))
        series.append(
            _build_vertical_curve(
                "the noise exceeds the motion", one.noise_crossover_hz, ends, _MEETS
            )
        )
    band = np.array([[min(f[0], one.band_hz) / 2.0, one.band_hz]])
    colour = f", noise of f^-{one.spectral_slope:.1f}" if one.spectral_slope else ""
    unit = {4: one.unit, 2: f"({one.unit}/s)", 0: f"({one.unit}/s2)"}[_POWER[one.quantity]]
    title, label = f"Joint {one.joint}: {one.quantity}{colour}", f"density [{unit}^2/Hz]"
    spans = (fig.Span("motion band", band, fig.PALE["blue"]),) if one.band_hz else ()
    every = (*series, *_build_cutoff_curves(bands, ends))
    return fig.Panel(title, "frequency [Hz]", label, every, "log", spans=spans)


def _build_torque_panel(one: ChannelNoise, bands: Bands) -> fig.Panel:
    """A f^p, p = 4 of positions, against the level of the torque."""
    A, T, power = one.noise_torque, one.torque_noise, _POWER[one.quantity]
    if not A or not T or not power:  # without a motor or rows, or with exact accelerations
        return fig.Panel("", "", "", ())
    f, cross, factor = (
        one.frequency,
        (T / A) ** (1.0 / power),
        10.0 ** (THRESHOLDS.noise_line_decades / power),
    )
    high = min(f[-1], cross * factor)
    along = np.geomspace(max(f[0], min(cross, high) / factor), high, 20)
    noise = A * along**power
    ends = (
        min(noise[0], T / THRESHOLDS.noise_level_factor),
        max(noise[-1], T * THRESHOLDS.noise_level_factor),
    )
    label = f"density [({'N' if one.unit == 'm' else 'N m'})^2/Hz]"
    title = f"Joint {one.joint}: torques{', which limits' * (one.joint == bands.limiting_joint)}"
    level = fig.Curve("noise of the torque", np.array([f[0], f[-1]]), np.full(2, T), _TORQUE)
    curves = (
        fig.Curve("torque of that noise", along, noise, _OF_NOISE),
        level,
        *_build_cutoff_curves(bands, ends),
    )
    return fig.Panel(title, "frequency [Hz]", label, curves, "log")


def _build_cutoff_curves(bands: Bands, ends: tuple[float, float]) -> list[fig.Curve]:
    both = (
        ("position filter", bands.position_cutoff, _POSITION),
        ("parallel filter", bands.parallel_cutoff, _PARALLEL),
    )
    return [_build_vertical_curve(label, at, ends, style) for label, at, style in both if at]


def _build_vertical_curve(
    label: str, at: float, ends: tuple[float, float], style: fig.Style
) -> fig.Curve:
    return fig.Curve(label, np.full(2, at), np.array(ends), style)


def _write_caption(bands: Bands, of: str, fitted: bool) -> str:
    text = (
        f"Power density of the {of} (blue, means over third octaves) and the floor that it meets, "
        "the noise of the sensor (orange); above the dashed line it exceeds the motion. The band "
        "of the motion, with 99 % of the velocity's energy, is pale blue."
    )
    if bands.position_cutoff:
        text += " Cut-off of the position filter: pink; of the parallel filter: black."
    if fitted:
        text += (
            f" On the right the same noise as torque, A f^{_POWER[of]} through the inertia matrix "
            "(dark orange), and the noise of the torque itself (green): above their crossing the "
            "sensor is what is seen. The parallel filter lies no higher than the first crossing of "
            "all joints, unless that is below twice the motion band; the lines above say why."
        )
    if bands.chatter_ratio:
        text += (
            " Here it was lowered further: behind wider filters the model's torque has "
            f"{bands.chatter_ratio:.2g} times the high-frequency content of the measured one."
        )
    return text


# What is in a log, as pictures and as a page.
