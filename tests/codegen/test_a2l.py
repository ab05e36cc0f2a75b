"""The description of the parameter set: where the compiler puts what it names; a reader's word."""

import re
import subprocess

import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.modules import compiler
from tests.rotation import rotating

_BLOCK = re.compile(
    r'/begin (CHARACTERISTIC|MEASUREMENT) (\w+)\n\s+"(.*)"\n\s+(.*)\n(?:\s+ECU_ADDRESS 0x0\n)?'
    r'\s+SYMBOL_LINK "(\w+)" (\d+)\n\s+/end \1\n'
)


def described(name: str, precision="double", fitted: bool = False):
    made = robot_module(name)
    values = fitted_of(made.emitted.spec) if fitted else None
    return emit(made.model, made.base, values, precision, control=Control(a2l=True))


@pytest.mark.parametrize(
    ("name", "precision"),
    [("two-link", "double"), ("two-link", "single"), *rotating(("five-bar", "double"))],
)
def test_offsets_are_those_of_the_compiler(name: str, precision, tmp_path) -> None:
    emitted = described(name, precision)
    prefix, spec = emitted.spec.prefix, emitted.spec
    described_at = {at[2]: int(at[6]) for at in _BLOCK.finditer(emitted.files[f"{prefix}.a2l"])}
    write_emitted(emitted, tmp_path)
    widths = [n.removeprefix(f"{prefix}_width_") for n in described_at if f"{prefix}_width_" in n]
    places = {f"{prefix}_beta_{base.name}": f"beta[{k}]" for k, base in enumerate(spec.base)}
    places |= {f"{prefix}_width_{joint}": f"widths[{k}]" for k, joint in enumerate(widths)}
    places |= {f"{prefix}_signature_{k + 1}": f"signature[{k}]" for k in (0, 1)}
    places[f"{prefix}_checksum"] = "checksum"
    lines = [f'printf("{n} %zu\\n", offsetof({prefix}_set, {at}));' for n, at in places.items()]
    (tmp_path / "at.c").write_text(
        f'#include <stddef.h>\n#include <stdio.h>\n#include "{prefix}_control.h"\n'
        f"int main(void) {{ {' '.join(lines)} return 0; }}\n"
    )
    subprocess.run([compiler("gcc"), "at.c", "-o", "at"], cwd=tmp_path, check=True)
    said = subprocess.run([tmp_path / "at"], capture_output=True, text=True, check=True).stdout
    assert {n: int(at) for n, at in (line.split() for line in said.splitlines())} == described_at
    assert len(widths) == (2 if name == "two-link" else 0)


@pytest.mark.rotating("readers of standards")
def test_a_reader_of_the_standard_finds_names_units_and_limits(tmp_path, capfd) -> None:
    pya2l = pytest.importorskip("pya2l", reason="pya2ldb reads A2L: pip install pya2ldb")
    from pya2l import model

    emitted = described("emps", fitted=True)
    (tmp_path / "arm.a2l").write_text(emitted.files["emps.a2l"])
    read = pya2l.import_a2l(str(tmp_path / "arm.a2l"), in_memory=True)
    said = "".join(capfd.readouterr())
    assert "[error]" not in said and "[warning]" not in said, said
    numbers = {each.name: each for each in read.query(model.Characteristic).all()}
    units = {each.name: each.unit for each in read.query(model.CompuMethod).all()}
    assert len(numbers) == len(emitted.spec.base) + 1
    for base in emitted.spec.base:
        number = numbers[f"emps_beta_{base.name}"]
        assert units[number.conversion] == base.unit and number.type == "VALUE"
        assert number.symbol_link.symbolName == "emps_parameters"
        assert (float(number.lowerLimit) == 0.0) == (base.name[:2] in ("Fv", "Fs")), base.name
    assert {each.datatype for each in read.query(model.Measurement).all()} == {"ULONG"}
    read.close()
    broken = emitted.files["emps.a2l"].replace("VALUE 0x0 ", "VALUE ")
    (tmp_path / "broken.a2l").write_text(broken)
    pya2l.import_a2l(str(tmp_path / "broken.a2l"), in_memory=True).close()
    assert "[error]" in "".join(capfd.readouterr())  # it does show
