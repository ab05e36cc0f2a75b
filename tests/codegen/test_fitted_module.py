"""The folder of a fitted model: manifest and signatures, names, C and C++ without a warning."""

import dataclasses
import json
import subprocess

from modeler.codegen.emit import emit
from modeler.codegen.functions import name_enumerators
from modeler.codegen.package import write_emitted
from modeler.core.manifest import parse_manifest
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import parse_robot_text
from modeler.runtime.model import load_folder
from tests.codegen.fitted_library import Functions, fitted_of, robot_module, robot_text, with_values
from tests.modules import STRICT, compiler

CPP = ["-x", "c++", "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]

CLASHING = robot_text("clashing")
"""Symbols that are called like macros and constants of the header; a joint with two ripples."""


def test_places_of_parameters_have_names_of_their_own(tmp_path):
    model = derive_model(parse_robot_text(CLASHING, "arm"))
    base = derive_base_parameters(model)
    emitted = emit(model, base, fitted_of(emit(model, base).spec))
    write_emitted(emitted, tmp_path)
    spec = emitted.spec
    beta = name_enumerators("arm", "beta", [each.name for each in spec.base])
    chi = name_enumerators("arm", "chi", [each.name for each in spec.standard])
    assert {"ARM_BETA_ZZ1R", "ARM_BETA_Rjc1_2"} <= {*beta} and "ARM_CHI_ZZ1" in chi
    checks = [
        f"typedef char check_{name}[{name} == {place} ? 1 : -1];"
        for names in (beta, chi)
        for place, name in enumerate(names)
    ]
    (tmp_path / "check.c").write_text("\n".join(['#include "arm.h"', *checks, ""]))
    for cc, flags in (("gcc", STRICT), ("g++", CPP)):
        units = [tmp_path / "check.c", tmp_path / "arm.c", tmp_path / "arm_fitted.c"]
        subprocess.run([compiler(cc), *flags, "-fsyntax-only", *units], check=True)


def test_values_hold_for_the_lengths_that_they_were_fitted_with(tmp_path):
    emitted = with_values("two-link")
    write_emitted(emitted, tmp_path)
    for unit, status in (("two_link.c", 0), ("two_link_fitted.c", 1)):
        command = [compiler("gcc"), "-std=c99", "-DTWO_LINK_GEO_L1=0.41", "-fsyntax-only"]
        done = subprocess.run([*command, tmp_path / unit], capture_output=True, text=True)
        assert done.returncode == status
    assert "TWO_LINK_GEO_L1: the values were fitted with another; fit again" in done.stderr


def test_the_manifest_has_the_values_and_the_robots_signature(tmp_path):
    """The plain module is in it, letter by letter, and known by the same signature."""
    plain, emitted = robot_module("two-link").emitted, with_values("two-link")
    write_emitted(emitted, tmp_path)
    assert load_folder(tmp_path).spec == emitted.spec
    text = emitted.files["manifest.json"]
    assert parse_manifest(text, "here") == emitted.spec
    assert emitted.spec.compute_signature() == plain.spec.compute_signature()
    assert all(emitted.files[name] == plain.files[name] for name in plain.spec.sources)
    raw, before = json.loads(text), json.loads(plain.files["manifest.json"])
    fitted = raw.pop("fitted")
    assert raw == before
    assert fitted["parameters"][0] == {
        "name": "ZZ1R",
        "unit": "kg m2",
        "value": emitted.spec.fitted.parameters[0].value,
        "sigma": 0.1,
        "essential": True,
    }
    assert len(fitted["functions"]) == 5
    assert not any(a["name"] == "beta" for f in fitted["functions"] for a in f["inputs"])


def test_the_c_has_the_signature_of_its_values_and_the_gains_of_drives():
    """Where every joint has one; another last digit or another verdict is another signature."""
    plain = fitted_of(robot_module("two-link").emitted.spec)
    some = dataclasses.replace(plain, gains=(12.5, 0.75))
    last = some.parameters[-1]
    nudged = dataclasses.replace(last, value=last.value * (1 + 2e-16) + 1e-16)
    assert nudged.value != last.value
    other = dataclasses.replace(some, parameters=(*some.parameters[:-1], nudged))
    doubted = dataclasses.replace(some, valid=False, verdict="not usable: no")
    made = [with_values("two-link", each) for each in (some, other, doubted, some)]
    signatures = [each.spec.fitted.signature for each in made]
    assert len(set(signatures)) == 3 and signatures[0] == signatures[3]
    assert made[0].files == made[3].files
    functions = Functions(made[0])
    assert functions.text("fitted_signature") == signatures[0]
    assert functions.text("signature") == made[0].spec.compute_signature()
    assert functions.numbers("drive_gain", 2).tolist() == [12.5, 0.75]
    assert "drive_gain" not in with_values("two-link", plain).files["two_link_fitted.h"]
