"""The robots that every test of every stage runs over: a new built-in is tested by being there."""

from modeler.robot import builtin_names

ROBOTS = builtin_names()
