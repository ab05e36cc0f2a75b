"""From a built-in robot to a mailed model file that compiles again."""

import numpy as np
from test_observation_rows import exact_log, some_beta

from modeler.codegen.emit import emit
from modeler.derivation.base_parameters import base_parameters
from modeler.derivation.derive import derive_model
from modeler.estimation.identify import identify
from modeler.estimation.model_file import IdentifiedModel, load_model, provenance, save_model
from modeler.observation.observation import observe
from modeler.robot.read import read_robot
from modeler.runtime.model import load


def test_a_saved_model_compiles_and_predicts_the_same(tmp_path):
    robot = read_robot("two-link")
    symbolic = derive_model(robot)
    emitted = emit(symbolic, base_parameters(symbolic))
    compiled = load(emitted.spec, emitted.files)
    beta = some_beta(compiled)
    log = exact_log(compiled, beta)
    seen = observe(compiled, [log])
    fit = identify(seen)
    np.testing.assert_allclose(fit.beta, beta, rtol=1e-6)
    path = tmp_path / "arm.model"
    save_model(path, IdentifiedModel(robot.text, emitted.spec, emitted.files, fit,
                                     provenance(seen.report)))  # fmt: skip
    again = load_model(path)
    torque = again.compile().inverse_dynamics(log.q, log.qd, log.qdd, again.beta)
    np.testing.assert_allclose(torque, log.tau, atol=1e-6)
