"""Prints the signatures of robots as JSON: `python signatures.py ROBOT...`, a file or a name."""

import json
import sys

from modeler.base import base_parameters
from modeler.codegen import emit
from modeler.robot import read_robot
from modeler.symbolic import derive_model

if __name__ == "__main__":
    found = {}
    for name in sys.argv[1:]:
        model = derive_model(read_robot(name))
        found[name] = emit(model, base_parameters(model)).spec.signature()
    print(json.dumps(found))
