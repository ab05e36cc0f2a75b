"""The residuals of several models over each other, and who gains where."""

from collections.abc import Sequence

import numpy as np

from modeler.compare.masked import masked_spans, told_masks
from modeler.compare.prediction import Prediction, residual
from modeler.compare.time_picture import broken, running_time
from modeler.pictures.picture import COLORS, Curve, Panel, Picture, Style
from modeler.pictures.thinning import thin_curves

_MOST = 2500  # points of a curve


def overlay_picture(names: Sequence[str], predictions: Sequence[Prediction], j: int) -> Picture:
    """One joint: residuals of all models against time, and their sums of squares so far.

    Args:
        names: of the models.
        predictions: of each, on the same rows.
        j: index of the joint.
    """
    first, joint = predictions[0], predictions[0].joints[j]
    time, label, marks = running_time(first)
    left = tuple(residual(prediction)[:, j] for prediction in predictions)
    sums = [np.cumsum(np.nan_to_num(e) ** 2) for e in left]
    whole = max(float(total[-1]) for total in sums) or 1.0
    kept, segment = thin_curves(left, _MOST), first.segment
    even = np.unique(np.linspace(0, time.size - 1, _MOST // 2).astype(int))
    styles = [Style(COLORS[k % len(COLORS)], width=1.1, opacity=0.8) for k in range(len(names))]
    residuals, gains = [], []
    for name, style, e, total in zip(names, styles, left, sums, strict=True):
        residuals.append(Curve(name, *broken(segment[kept], time[kept], e[kept]), style))
        gains.append(Curve(name, time[even], 100.0 * total[even] / whole, style))
    spans = masked_spans(first, j, time, np.arange(time.size))
    return Picture(
        name=f"joint_{joint.name}_models",
        title=f"Joint {joint.name}: what each model leaves",
        caption=_caption(names, styles, told_masks(first, j)),
        panels=(
            (Panel("Residual", label, f"residual [{joint.effort_unit}]", tuple(residuals),
                   marks=marks, zero=True, spans=spans),),
            (Panel("Squared residual so far", label, "sum [%]", tuple(gains), marks=marks),),
        ),
        heights=(0.6, 0.4),
        widths=(1.0,),
        height=430,
        shared_time=True,
    )  # fmt: skip


def _caption(names: Sequence[str], styles: Sequence[Style], masks: str) -> str:
    pairs = zip(names, styles, strict=True)
    said = ", ".join(f"{style.named.capitalize()}: {name}" for name, style in pairs)
    return (
        f"{said}. Below: the squared residual summed up to that time, in percent of the largest "
        f"sum at the end; where one curve is steeper, that model is worse there. {masks}"
    ).strip()
