"""Which parameters are kept first when they group: the user's order, else the table's."""

import fnmatch
from collections.abc import Sequence

from modeler.core.errors import DerivationError


def priority_order(names: Sequence[str], patterns: Sequence[str]) -> list[int]:
    """Columns in the order in which they are kept: those of the patterns first, then the others.

    Raises:
        DerivationError: a pattern matches no parameter.
    """
    order: list[int] = []
    for pattern in patterns:
        matching = [i for i, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
        if not matching:
            raise DerivationError(
                f'priority: "{pattern}" matches no parameter; expected names or patterns such as '
                f'"{names[0]}" or "{names[0][:2]}*"'
            )
        order += [i for i in matching if i not in order]
    return order + [i for i in range(len(names)) if i not in order]
