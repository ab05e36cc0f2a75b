"""Cosine and sine of constant angles, exactly, with as few different ones as possible.

Sums and whole multiples are expanded, so that al, 2*al and al + pi/4 are made of the same two
angles, and relations between them are seen.
"""

import sympy

_FINEST = 12
"""Fractions p/q of pi up to this q are multiples of pi/q; finer ones stand for themselves."""

_MOST_TURNS = 4
"""Angles in a sum, counted with their multiples; a longer sum stands for itself. Written out, its
cosine has 2**(turns - 1) terms. Relations that this hides are found at the given values."""

Pair = tuple[sympy.Expr, sympy.Expr]
"""(cosine, sine)."""


def cos_sin(angle: sympy.Expr) -> Pair:
    """Cosine and sine: exact 0 and +-1 at right angles; other constants are left standing.

    They are not turned into radicals: cos(pi/3) and sin(pi/3) stay a point of the unit circle,
    which is what grouping has to know of them.
    """
    constant, rest = angle.as_independent(*angle.free_symbols, as_Add=True)
    if rest == 0 or not angle.free_symbols:
        return _of_number(angle)
    if not is_short(rest):
        return _standing(angle)
    pair = tuple(sympy.expand_trig(f(rest)) for f in (sympy.cos, sympy.sin))
    return _sum((pair[0], pair[1]), _of_number(constant))


def is_short(angle: sympy.Expr) -> bool:
    """True if sums and whole multiples in the angle are few enough to be written out."""
    turns = 0
    for term in sympy.Add.make_args(angle):
        factor = term.as_coeff_Mul()[0]
        turns += abs(int(factor)) if factor.is_Integer else 1
    return turns <= _MOST_TURNS


def _of_number(angle: sympy.Expr) -> Pair:
    quarters = angle / (sympy.pi / 2)
    if quarters.is_Integer:
        return sympy.cos(angle), sympy.sin(angle)
    if angle.is_negative:
        c, s = _of_number(-angle)
        return c, -s
    number, turned = angle.as_coeff_Add()
    if number and turned:  # 0.4 + pi/2 is made of the same angle as 0.4
        return _sum(_of_number(number), _of_number(turned))
    turns = angle / sympy.pi
    if turns.is_Rational and turns.q <= _FINEST:
        return _multiple(_standing(sympy.pi / turns.q), int(turns.p))
    return _standing(angle)


def _standing(angle: sympy.Expr) -> Pair:
    return sympy.cos(angle, evaluate=False), sympy.sin(angle, evaluate=False)


def _multiple(pair: Pair, n: int) -> Pair:
    total = pair
    for _ in range(n - 1):
        total = _sum(total, pair)
    return total


def _sum(a: Pair, b: Pair) -> Pair:
    # Products and sums only: sympy's own simplifications would evaluate what is left standing.
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]
