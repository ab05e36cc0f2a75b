"""The numbers that decide in `modeler.studio`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, counts and delays of the package."""

    ping_timeout: float = 30.0
    """s: a browser may leave a ping unanswered for 0.4 of it while it draws."""
    reconnect_delay: float = 3.0
    """s after a window was closed until another one may change things."""
    redraw_delay: float = 0.5
    """s without another incoming file until the screen is redrawn."""
    max_name_bytes: int = 120
    """Bytes to which the name of an incoming file is shortened."""
    spare_disk_bytes: int = 1_048_576
    """Bytes of the disk that stay free when a file comes in."""
    max_menu_columns: int = 400
    """Columns that a menu lists; others are typed."""
    all_curve_points: int = 14000
    """Points of all curves of a picture."""
    warning_margin: float = 0.02
    """s left out beside the place of a warning; no study."""
    motion_duration: float = 10.0
    """s of a motion by default."""
    max_output_lines: int = 20000
    """Lines of a command's output that are kept."""
    interrupt_patience: float = 3.0
    """s from the interrupt to the end by force."""
    max_undo_steps: int = 500
    """Edits that can be undone."""
    typing_step: float = 1.0
    """s within which typing is one edit."""
    typing_pause: float = 0.2
    """s after the last stroke until the text is checked."""
    max_sheets: int = 60
    """Pages in frames that are kept."""
    max_downloads: int = 200
    """Downloads whose addresses are kept; the oldest ones end."""
    held_out_share: float = 0.3
    """Share of the only log that is held out by default; a convention."""
    cached_results: int = 6
    """Results of one kind that are cached."""


THRESHOLDS = Thresholds()
