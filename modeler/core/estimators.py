"""What each estimator is and when it is the wrong one: for help, pages and a fit's sentences."""

from dataclasses import dataclass
from typing import cast

from modeler.core.errors import GAIN_METHOD, TWO_STEPS, Method


@dataclass(frozen=True)
class EstimatorInfo:
    """An estimator in words.

    Attributes:
        id: as typed.
        title: as in "weighted least squares".
        law: its equation.
        source: where it comes from.
        avoid: when not to use it.
        motion: what it assumes of the noise of the measured motion.
    """

    id: str
    title: str
    law: str
    source: str
    avoid: str
    motion: str

    @property
    def is_consistent(self) -> bool:
        """True of those that end in all standard parameters, of a machine that could be built."""
        return self.id.endswith("consistent")


_EXACT = (
    "the motion is exact below the chosen cut-offs, where its noise is less torque than that of "
    "the drives; what rows near reversals say otherwise is in sigma"
)

_LIKE_DIDIM = (
    "the measured motion enters by its start and its differences from the simulated one alone; "
    "the same cut-offs apply"
)
_HIDES = (
    "it hides a missing effect in the nearest machine; look at the doubts of {} first, and keep to "
    "{} where its machine is one"
)

_EVERY = (
    EstimatorInfo(
        "weighted",
        "weighted least squares",
        "min sum_j |y_j - W_j beta|^2 / sigma_j^2, sigma_j^2 the residual variance of joint j, "
        "iterated to the fixed point",
        "Gautier 1997, ICRA",
        "where rows are wrong here and there (robust), or the motion is noise even where it moves "
        "most (iv, iv-direct): noise of W pulls values towards 0",
        _EXACT,
    ),
    EstimatorInfo(
        "ordinary",
        "ordinary least squares",
        "min |y - W beta|^2; covariance with the residual variance of each joint",
        "Gauss; White 1980",
        "where joints differ in torque or noise: the loudest joint decides, and the others' "
        "parameters are worse than they need be",
        _EXACT,
    ),
    EstimatorInfo(
        "robust",
        "robust least squares",
        "sum_i psi(r_i / sigma_j) w_i / sigma_j = 0, Huber's psi, then Tukey's bisquare; "
        "sigma_j = 1.4826 median |r_i| of joint j; sandwich covariance",
        "Huber 1964; Holland and Welsch 1977",
        "where the model lacks an effect: the rows that show it lose their weight, and the fit "
        "looks better than it is; with white noise it needs 5 % more rows",
        _EXACT,
    ),
    EstimatorInfo(
        "ridge",
        "ridge",
        "min |S^-1/2 (y - W beta)|^2 + lambda |D (beta - beta_0)|^2, beta_0 the nominal values of "
        "the robot file or 0, lambda by the probability of the data",
        "Hoerl and Kennard 1970; MacKay 1992",
        "where the values themselves matter and the motion could be better: it hides what the data "
        "do not tell, its values are biased towards the prior, and sigma knows no bias",
        _EXACT,
    ),
    EstimatorInfo(
        "iv",
        "instrumental variables, commanded motion",
        "(Z^T S^-1 W) beta = Z^T S^-1 y, Z the columns of W along the commanded motion",
        "Young 2011; Janot, Vandanjon and Gautier 2014, IEEE TCST 22(1)",
        "without logged commands qc, where the command follows the measurement (hand guiding, "
        "impedance control), or where the position is clean: then sigma is larger for nothing",
        "the motion may be noisy, if the command was not made from it; the same cut-offs apply",
    ),
    EstimatorInfo(
        "iv-direct",
        "instrumental variables, simulated motion",
        "(Z^T S^-1 W) beta = Z^T S^-1 y, Z the columns of W along the motion of the direct model, "
        "repeated with its own values",
        "Janot, Vandanjon and Gautier 2014, IEEE TCST 22(1)",
        "without logged commands qc (it then follows the logged motion, and little is gained), or "
        "where the fit cannot be simulated",
        "the motion may be noisy, as far as the simulated one does not follow its noise; the same "
        "cut-offs apply",
    ),
    EstimatorInfo(
        "didim",
        "direct and inverse model identification",
        "min sum_j |y_j - W_j(q_s) beta|^2 / sigma_j^2, q_s(beta) simulated in closed loop",
        "Gautier, Janot and Vandanjon 2013, IEEE TCST 21(2)",
        "where the controller of the log is not known and none comes near its motion: what they "
        "differ by goes into the values; sigma is raised by as much",
        _LIKE_DIDIM,
    ),
    EstimatorInfo(
        "didim-robust",
        "direct and inverse model identification, reweighted",
        "sum_i psi(r_i / sigma_j) w_i(q_s) / sigma_j = 0, r = y - W(q_s) beta, psi of robust, "
        "q_s(beta) simulated in closed loop",
        "Gautier, Janot and Vandanjon 2013, IEEE TCST 21(2); Huber 1964; Holland and Welsch 1977",
        "where didim or robust is the wrong one: an unknown controller, an effect that the model "
        "lacks",
        _LIKE_DIDIM,
    ),
    EstimatorInfo(
        "consistent",
        "physically consistent least squares",
        "min 1/2 |R (K chi - beta)|^2 + sum_j gamma_j D(P_j, P0_j), every pseudo-inertia P_j "
        "positive definite, friction and rotor inertias not negative; ends in all standard "
        "parameters chi",
        "Sousa and Cortesao 2014, IJRR 33(6); Lee, Wensing and Park 2020, IEEE T-RO 36(2)",
        "to see what is wrong: it hides a missing effect in the nearest machine; look at the "
        "doubts of weighted first",
        _EXACT,
    ),
    EstimatorInfo(
        "iv-consistent",
        "physically consistent instrumental variables, commanded motion",
        "min 1/2 |Q_z^T S^-1/2 (W K chi - y)|^2 + sum_j gamma_j D(P_j, P0_j), Q_z of the "
        "instruments of iv, bounds of consistent",
        "iv and consistent; Hansen 1982, Econometrica 50(4)",
        "where iv is the wrong one; " + _HIDES.format("iv", "iv"),
        "as iv",
    ),
    EstimatorInfo(
        "iv-direct-consistent",
        "physically consistent instrumental variables, simulated motion",
        "min 1/2 |Q_z^T S^-1/2 (W K chi - y)|^2 + sum_j gamma_j D(P_j, P0_j), Q_z of the "
        "instruments of iv-direct, simulated with machines that could be built",
        "iv-direct and consistent; Hansen 1982, Econometrica 50(4)",
        "where iv-direct is the wrong one; " + _HIDES.format("iv-direct", "iv-direct"),
        "as iv-direct",
    ),
    EstimatorInfo(
        "didim-consistent",
        "physically consistent direct and inverse model identification",
        "min 1/2 sum_j |y_j - W_j(q_s) K chi|^2 / sigma_j^2 + sum_j gamma_j D(P_j, P0_j), q_s(chi) "
        "simulated in closed loop with machines that could be built",
        "didim and consistent",
        "where didim is the wrong one; " + _HIDES.format("didim", "didim"),
        _LIKE_DIDIM,
    ),
)
ABOUT: dict[Method, EstimatorInfo] = {cast(Method, about.id): about for about in _EVERY}
"""By id, in the order in which they are told."""


APART = (
    EstimatorInfo(
        GAIN_METHOD,
        "total least squares with drive gains",
        "g_j V_j = W_j beta + m w_j: the smallest right singular vector of what QR of [W w] leaves "
        "of the currents V, rows and columns in units of their noise",
        "Briot and Gautier 2012; Van Huffel and Vandewalle 1991",
        "without logs of currents and a run with a load of known mass",
        _EXACT,
    ),
    EstimatorInfo(
        TWO_STEPS,
        "two-step least squares",
        "inertia J_ii, gravity and friction of each joint that moves alone, then theta = Phi beta",
        "Hanssen, Hovland and Brogardh 2000, section 4",
        "where joints may move together: rows of such motion are left out",
        _EXACT,
    ),
)
"""Beside the others: they take other logs."""


def find_estimator_title(method: str) -> str:
    """Its title; the id itself if a later version wrote it."""
    every = (*_EVERY, *APART)
    return next((about.title for about in every if about.id == method), method)
