"""Captions name colours that are there; what is shaded does not count."""

import dataclasses

import numpy as np
import pytest
from known_defects import first_joint, prediction

from modeler.core.figure import Band
from modeler.observation.observation import MASKS
from modeler.report.comparison import all_pictures
from modeler.report.figure_matplotlib import images
from modeler.report.figure_page import Numbers, drawn, keys, picture_csv
from modeler.validation.comparison import Comparison, compare
from modeler.validation.pictures import overlay_picture
from modeler.validation.prediction import Prediction
from modeler.validation.time_picture import masked_spans, time_picture
from tests.captions import assert_named, colours_drawn, colours_said


def masked() -> Prediction:
    """Every reason on joint 1, a gap in the first log, and a band."""
    whole = prediction(lambda q, qd, qdd, tau, t: 0.5 * qd, rows=4800)
    masks = np.full(whole.used.shape, -1, dtype=np.int8)
    for k in range(len(MASKS)):
        masks[400 * k + 100 : 400 * k + 160, 0] = k
    used = masks < 0
    used[2200:2250, 0] = False  # for no reason of its own
    segment = whole.segment.copy()
    segment[1500:] += 1
    time = whole.time.copy()
    time[1500:] += 0.7
    sigma = 0.05 + 0.02 * np.abs(whole.qd)
    return dataclasses.replace(
        whole, masks=masks, used=used, segment=segment, time=time, sigma=sigma
    )


@pytest.fixture(scope="module")
def made() -> Prediction:
    return masked()


@pytest.fixture(scope="module")
def compared(made: Prediction) -> Comparison:
    return compare(made)


def test_every_picture_names_colours_that_are_there(compared: Comparison) -> None:
    plain = compare(first_joint(prediction(rows=900)))
    heated = first_joint(prediction(rows=900))
    heat = 20.0 + heated.time[:, None]
    for whole in (compared, plain, compare(dataclasses.replace(heated, temperature=heat))):
        for picture in all_pictures(whole):
            assert_named(picture)


def test_several_models_are_named_by_their_colours(made: Prediction) -> None:
    others = [dataclasses.replace(made, predicted=made.predicted + k) for k in range(3)]
    picture = overlay_picture(["a", "b", "c"], others, 0)
    assert colours_said(picture) == colours_drawn(picture)
    assert all(name in picture.caption for name in ("a", "b", "c"))


def test_what_is_shaded_is_what_does_not_count(made: Prediction) -> None:
    rows = np.arange(made.time.size)
    spans = {span.label: span.ends for span in masked_spans(made, 0, made.time, rows)}
    assert set(spans) == {*MASKS, "no rows", "left out"}
    shaded = np.zeros(made.time.size, dtype=bool)
    for label, ends in spans.items():
        for start, end in ends:
            shaded |= (made.time > start) & (made.time < end) & (label != "no rows")
    np.testing.assert_array_equal(shaded, ~made.used[:, 0])
    for k, name in enumerate(MASKS):
        (start, end) = spans[name][0]
        assert made.time[400 * k + 100] - start == pytest.approx(0.005)
        assert end - made.time[400 * k + 159] == pytest.approx(0.005)
    gap = spans["no rows"]
    assert gap.shape == (1, 2) and np.ptp(gap) == pytest.approx(0.7)
    assert masked_spans(made, 1, made.time, rows)[0].label == "no rows"  # all rows of joint 2 count


def test_both_drawers_draw_what_is_shaded_and_the_band(
    made: Prediction, compared: Comparison
) -> None:
    picture = time_picture(made, compared.joints[0])
    whole, worst = picture.panels[0]
    band = next(s for s in worst.series if isinstance(s, Band))
    assert not any(isinstance(s, Band) for s in whole.series)
    labels = {label: (color, mark) for label, color, mark in keys(picture)}
    for span in whole.spans:
        assert labels[span.label] == (span.color, "span")
    plain = drawn(picture, Numbers())
    assert {color for color, _ in plain["rows"][0][0]["spans"]} == {s.color for s in whole.spans}
    assert any(series["kind"] == "band" for series in plain["rows"][0][1]["series"])
    svg = images(picture)["svg"].decode()
    for span in whole.spans:
        assert span.color.lower() in svg.lower() and span.label in svg
    assert band.label in svg and f"{band.label}," in picture_csv(picture)


def test_the_band_is_two_deviations_of_the_prediction(
    made: Prediction, compared: Comparison
) -> None:
    item = compared.joints[0]
    worst = time_picture(made, item).panels[0][1]
    band = next(s for s in worst.series if isinstance(s, Band))
    at = np.searchsorted(made.time, band.x)
    np.testing.assert_allclose(band.high - band.low, 4.0 * made.sigma[at, 0], rtol=1e-9)
    middle = 0.5 * (band.high + band.low)
    np.testing.assert_allclose(middle, made.predicted[at, 0], atol=1e-9)
    rows = made.used[:, 0]
    rms = float(np.sqrt(np.mean(made.sigma[rows, 0] ** 2)))
    assert item.predicted_sigma == pytest.approx(rms)
    assert compared.to_json()["joints"]["1"]["predicted_sigma"] == pytest.approx(rms)
