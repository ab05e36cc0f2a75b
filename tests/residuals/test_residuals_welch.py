"""Power densities of residuals against scipy's."""

import numpy as np
import pytest
from scipy.signal import welch as theirs

from modeler.numerics.spectra import estimate_welch_density


@pytest.mark.parametrize(
    ("samples", "length", "size"),
    [(5000, 512, 512), (700, 100, 256), (99, 99, 101), (64, 17, 17), (16, 16, 16)],
)
def test_it_is_that_of_scipy(samples: int, length: int, size: int) -> None:
    values = np.random.default_rng(samples).normal(size=samples) + 3.0
    _, density = theirs(values, fs=250.0, nperseg=length, nfft=size, detrend=False)
    assert estimate_welch_density(values, length, size, 1.0 / 250.0) == pytest.approx(
        density, rel=1e-9, abs=1e-15
    )
