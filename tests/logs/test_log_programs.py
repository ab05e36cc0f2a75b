"""Logs as programs write them give the fit of a plain file with the same numbers."""

import pytest

from tests.logs.programs import KINDS
from tests.logs.writers import parquet


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_gives_the_fit_of_the_plain_file(name, case, tmp_path):
    kind = KINDS[name]
    (tmp_path / "run").mkdir()
    place = kind.write(tmp_path / "run", case.table)
    beta = case.beta
    if kind.twin:
        more = {own: values(case.table) for own, values in kind.twin.items()}
        plain = parquet(tmp_path / "plain.parquet", dict(case.table) | more)
        beta = case.fitted(plain, ())
    found = case.fitted(place, kind.words)
    assert found == pytest.approx(
        beta, rel=1e3 * kind.digits, abs=1e3 * kind.digits * abs(beta).max()
    )
