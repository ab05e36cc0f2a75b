from .channels import (
    Doubt as Doubt,
    ThinnedRows as ThinnedRows,
    Turn as Turn,
    clocks as clocks,
    thinned as thinned,
    turns as turns,
    zero as zero,
)
from .chunk import (
    SPREAD as SPREAD,
    Chunk as Chunk,
    chunks as chunks,
    chunks_between as chunks_between,
    read_part as read_part,
    read_spread as read_spread,
    window as window,
)
from .log import (
    FINGER as FINGER,
    LONG as LONG,
    MOST_WHOLE as MOST_WHOLE,
    Log as Log,
    LogRows as LogRows,
    check_apart as check_apart,
    shared_rows as shared_rows,
)
from .low_speed import (
    bristle as bristle,
    lag as lag,
    shafts as shafts,
    signals_along as signals_along,
    signals_of as signals_of,
    since_reversal as since_reversal,
)
from .motion import (
    HIGHEST as HIGHEST,
    Segment as Segment,
    differentiated as differentiated,
    low_pass as low_pass,
    travel_since_reversal as travel_since_reversal,
)
from .motion_noise import ChannelNoise as ChannelNoise, MotionNoise as MotionNoise
from .observation import (
    MASKS as MASKS,
    WHY as WHY,
    Evaluated as Evaluated,
    Observation as Observation,
    masks_of as masks_of,
    model_torque as model_torque,
    no_row_left as no_row_left,
    observed as observed,
    observed_alike as observed_alike,
    stacked as stacked,
)
from .observe import (
    SAMPLES as SAMPLES,
    TREMBLES as TREMBLES,
    Look as Look,
    observe as observe,
    trembling as trembling,
)
from .prepare import (
    LogRepair as LogRepair,
    Prepared as Prepared,
    choose_cutoffs as choose_cutoffs,
    nearest_closed as nearest_closed,
    noise_of_positions as noise_of_positions,
    prepare as prepare,
    without_open as without_open,
)
from .read import (
    FileSource as FileSource,
    MemorySource as MemorySource,
    Source as Source,
    log_in_memory as log_in_memory,
    log_of as log_of,
    read_log as read_log,
    source_of as source_of,
    table_in_memory as table_in_memory,
)
from .reduce import (
    blocks as blocks,
    fitted_torque as fitted_torque,
    is_streamed as is_streamed,
    triangles as triangles,
    with_stretch as with_stretch,
)
from .report import (
    Bands as Bands,
    DataReport as DataReport,
    LogReport as LogReport,
    bands_of as bands_of,
)
from .segments import runs as runs
from .settings import (
    ChosenProcessing as ChosenProcessing,
    Processing as Processing,
    processing_from_json as processing_from_json,
)
from .stretch import Stretch as Stretch
from .survey import (
    WINDOW as WINDOW,
    WINDOWS as WINDOWS,
    FactsSoFar as FactsSoFar,
    LogChoices as LogChoices,
    Passes as Passes,
    Survey as Survey,
    WholeLogNeeded as WholeLogNeeded,
    rows_of_chunk as rows_of_chunk,
    streamed_report as streamed_report,
    survey as survey,
)
from .tally import Facts as Facts
