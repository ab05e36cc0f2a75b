"""The report of logs that were read in chunks."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

from modeler.observation.log import LONG, fingerprint, fingerprint_of
from modeler.observation.observation import joint_reports
from modeler.observation.outliers import Whose, damages
from modeler.observation.read import Source, joined
from modeler.observation.report import DataReport, LogReport
from modeler.observation.survey import Survey
from modeler.observation.tally import Facts, Tally

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel


@dataclass(frozen=True, eq=False)
class Passes:
    """What long logs were read for.

    Attributes:
        found: what the windows showed.
        facts: of all rows, by log.
        passes: over the logs.
    """

    found: Survey
    facts: tuple[Facts, ...]
    passes: int

    def sentences(self) -> tuple[str, ...]:
        """Which rows were read for what."""
        told = self.to_json()
        passes = "once" if self.passes == 1 else f"{self.passes} times"
        return (
            f"long logs: all {told['rows']} rows are read {passes}, in {told['chunks']} chunks "
            "that overlap by what the filters remember; "
            f"{told['rows_in_windows']} of them, in {told['windows']} windows, are looked at for "
            "the choices below, doubts about channels, and what needs samples side by side",
        )

    def to_json(self) -> dict[str, int]:
        """Plain data."""
        tallies = [facts.tally for facts in self.facts]
        return {
            "passes": self.passes,
            "chunks": sum(tally.count("chunks") for tally in tallies),
            "rows": sum(tally.count("rows") for tally in tallies),
            "windows": self.found.windows,
            "rows_in_windows": self.found.rows,
        }


def streamed_report(
    model: "CompiledModel", sources: Sequence[Source], passes: Passes
) -> DataReport:
    """What happened to all rows of long logs.

    Args:
        model: the compiled robot.
        sources: of the logs.
        passes: over them.
    """
    found, facts = passes.found, passes.facts
    looked, chosen = found.observation.report, found.chosen[0]
    floors = dict(chosen.processing.speed_floors or {})
    tally = reduce(Tally.over, (own.tally for own in facts))
    return dataclasses.replace(
        looked,
        processing=dataclasses.replace(looked.processing, speed_floors=floors),
        choices=(*passes.sentences(), *looked.choices),
        logs=tuple(_log_report(model, source, k, passes) for k, source in enumerate(sources)),
        joints=joint_reports(model.spec.joints, chosen.shafts, floors, tally.sums),
    )


def _log_report(model: "CompiledModel", source: Source, k: int, passes: Passes) -> LogReport:
    facts, chosen, found = passes.facts[k], passes.found.chosen[k], passes.found
    tally, at, first = facts.tally, found.places[k], source.window(0.0, 2)
    check, names, rows = found.prepared.checks[at], first.joints, tally.count("rows")
    clipped = zip(names, tally.by_joint("clipped"), strict=True)
    return LogReport(
        name=source.name,
        rows=rows,
        missing=_told(tally, "missing "),
        saturated={name: int(count) for name, count in clipped if count},
        rate=1.0 / chosen.step,
        jitter=float(tally.most["jitter"]),
        gaps=tally.count("gaps"),
        longest_gap=float(tally.most["gap"]),
        pieces=tally.count("pieces"),
        resampled=tally.count("resampled"),
        short=tally.count("short"),
        derivatives=found.prepared.derivatives[at],
        decimation=chosen.processing.decimation or 1,
        samples=tally.count("samples"),
        notes=(*first.notes, *facts.ranges.doubts(chosen.step, model.spec),
               *found.prepared.rings[at], *(check.notes if check else ())),
        contradictions=facts.contradictions,
        contradicted=tally.count("contradicted"),
        damages=damages(Whose(source.name, rows, first.torque_source), model.spec, facts.defects),
        content=_content(source, facts),
        span=facts.span,
        torque_source=first.torque_source,
        open_times=facts.open_times,
    )  # fmt: skip


def _told(tally: Tally, prefix: str) -> dict[str, int]:
    """Counts whose names begin so, by the rest of their names; none of 0."""
    return {
        name.removeprefix(prefix): int(count)
        for name, count in tally.sums.items()
        if name.startswith(prefix) and count
    }


def _content(source: Source, facts: Facts) -> str:
    """The fingerprint of the log, as that of one that is read whole."""
    if source.content:
        return source.content
    if facts.tally.count("rows") > LONG:
        return fingerprint_of(facts.fingers)
    log = joined(list(source.blocks(LONG)))
    return fingerprint(log.time, log.q, log.tau)
