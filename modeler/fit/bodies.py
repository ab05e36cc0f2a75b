"""The links of a machine as a workshop describes them."""

from collections.abc import Mapping

import numpy as np

_ROUND = "{:.4g}".format


def bodies_told(standard: Mapping[str, float]) -> list[str]:
    """A line per link: mass, mass centre in its frame, principal moments about the mass centre.

    Args:
        standard: standard parameters by name; links of which one of the ten is missing are left
            out.
    """
    lines = []
    for link in [
        name[1:] for name in standard if name.startswith("M") and _is_link(name, standard)
    ]:
        mass, centre, moments = _body(link, standard)
        lines.append(
            f"link {link}: {_ROUND(mass)} kg, centre ({', '.join(map(_ROUND, centre))}) m, "
            f"principal moments {', '.join(map(_ROUND, moments))} kg m2"
        )
    return lines


def _is_link(name: str, standard: Mapping[str, float]) -> bool:
    prefixes = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ")
    return standard[name] > 0.0 and all(f"{p}{name[1:]}" in standard for p in prefixes)


def _body(link: str, standard: Mapping[str, float]) -> tuple[float, np.ndarray, np.ndarray]:
    xx, xy, xz, yy, yz, zz, mx, my, mz, mass = (
        standard[f"{p}{link}"] for p in ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
    )
    centre = np.array([mx, my, mz]) / mass
    origin = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    about = origin - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return mass, centre, np.linalg.eigvalsh(about)
