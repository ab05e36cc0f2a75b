"""`modeler fit` of logs that are too long to be in memory at once."""

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from modeler.api.long_logs import (
    are_long,
    by_workers,
    check_whole,
    fit_long,
    from_anywhere,
    sources_of,
    too_long,
)
from modeler.cli.console import note, progress
from modeler.codegen.derivation import Derivation
from modeler.core.errors import DataError
from modeler.core.jobs import open_workers
from modeler.core.manifest import Emitted
from modeler.estimation.long_logs import OF_TRIANGLES, Reducer
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.observation import Observation
from modeler.observation.processing import Processing
from modeler.observation.read import Source
from modeler.observation.survey import WholeNeeded
from modeler.runtime.model import CompiledModel


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
    if args.dask is None and not are_long(places):
        return None
    rule = "--essential-below" if args.essential_below is not None else ""
    if rule or args.method not in OF_TRIANGLES or args.model == "energy" or args.payload_log:
        _check_no_dask(args, rule)
        check_whole(places, rule or f"method {args.method}")
        return None
    try:
        with progress("reading and reducing") as bar, _reducer(args, emitted) as reducer:
            sources = sources_of(compiled, args.logs, args.map)
            if reducer is not None:
                _tell_read_here(sources)
            model, streamed = fit_long(
                derivation, emitted, compiled, sources, args.method, processing, bar, reducer
            )
    except WholeNeeded as error:
        if too_long(places):
            raise
        note(f"{error}; read as a whole instead")
        return None
    return model, streamed.observation


@contextmanager
def _reducer(args: argparse.Namespace, emitted: Emitted) -> Iterator[Reducer | None]:
    """Workers of a Dask cluster; None: threads of this process."""
    if args.dask is None:
        yield None
        return
    with open_workers(args.dask) as workers:
        yield by_workers(workers, emitted)


def _tell_read_here(sources: Sequence[Source]) -> None:
    own = [source.name for source in sources if not from_anywhere(source)]
    if own:
        note(
            f"--dask: {', '.join(own)}: read and reduced by this process; workers can begin in the "
            "middle of Parquet files only"
        )


def _check_no_dask(args: argparse.Namespace, rule: str) -> None:
    if args.dask is not None:
        what = "--model energy" if args.model == "energy" else f"--method {args.method}"
        what = "--payload-log" if args.payload_log else rule or what
        raise DataError(
            f"--dask {args.dask}: got {what}, which needs all rows in one memory; expected "
            f"--method {' or '.join(OF_TRIANGLES)} of the torque model; leave --dask out"
        )
