"""`modeler fit` of logs that are too long to be in memory at once."""

import argparse

from modeler.api import Derivation
from modeler.api.long_logs import are_long, check_whole, fit_long, sources_of, too_long
from modeler.cli.console import note, progress
from modeler.compiled import CompiledModel
from modeler.core.contract import Emitted
from modeler.fit import IdentifiedModel
from modeler.fit.long import OF_TRIANGLES
from modeler.fit.streamed import WholeNeeded
from modeler.observation import Observation, Processing


def fit_if_long(
    args: argparse.Namespace,
    derivation: Derivation,
    emitted: Emitted,
    compiled: CompiledModel,
    processing: Processing,
) -> tuple[IdentifiedModel, Observation] | None:
    """The model of long logs, read in chunks; None where all rows are to be in memory.

    Raises:
        DataError: they are more rows than a way to fit that needs all of them may have.
    """
    places = [*args.logs, *args.payload_log]
    if not are_long(places):
        return None
    if args.method not in OF_TRIANGLES or args.model == "energy" or args.payload_log:
        check_whole(places, args.method)
        return None
    try:
        with progress("reading and reducing") as bar:
            sources = sources_of(compiled, args.logs, args.map)
            model, streamed = fit_long(
                derivation, emitted, compiled, sources, args.method, processing, bar
            )
    except WholeNeeded as error:
        if too_long(places):
            raise
        note(f"{error}; read as a whole instead")
        return None
    return model, streamed.observation
