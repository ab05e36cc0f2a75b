"""What each estimator is and when it is the wrong one: for help, pages and the fit's sentences."""

from dataclasses import dataclass

from modeler.core.choices import Method


@dataclass(frozen=True)
class About:
    """An estimator in words.

    Attributes:
        id: as typed.
        title: as in "weighted least squares".
        law: its equation.
        source: where it comes from.
        avoid: when not to use it.
    """

    id: Method
    title: str
    law: str
    source: str
    avoid: str


_EVERY = (
    About(
        "weighted",
        "weighted least squares",
        "min sum_j |y_j - W_j beta|^2 / sigma_j^2, sigma_j^2 the residual variance of joint j, "
        "iterated to the fixed point",
        "Gautier 1997, ICRA",
        "where rows are wrong here and there (robust), or the motion is so noisy that W itself is "
        "(iv, iv-direct): noise of W pulls values towards 0, and sigma does not say so",
    ),
    About(
        "ordinary",
        "ordinary least squares",
        "min |y - W beta|^2, sigma^2 (W^T W)^-1",
        "Gauss; Gautier and Khalil 1991",
        "where joints differ in torque or noise: the loudest joint decides, and one sigma for all "
        "is too small for it and too large for the others",
    ),
    About(
        "consistent",
        "physically consistent least squares",
        "min 1/2 |R (K chi - beta)|^2 + sum_j gamma_j D(P_j, P0_j), every pseudo-inertia P_j "
        "positive definite, friction and rotor inertias not negative; ends in all standard "
        "parameters chi",
        "Sousa and Cortesao 2014, IJRR 33(6); Lee, Wensing and Park 2020, IEEE T-RO 36(2)",
        "to see what is wrong: it hides a missing effect in the nearest machine; look at the "
        "doubts of weighted first",
    ),
)
ABOUT: dict[str, About] = {about.id: about for about in _EVERY}
"""By id, in the order in which they are told."""


def titled(method: str) -> str:
    """Its title; the id itself if a later version wrote it."""
    return ABOUT[method].title if method in ABOUT else method
