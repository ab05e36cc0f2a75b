"""The robots that every test of every stage runs over: a new built-in is tested by being there."""

from modeler.core.builtin import builtin_names
from modeler.robot.read import read_robot

ROBOTS = builtin_names()

TREES = tuple(name for name in ROBOTS if not (read_robot(name).loops or read_robot(name).relations))
"""Robots whose rows all move on their own."""

TIED = tuple(name for name in ROBOTS if name not in TREES)
"""Robots with relations or loops."""
