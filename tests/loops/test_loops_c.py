"""The emitted C of robots with loops, in a program under sanitizers."""

import subprocess

import numpy as np
import pytest

from modeler.codegen.package import write_emitted
from tests.loops.closed_states import closed
from tests.modules import compiler, module, plain

PROGRAM = """
#include <stdio.h>
#include "five_bar.h"

int main(void)
{
    const double far[2] = {1.0, 40.0}, qd[2] = {0.5, -0.3}, qdd[2] = {1.0, 2.0};
    double q[2], u[FIVE_BAR_FREE_VARIABLES], beta[FIVE_BAR_BASE_PARAMETERS], tau[2];
    int status;

    for (int i = 0; i < FIVE_BAR_BASE_PARAMETERS; i++)
        beta[i] = 0.1 * (i + 1);
    if (scanf("%lf %lf", &q[0], &q[1]) != 2)
        return 2;
    status = five_bar_close(q, u);
    status += five_bar_close_from(q, u, u);    /* a controller: from where it was */
    status += five_bar_inverse_dynamics(q, qd, qdd, beta, tau);
    printf("%d %.17g %.17g\\n", status, tau[0], tau[1]);
    tau[0] = 0.0;
    status = five_bar_inverse_dynamics(far, qd, qdd, beta, tau);
    printf("%d %d\\n", status != 0, tau[0] != tau[0]);
    return 0;
}
"""


def test_a_program_closes_the_loop_under_sanitizers(tmp_path):
    write_emitted(module("five-bar").emitted, tmp_path)
    (tmp_path / "main.c").write_text(PROGRAM, encoding="utf-8")
    sources = sorted(str(path) for path in tmp_path.glob("*.c"))
    command = [
        compiler("gcc"), "-std=c99", "-g", "-fsanitize=address,undefined",
        "-fno-sanitize-recover=all", "-I", str(tmp_path), *sources, "-lm",
        "-o", str(tmp_path / "main"),
    ]  # fmt: skip
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    if "cannot find" in built.stderr and "san" in built.stderr:
        pytest.skip("NOT CHECKED: gcc has no sanitizer libraries")
    assert built.returncode == 0, built.stderr
    (q, _, _), _, _ = closed("five-bar", 1)
    told = subprocess.run(
        [tmp_path / "main"], input=f"{q[0, 0]:.17g} {q[0, 1]:.17g}",
        capture_output=True, text=True, check=True,
    ).stdout.split()  # fmt: skip
    c = plain("five-bar")
    beta = 0.1 * np.arange(1, len(c.spec.base) + 1)
    expected = c.inverse_dynamics(q, [[0.5, -0.3]], [[1.0, 2.0]], beta)[0]
    assert told[0] == "0" and told[3:] == ["1", "1"]
    np.testing.assert_allclose([float(told[1]), float(told[2])], expected, rtol=1e-12)
