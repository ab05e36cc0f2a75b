"""A code-generating symbolic modeler for robot dynamics.

Data flows one way::

    effects -> robot -> symbolic -> base -> codegen => C + manifest
            => compiled -> observation -> estimate -> fit -> compare

The stages before the emitted C derive (sympy, casadi, jinja2); those after it only use numbers.
A robot names effects of the catalogue; `terms` stands beside codegen and writes for people;
`simulate` has physics of its own, `show` draws a robot from its table alone. `derivation` and
`api` put the steps in a row.
This module imports nothing, so that the numeric stages never load the symbolic ones.
"""

__version__ = "0.1.0"
