"""Do links meet along exciting motions? 200 of them, judged by coal and the numbers of the table.

Run from the top of the checkout: `python -m benchmarks.collisions [FIRST COUNT]`. Motions of five
robots, three families, a seed each, with a clearance and, every fourth, without, are sampled 2000
times. Frames are those of the table (`report.robot_skeleton`), distances are coal's: neither shares
code with the search. Capsules are the default ones; pairs that the search leaves out are left out.
"""

import sys
import time

import coal
import numpy as np

from benchmarks.excitation import FIVE, with_losses
from modeler.api import compile_model, derive, generate
from modeler.api.motion_bounds import build_bounds
from modeler.excitation import CollisionGeometry, ExcitingMotion, MotionRequest, design_motion
from modeler.excitation.series import FAMILIES
from modeler.robot import read_robot
from modeler.views.robot_skeleton import Skeleton, build_skeleton, compute_poses

MARGIN = 0.01  # m
FREE = 4  # every so manieth is looked for without clearance too
_SAMPLES = 2000


def least_distance(skeleton: Skeleton, solids: CollisionGeometry, motion: ExcitingMotion) -> float:
    """Of all pairs, at even times, m."""
    shapes = []
    for ends, radius in zip(solids.ends, solids.radius, strict=False):
        way = ends[1] - ends[0]
        length = float(np.linalg.norm(way))
        z = way / length if length else np.array([0.0, 0.0, 1.0])
        x = np.linalg.svd(z[None, :])[2][1]
        pose = np.eye(4)
        pose[:3] = np.column_stack([x, np.cross(z, x), z, ends.mean(axis=0)])
        made = coal.Capsule(radius, length) if length else coal.Sphere(radius)
        shapes.append((made, pose))
    times = np.linspace(0.0, motion.series.duration, _SAMPLES)
    moving = [i for i, row in enumerate(skeleton.rows) if row.joint.is_moving]
    least, request, result = np.inf, coal.DistanceRequest(), coal.DistanceResult()
    for q in motion.series.resample_at(times).evaluate_motion(motion.x)[0]:
        frames = compute_poses(skeleton, q)
        placed = []
        for (shape, item), carrier in zip(shapes, solids.carriers, strict=False):
            T = item if carrier < 0 else frames[moving[carrier]] @ item
            placed.append((shape, coal.Transform3s(T[:3, :3], T[:3, 3])))
        for one, other in solids.pairs:
            result.clear()
            text = coal.distance(*placed[one], *placed[other], request, result)
            least = min(least, text)
    return least


def main(first: int, count: int) -> None:
    subjects, hits, near, cost = [], [0, 0], 0, [0.0, 0.0]
    for name in FIVE:
        robot = with_losses(read_robot(name))
        compiled = compile_model(generate(derive(robot)))
        bounds = [
            build_bounds(robot, compiled, {}, {}),
            build_bounds(robot, compiled, {}, {}, MARGIN),
        ]
        subjects.append((name, build_skeleton(robot), compiled, bounds))
    conditions: dict[str, list[list[float]]] = {name: [[], []] for name in FIVE}
    for k in range(first, first + count):
        name, skeleton, compiled, both = subjects[k % len(subjects)]
        wish = MotionRequest(6.0, 3, starts=1, seed=k, family=[*FAMILIES][k % len(FAMILIES)])
        solids = both[1].clearance.solids
        for n, bounds in enumerate(both):
            if n == 0 and k % FREE:
                continue
            begun = time.process_time()
            motion = design_motion(compiled, bounds, wish)
            cost[n] += time.process_time() - begun
            least = least_distance(skeleton, solids, motion)
            conditions[name][n].append(motion.quality.condition)
            hits[n] += least < 0.0
            if n:
                near += least < MARGIN - 1e-6 or motion.closest_approach.bound > least + 1e-6
        if (k + 1) % 10 == 0:
            print(f"{k + 1}: {hits}, nearer than stated {near}", flush=True)
    print(
        f"{count} motions: meet in {hits[1]}; without clearance in {hits[0]} of every fourth; "
        f"nearer than {MARGIN:g} m or than stated: {near}; cpu seconds {cost[0]:.0f}, {cost[1]:.0f}"
    )
    for name, (free, clear) in conditions.items():
        print(f"{name}: median condition number {np.median(free):.4g}, {np.median(clear):.4g}")


if __name__ == "__main__":
    main(*([int(word) for word in sys.argv[1:]] or [0, 200]))
