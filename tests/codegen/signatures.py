"""Prints the signatures of robots as JSON: `python signatures.py ROBOT...`, a file or a name."""

import json
import sys

from modeler.codegen.emit import emit
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import read_robot

if __name__ == "__main__":
    table = {}
    for name in sys.argv[1:]:
        model = derive_model(read_robot(name))
        table[name] = emit(model, derive_base_parameters(model)).spec.compute_signature()
    print(json.dumps(table))
