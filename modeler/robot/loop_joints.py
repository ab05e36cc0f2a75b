"""How many joints of a tree its loops leave free, and which of them may lead."""

import numpy as np

from modeler.robot.body_tree import BodyTree, LoopClosure, Pose, compute_body_poses
from modeler.robot.robot import JointKind

_STEP = 1e-6  # rad, m, of central differences
_RANK = 1e-7  # of the largest singular value: differences are good to 1e-10
_TIES = {
    "rigid": (0, 1, 2, 3, 4, 5), "revolute": (0, 1, 2, 3, 4), "prismatic": (0, 1, 3, 4, 5),
    "cylindrical": (0, 1, 3, 4), "universal": (0, 1, 2, 6), "planar": (2, 3, 4),
}  # fmt: skip
"""Kind -> which of `_apart` it ties; the others tie the three of the origin."""


def choose_independent_joints(tree: BodyTree) -> set[str]:
    """As many joints as the loops leave free, those that are nearest to the base first.

    The rank is taken where no loop is closed: it is that of the mechanism wherever it does not
    depend on special lengths.
    """
    depth = {tree.root: 0}
    for joint in tree.joints:
        depth[joint.child] = depth[joint.parent] + 1
    leading = [j for j in tree.joints if j.kind is not JointKind.FIXED and not j.leader]
    leading.sort(key=lambda joint: depth[joint.child])
    q = np.random.default_rng(0).uniform(-1.0, 1.0, len(leading))
    names = [joint.name for joint in leading]

    def compute_closure_errors(q: np.ndarray) -> np.ndarray:
        poses = compute_body_poses(tree, dict(zip(names, q.tolist(), strict=True)))
        return np.concatenate(
            [_compute_closure_error(meeting, poses) for meeting in tree.loop_closures]
        )

    steps = _STEP * np.eye(len(q))
    J = np.column_stack(
        [
            (compute_closure_errors(q + h) - compute_closure_errors(q - h)) / (2 * _STEP)
            for h in steps
        ]
    )
    rank, dependent = _compute_rank(J), list(range(len(names)))
    for k in range(len(names)):
        others = [i for i in dependent if i != k]
        if len(dependent) > rank and _compute_rank(J[:, others]) == rank:
            dependent = others
    return {name for k, name in enumerate(names) if k not in dependent}


def _compute_closure_error(meeting: LoopClosure, poses: dict[str, Pose]) -> np.ndarray:
    """What the joint that closes a loop holds at 0."""
    one = poses[meeting.body] @ meeting.pose
    relative_pose = one.inverse() @ (poses[meeting.other] @ meeting.other_pose)
    R = relative_pose.rotation
    residuals = np.array([*relative_pose.position, R[0, 2], R[1, 2], R[0, 1], R[2, 2]])
    return residuals[list(_TIES.get(meeting.kind, (0, 1, 2)))]


def _compute_rank(matrix: np.ndarray) -> int:
    values = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(1)
    return int(np.sum(values > _RANK * max(values[0], 1e-3)))
