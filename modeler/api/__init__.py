"""All of modeler from Python: a robot, its parameters, its C, a model from logs, what it lacks.

    from modeler.api import add_all, compare, compile_model, derive, diagnose, fit, generate, load
    from modeler.api import observe, simulate

    robot = load("emps")                               # a file, or the name of a built-in robot
    derivation = derive(robot)                         # base parameters, exactly
    emitted = generate(derivation, "emps_c")           # C, header, manifest, build files
    compiled = compile_model(emitted)
    observation = observe(compiled, ["train.parquet"])
    model = fit(derivation, emitted, observation)
    print(compare(model, ["pulses.parquet"]).summary())

Every result has a short `repr`, a `summary()`, its tables (`table(name)`, `to_frame(name)`), most a
figure (`plot(name)`), and HTML for a notebook; docs/reference/python.md lists them. Functions
that a stage has too are that stage's, with the usual choices; use the stages for others.
"""

import lazy_loader

from modeler.views import notebook

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

notebook.register_report_modules()
