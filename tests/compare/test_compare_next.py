"""The command after `compare` runs as it stands, wherever the logs lie."""

import shlex

from modeler.cli import main


def test_the_next_line_names_the_log_of_the_fit_by_its_path(tmp_path, capsys, monkeypatch) -> None:
    (tmp_path / "in").mkdir()
    monkeypatch.chdir(tmp_path / "in")
    for seed in (1, 2):
        words = f"simulate two-link --duration 4 --seed {seed} --out ../{seed}.parquet"
        assert main(words.split()) == 0
    assert main(["fit", "two-link", "../1.parquet", "--out", "m.json"]) == 0

    def following(words: str) -> list[str]:
        capsys.readouterr()
        assert main(words.split()) == 0
        return shlex.split(capsys.readouterr().out.splitlines()[-1])

    said = following("compare m.json ../2.parquet")
    if "diagnose" in said:
        assert said[4] == "../1.parquet"
    from modeler.api import open_model

    (log,) = open_model("m.json").logs
    assert log.place(".") == "../1.parquet"
    monkeypatch.chdir(tmp_path)
    assert log.place("in") == "in/../1.parquet"
    (tmp_path / "1.parquet").unlink()
    assert log.place("in") == ""
