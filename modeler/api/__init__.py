"""All of modeler from Python: a robot, its parameters, its C, a model from logs, what it lacks.

    from modeler.api import auto, compare, compile_model, derive, diagnose, fit, generate, load
    from modeler.api import observe, simulate

    robot = load("emps")                               # a file, or the name of a built-in robot
    derivation = derive(robot)                         # base parameters, exactly
    emitted = generate(derivation, "emps_c")           # C, header, manifest, build files
    compiled = compile_model(emitted)
    observation = observe(compiled, ["train.parquet"])
    model = fit(derivation, emitted, observation)
    print(compare(model, ["pulses.parquet"]).summary())

Every result has a short `repr`, a `summary()`, its tables (`table(name)`, `to_frame(name)`), most a
figure (`plot(name)`), and HTML for a notebook; docs/python.md lists them. The functions of a name
that a stage has too are that stage's, with the usual choices; use the stages for others.
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from modeler.report import notebook

_FIRST = {
    **dict.fromkeys(("load", "own_effect", "derive", "generate", "compile_model"), "workflow"),
    **dict.fromkeys(("read_logs", "observe", "recompile"), "workflow"),
    "fit": "fitting",
}
"""What a script begins with; the rest takes longer to load. By module."""

if TYPE_CHECKING:
    from modeler.api.entries import *  # noqa: F403
else:

    def __getattr__(name: str) -> Any:
        """One of `entries`, kept once it was asked for."""
        if name in _FIRST:
            import modeler.api.arguments as door

            found = door.checked(getattr(import_module(f"modeler.api.{_FIRST[name]}"), name))
        elif name == "__all__":
            found = _offered()
        elif name.startswith("__"):
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        else:
            import modeler.api.entries as entries

            found = getattr(entries, name)
        globals()[name] = found
        return found

    def _offered() -> list[str]:
        """What `from modeler.api import *` brings: all that `entries` offers."""
        import modeler.api.entries as entries

        names = vars(entries).items()
        return sorted(n for n, it in names if n[0] != "_" and not isinstance(it, ModuleType))

    def __dir__() -> list[str]:
        import modeler.api.entries as entries

        return sorted({*globals(), *vars(entries)})


notebook.register()
