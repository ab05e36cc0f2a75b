"""A code-generating symbolic modeler for robot dynamics.

Data flows one way::

    effects -> robot -> derivation -> codegen => C + manifest
            => runtime -> observation -> estimation -> validation -> diagnosis -> robot ...

The rooms before the emitted C derive (sympy, casadi, jinja2); those after it only use numbers.
A robot names effects of the catalogue; `formulas` stands beside codegen and writes for people;
`simulation` has physics of its own; `logs` reads what people have, `numerics` has the linear
algebra of all; `fleet`, `excitation` and `papers` build on them; `report` shows results, `api` and
`cli` put the steps in a row. docs/architecture.md shows the house.
This module imports nothing, so that the numeric stages never load the symbolic ones.
"""

__version__ = "0.1.0"
