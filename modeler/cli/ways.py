"""The options of `modeler fit` that choose a way to fit."""

import argparse
from collections.abc import Sequence

from modeler.api.ways import OF_WINDOWS, WITHOUT_LOADS, Asked
from modeler.cli.drive_gains import carried
from modeler.core.choices import GAIN_METHOD
from modeler.core.errors import DataError
from modeler.observation import Log


def asked(args: argparse.Namespace, loaded: Sequence[Log]) -> Asked:
    """What the options ask for."""
    payloads = tuple(carried(args, loaded)) if loaded else ()
    return Asked(args.method, args.model == "energy", args.window, payloads, args.essential_below)


def check_way(args: argparse.Namespace) -> None:
    """Refuse options that do not go together."""
    for option in ("payload_mass", "payload_link", "payload_moved"):
        value = getattr(args, option)
        if value is not None and value is not False and not args.payload_log:  # 0 is given too
            flag = "--" + option.replace("_", "-")
            raise DataError(f"{flag}: no loaded log; name it with --payload-log LOG")
    if args.payload_log and args.method in WITHOUT_LOADS:
        raise DataError(
            f"--payload-log: got it with --method {args.method}, which knows no loads; expected "
            "--method weighted, ordinary, robust, ridge or tls"
        )
    if args.method == GAIN_METHOD and args.essential_below is not None:
        raise DataError(f"--essential-below: got it with --method {GAIN_METHOD}; leave it out")
    if args.model != "energy" and args.window is not None:
        raise DataError("--window: only windows of --model energy have a length; add that option")
    if args.model == "energy" and args.method not in OF_WINDOWS:
        raise DataError(
            f"--method {args.method}: got it with --model energy, whose rows are windows; expected "
            "--method weighted or ordinary"
        )
    if args.model == "energy" and args.payload_log:
        raise DataError(
            "--payload-log: the energy model takes logs without load; leave out --model energy"
        )
