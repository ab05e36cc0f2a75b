"""What values of the recursions are, for those who write them as text."""

from typing import NamedTuple


class Label(NamedTuple):
    """What a node of a graph is.

    Attributes:
        quantity: a letter of `codegen/quantities.toml`.
        link: name of the row whose frame it is given in.
        component: "x", "xy" of a matrix, "" of a number.
        step: "a" or "b", on the way to the quantity; empty for itself.
        of: the joint or parameter that it is for one unit of; may be empty.
        minus: True if the node is minus that.
    """

    quantity: str
    link: str
    component: str
    step: str
    of: str
    minus: bool


class Link(NamedTuple):
    """A row: name of its antecedent, "0" of the base; "turning", "sliding", or "" if fixed."""

    antecedent: str
    moves: str
