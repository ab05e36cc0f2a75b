"""Numbers that decide how a log is read, and what is said of it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Numbers that decide how a log is read, and what is said of it."""

    # arrays
    max_listed_names: int = 8
    """Names of arrays that a note lists; of more, the count of the rest."""
    max_struct_depth: int = 20
    """Structs and lists inside each other below which values are not read."""
    max_deflate_ratio: int = 1032
    """Bytes that zlib unpacks from one at most (RFC 1951: 258 from 2 bits)."""
    max_filter_bytes: int = 64
    """That other filters add to a chunk, as checksums do."""
    # bags
    min_messages: int = 10
    """Messages of a topic that may be the clock, if any has so many."""
    max_header_bytes: int = 4096
    """Bytes of the header of a record of a .bag file that are read."""
    # blocks
    sampled_lines: int = 200
    """By whose length the rows of a file are counted."""
    bytes_per_cell: int = 150
    """Of a cell in memory: as read, and as text. Measured with python-calamine."""
    min_sheet_rows: int = 2
    """Rows that a sheet must have to be a table: names and numbers."""
    # datasets
    max_parent_folders: int = 4
    """data/chunk-000/ and what may stand between a file and its dataset."""
    max_list_entries: int = 256
    """Entries of a list that become columns; a longer list is left out."""
    # dialect
    sampled_bytes: int = 2**16
    """By which the dialect of a file is chosen."""
    max_line_bytes: int = 2**24
    """Of the longest line that is looked at."""
    sampled_rows: int = 50
    """By which the columns are recognised."""
    # guess
    min_count_span: float = 5000.0
    """Span of whole numbers from which on a position is in counts. No study."""
    max_revolute_angle: float = 7.0
    """rad; a joint that goes further in either way is likely in degrees. No study."""
    max_axis_length: float = 3.0
    """m; an axis that is longer is likely in mm. No study."""
    max_agreeing_angle: float = 30.0
    """rad; with a speed that agrees: nearly five turns. No study."""
    max_current: float = 200.0
    """A; above, a current is likely in mA. No study."""
    max_normalised: float = 100.5
    """Parts of a normalised range, -100 to 100."""
    max_duty_span: float = 2.5
    """Span of a duty from -1 to 1, and a little more."""
    max_torque: float = 1e4
    """N m; above, a torque is likely in mN m. No study."""
    max_force: float = 1e6
    """N; above, a force is likely in mN. No study."""
    max_listed_columns: int = 24
    """Columns of the file that a skeleton of [log] lists."""
    # inspect
    usual_step_quantile: float = 0.95
    """Of the steps of an uneven clock. No study."""
    min_limit_share: float = 0.005
    """Share of the rows that stay at an end of the range, of a limit. No study."""
    max_held_share: float = 0.2
    """Share of rows in such runs, at any value, from which on a channel is only slow. No study."""
    max_jitter: float = 0.05
    """Share of the median step, above which a clock is uneven. No study."""
    max_merged_gap: int = 5
    """Steps between two marks that are one. No study."""
    # log_table
    max_listed_units: int = 6
    """Units that are not understood that a message lists."""
    # mapping
    max_unit_decades: int = 100
    """That no unit is away from SI."""
    max_scale: float = 1e100
    """Beyond, products are no numbers any more."""
    # rates
    min_derivative_correlation: float = 0.9
    """From which on a speed is the derivative of a position. No study."""
    max_ratio_deviation: float = 0.1
    """Relative; of a ratio that is a matter of units. No study."""
    max_agreeing_deviation: float = 0.2
    """Relative; of a speed that may be filtered or scaled: a surgical arm's is 1.18 times that."""
    min_motion_to_noise: float = 100.0
    """Times its noise from which on a joint moves. No study."""
    min_compared_rows: int = 10
    """Rows by which a speed is compared."""
    max_slope_noise: float = 0.1
    """Of the spread of the slopes: their noise in windows that are long enough. No study."""
    min_window_holds: float = 2.0
    """Windows over what the slower channel holds a value for. No study."""
    max_window_ratio: float = 3.0
    """Usual windows: a longer one lies across a gap. No study."""
    # readers
    max_interpolated_steps: float = 3.0
    """Steps of a file across which it is interpolated. No study."""
    max_clock_offset: float = 0.5
    """Of a step, that clocks of the same rows are apart at most. No study."""
    # times
    max_row_offset: float = 1.5
    """Rows that a coarse time may be early or late: its rounding is one, a late row a half."""
    min_repeated_share: float = 0.05
    """Share of rows with the time before them: fewer are single faults. No study."""
    min_clock_steps: int = 3
    """Of a coarse clock: fewer say nothing about a rate."""


THRESHOLDS = Thresholds()
