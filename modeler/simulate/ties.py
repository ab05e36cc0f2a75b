"""Relations of a simulated robot as a matrix: all joints of the tree from the free ones."""

import numpy as np

from modeler.robot import Robot


def tree_from_free(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """F (moving rows, free rows) and c (moving rows,) of v = F u + c.

    Args:
        robot: u are the variables of `robot.free`, v those of `robot.moving`.
    """
    names = [joint.name for joint in robot.moving]
    at_zero = robot.symbol_values() | {joint.variable: 0.0 for joint in robot.moving}
    follows, constant = np.zeros((len(names), len(names))), np.zeros(len(names))
    for name, relation in robot.relations.items():
        row = names.index(name)
        constant[row] = relation.number(at_zero)
        for k, joint in enumerate(robot.moving):
            if joint.variable in relation.names:
                follows[row, k] = relation.number(at_zero | {joint.variable: 1.0}) - constant[row]
    own = np.zeros((len(names), len(robot.free)))
    for k, joint in enumerate(robot.free):
        own[names.index(joint.name), k] = 1.0
    # Relations may hold joints that follow others themselves; never in a circle.
    left = np.eye(len(names)) - follows
    return np.linalg.solve(left, own), np.linalg.solve(left, constant)


def untied(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """The same matrix and constants with every moving row free."""
    count = len(robot.moving)
    return np.eye(count), np.zeros(count)
