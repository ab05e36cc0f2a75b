"""Bodies that could be built, for tests: clouds of point masses, their parameters by definition."""

import numpy as np

from modeler.core.manifest import ModuleSpec


def ten_of_points(masses: np.ndarray, places: np.ndarray) -> dict[str, float]:
    """The ten parameters as sums over point masses (Khalil and Dombre)."""
    x, y, z = places.T
    sums = {
        **{"XX": y * y + z * z, "XY": -x * y, "XZ": -x * z, "YY": x * x + z * z, "YZ": -y * z},
        **{"ZZ": x * x + y * y, "MX": x, "MY": y, "MZ": z, "M": np.ones(len(x))},
    }
    return {prefix: float(masses @ values) for prefix, values in sums.items()}


def buildable(spec: ModuleSpec, rng: np.random.Generator) -> np.ndarray:
    """Standard parameters of links that are clouds of eight points, with friction above 0."""
    bodies = {
        p.joint: ten_of_points(rng.uniform(0.2, 2.0, 8), 0.3 * rng.normal(size=(8, 3)))
        for p in spec.standard
        if p.effect == "rigid_body"
    }
    return np.array(
        [
            bodies[p.joint][p.name.removesuffix(p.joint)]
            if p.effect == "rigid_body"
            else rng.uniform(0.1, 1.0)
            for p in spec.standard
        ]
    )
