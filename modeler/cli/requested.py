"""What `modeler derive` was asked for besides relations and proof, and what it refuses."""

import argparse

from modeler.cli.parsers.derive import FEW_JOINTS
from modeler.core.errors import ModelerError
from modeler.derivation import Derivation


def check_request(args: argparse.Namespace) -> None:
    """Refuses options that would do nothing.

    Raises:
        ModelerError: they stand without what they change.
    """
    if args.nonzero and not (args.closed_form or args.regressor):
        raise ModelerError("--nonzero changes nothing by itself; add --closed-form or --regressor")
    if args.expanded and not (args.closed_form or args.terms):
        raise ModelerError("--expanded changes nothing by itself; add --closed-form or --terms")
    if args.document and args.format != "latex":
        raise ModelerError("--document is a whole page of LaTeX; add --format latex")


def check_loops(args: argparse.Namespace, derivation: Derivation) -> None:
    """Refuses what has no meaning for loops.

    Raises:
        ModelerError: coefficients or expanded forms are asked for.
    """
    if derivation.model.closure is None:
        return
    if args.terms or args.report is not None or args.expanded:
        raise ModelerError(
            f"{derivation.robot.name}: coefficients and expanded forms are written for robots "
            "whose loops, if any, follow linear relations; leave out --terms, --report and "
            "--expanded, or ask for --closed-form, which has J_t and J_p"
        )


def coefficients_wanted(args: argparse.Namespace, derivation: Derivation) -> bool:
    """Whether the coefficients are listed: on request, and for few joints unasked."""
    if args.terms is not None:
        return bool(args.terms)
    few = len(derivation.model.robot.coordinates) <= FEW_JOINTS
    asked = args.closed_form or args.regressor
    return derivation.model.closure is None and few and args.format == "text" and not asked


def forms_wanted(args: argparse.Namespace, derivation: Derivation) -> bool:
    """Whether anything is listed besides relations and proof."""
    asked = args.closed_form or args.regressor or args.report is not None
    return asked or coefficients_wanted(args, derivation)
