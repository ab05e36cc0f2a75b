"""A code-generating symbolic modeler for robot dynamics.

Data flows one way::

    robot -> effects -> symbolic -> base -> codegen => C + manifest
          => compiled -> observation -> fit -> compare

The stages before the emitted C derive (sympy, casadi, jinja2); those after it only use numbers.
This module imports nothing, so that the numeric stages never load the symbolic ones.
"""

__version__ = "0.1.0"
