"""Whether a printed line holds, by numbers that the product does not compute.

`holds(name, line)` is True, False, or None where there is no oracle for the line.
"""

import re
from functools import cache
from itertools import product
from math import prod

import numpy as np

from modeler.papers.paper import build_renamer, read_paper
from modeler.papers.quotation import read_numbers, read_sum
from tests.papers import mechanisms as m
from tests.papers.derived_papers import robots_of

RNG = np.random.default_rng(2003)


def holds(name, line):
    oracle = ORACLES.get(line.check)
    result = None if oracle is None else oracle(read_paper(name), line)
    return None if result is None else bool(result)


def value(text, known):
    """The number of an expression of sums and products, in the words of a quotation."""
    text = re.sub(r"\b(sin|cos)\(?\s*([a-z]\w*)\)?", r"\1(\2)", text)
    return evaluated(read_sum(text, str), known)


def evaluated(parts, known):
    def number(name):
        function, _, argument = name.removesuffix(")").partition("(")
        return getattr(np, function)(known[argument]) if argument else known[name]

    return sum(
        float(a.value) * prod(number(n) ** p for n, p in monomial) for monomial, a in parts.items()
    )


# Base parameters: the printed sum, coefficient by coefficient, beside the columns of energies.


@cache
def groupings(robot):
    return m.grouping(robot, robots_of_robot(robot).independent_parameters)


def robots_of_robot(robot):
    paper = next(n for n in PAPERS if robot in read_paper(n).robots)
    return robots_of(paper)[robot]


PAPERS = ("briot-2012", "guegan-2003", "houda")


def relation(paper, line):
    if line.robot not in m.ROBOTS or line.substitution or line.relation_robot or line.assumptions:
        return None
    left, _, right = line.text.partition("=")
    rename = build_renamer(paper, line, line.legs[0])
    printed, items = {}, rename(left.strip()).removesuffix("R")
    symbols = {"d4", "D4", "D41", "D42", "D43", "g"}
    known = dict.fromkeys(symbols, m.D4) | {"g": 9.81}
    for monomial, amount in read_sum(right, rename, "123").items():
        names = [n for n, _ in monomial if n not in symbols]
        factor = prod(known[n] ** p for n, p in monomial if n in symbols)
        printed[names[0]] = (float(amount.value) * factor, float(amount.half) * abs(factor))
    for parameter, stored in groupings(line.robot).items():
        wanted, half = printed.get(parameter, (0.0, 0.0))
        if abs(stored[items] - wanted) > half + 1e-6:
            return False
    return True


# Geometry of the Orthoglide: frames of the printed table beside the printed closure.


def row(paper, line):
    """r13: the end of leg 3 by the printed table is where eq. (2) says, or not."""
    if not line.quote.startswith("13 |"):
        return None
    r = line.quote.rpartition("|")[2].strip()
    q1, q2, q3 = 0.2, -1.4, 0.3
    slide = value(r, {"q13": q1, "a": m.A})
    first = m.GROUND.then(0, m.A, -np.pi / 2, 0, -np.pi / 2, slide)
    by_table = m.rows_2012(first, q2, q3, "3")["53"]
    tip = by_table.place + m.D6 * first.turn[:, 2]
    local = [
        m.D4 * np.cos(q2) * np.cos(q3) + m.A,
        -m.D4 * np.sin(q3),
        q1 - m.A - m.D4 * np.sin(q2) * np.cos(q3) + m.D6,
    ]
    return bool(np.allclose(tip, first.turn @ local))


def with_deltas(text, leg):
    """deltaj is 1 if j is 3, in a circle of three; bardelta 1 - delta."""

    def number(found):
        third = (leg + int(found[2] or 0)) % 3 == 0
        return str(int(not third if found[1] else third))

    return re.sub(r"(bar)?deltai(?:\+(\d))?", number, text)


def closure(paper, line):
    texts = line.quote.split("|") if "|" in line.quote else [line.quote] * len(line.legs)
    for leg, quote in list(zip(line.legs, texts, strict=True)) * 3:
        end = RNG.uniform(*m.ORTHOGLIDE)
        first, (q1, q2, q3) = m.orthoglide_leg(m.GROUND, end, leg)
        assert np.allclose(
            m.rows_2012(first, q2, q3, leg)[f"5{leg}"].place + m.D6 * first.turn[:, 2], end
        )
        text = with_deltas(quote, int(leg))
        known = {"a": m.A, "d4": m.D4, "d6": m.D6, "q1i": q1, "q2i": q2, "q3i": q3}
        known |= dict(zip("xyz", end, strict=True)) | {f"q1{leg}": q1}
        actual = np.array([value(part, known) for part in text.split(";")])
        wanted = first.turn.T @ end if ";" in text else np.zeros(1)
        if not np.allclose(actual, wanted):
            return False
    return True


def platform(paper, line):
    """A force has three numbers: a diagonal matrix times a mass has nine."""
    cells = line.quote.partition("(")[2].rstrip(")").split(",")
    known = {"ddotx": 1.0, "ddoty": -2.0, "ddotz": 3.0, "g": 9.81}
    numbers = np.array([value(cell, known) for cell in cells])
    printed = np.diag(numbers) if "diag" in line.quote else numbers
    force = np.array([1.0, -2.0, 3.0]) - [0, 9.81, 0]
    return printed.shape == force.shape and bool(np.allclose(printed, force))


def effort(paper, line):
    """Forces at one place and the other do the same work for every velocity V."""
    here, there, what = line.expected
    J = {key: RNG.normal(0, 1, (3, 3)) for key in ("p", "i", "1", "2", "3")}
    speeds = {"motors": np.linalg.inv(J["p"]), "platform": np.eye(3)}
    speeds["leg"] = np.linalg.inv(J[what[-1]]) if here == "leg" else None
    force, values = RNG.normal(0, 1, 3), np.eye(3)
    for which in re.findall(r"\^0J(\w)\^T", line.quote):
        values = values @ J[which].T
    V = RNG.normal(0, 1, (3, 5))
    return bool(np.allclose((values @ force) @ speeds[there] @ V, force @ speeds[here] @ V))


# Energies and speeds of Evr@: point masses, and frames turned by small steps.


def energy(paper, line):
    w, v, g, place = RNG.normal(0, 1, (4, 3))
    axes = m.about_z(0.3) @ m.about_x(0.7)
    half = m.kinetic(w, v) / 2
    height = np.array([-g @ (place + axes @ r) for r in m.POINTS])
    low = np.linalg.solve(m.PARAMETERS, m.POINTS_AS_PARAMETERS @ height)
    known = {"omega": w, "V": v}
    for vector, letter in zip((g, *axes.T, place), "gsnaP", strict=True):
        known[letter] = vector
    rows = line.quote.startswith("uk")
    text = re.sub(r"^([eu]k|hs\^1 =)", "", line.quote).replace(",s", "")
    for cell, name in zip(text.split("|"), line.expected, strict=True):
        dot = re.fullmatch(r"(.*?)\^[0k](\w)k?\^T ?\^?[0k](\w)k", cell.strip())
        if dot:
            sign = {"-": -1.0, "1/2 ": 0.5}[dot[1]]
            printed = sign * known[dot[2]] @ known[dot[3]]
        else:
            each = {f"{n}{k + 1}": known[n][k] for n in ("omega", "V") for k in range(3)}
            printed = value(cell, each)
        wanted = (low if rows else half)[m.INERTIA.index(name)]
        if not np.isclose(printed, wanted):
            return False
    return True


def chain(angles, rows):
    frame = m.GROUND
    for name, angle in zip(rows, angles, strict=True):
        alpha = {"1": -np.pi / 2, "2": np.pi / 2, "3": np.pi / 2}[name[0]]
        theta = angle if name[0] != "3" else 0.0
        frame = frame.then(0, 0, alpha, 0, theta, 0)
    return frame


def spun(rows):
    angles, speeds = RNG.uniform(-1, 1, (2, len(rows)))
    frame = m.moving(lambda u: chain(u, rows), angles, speeds)
    known = {f"theta{k + 1}": x for k, x in enumerate(angles)}
    known |= {f"qd{k + 1}": x for k, x in enumerate(speeds)}
    return m.rigid(frame)[0], known


def rotation(paper, line):
    w, known = spun(line.expected)
    return bool(np.allclose([value(part, known) for part in line.quote.split(";")], w))


def element(paper, line):
    left, _, right = line.quote.partition("=")
    w, known = spun(line.expected)
    wanted = m.kinetic(w, np.zeros(3))[int(left.strip()[-1]) - 1] / 2
    return bool(np.isclose(value(right, known), wanted))


def column(paper, line):
    """Ten entries, with which the second link's row gives the first element of the third's."""
    entries = [float(x) for x in re.findall(r"\d", line.quote.partition("[")[2].partition("]")[0])]
    state = RNG.bit_generator.state
    above = m.kinetic(spun(line.expected[:-1])[0], np.zeros(3))
    RNG.bit_generator.state = state
    angles, speeds = RNG.uniform(-1, 1, (2, 2))
    frame = m.moving(lambda u: chain([*u, 0], line.expected), angles, speeds)
    wanted = m.kinetic(m.rigid(frame)[0], np.zeros(3))[0]
    return len(entries) == 10 and bool(np.isclose(above @ entries, wanted))


class Dot:
    """Numbers, vectors and matrices that `*` multiplies as they stand side by side."""

    def __init__(self, value):
        self.value = np.asarray(value)

    def __mul__(self, other):
        return Dot(np.dot(self.value, other.value))

    def __add__(self, other):
        return Dot(self.value + other.value)

    def __sub__(self, other):
        return Dot(self.value - other.value)

    def __neg__(self):
        return Dot(-self.value)

    def cross(self, other):
        return Dot(np.cross(self.value, other.value))


def side_by_side(text, letters):
    """`Mk Vk^T Vk`: the number or the vector."""
    text = text.replace("[", "(").replace("]", ")").replace("1/2", " half ").replace("2M", " two M")
    names = {f"v{k}": word for k, word in enumerate(sorted(letters, key=len, reverse=True))}
    for name, word in names.items():
        text = text.replace(word, f" {name} ")
    text = re.sub(r"(\w+) +x +(\w+)", r"\1.cross(\2)", text)
    text = re.sub(r"(?<=[\w)]) +(?=[\w(])", "*", text.strip())
    known = {name: Dot(letters[word]) for name, word in names.items()}
    return eval(text, {"half": Dot(0.5), "two": Dot(2.0)}, known).value


def recursion(paper, line):
    """A frame on a moving one, by a joint that turns and by one that slides; speeds by steps."""
    for slides in (0, 1):
        start = m.moving(
            lambda u: m.GROUND.then(u[0], u[1], u[2], u[3], u[4], u[5]), *RNG.uniform(-1, 1, (2, 6))
        )
        q, qd, row = 0.4, 1.7, (0.0, 0.0, *RNG.uniform(-1, 1, 2))
        joint = q + 1j * m.STEP * qd
        end = start.then(*row, *((0.3, joint) if slides else (joint, 0.3)))
        (w, v), (wk, vk) = m.rigid(start)[:2], m.rigid(end)[:2]
        R = end.turn.real.T @ start.turn.real
        P = start.turn.real.T @ (end.place - start.place).real
        letters = {
            "^kRk-1": R,
            "^k-1omegak-1": w,
            "^komegak-1": R @ w,
            "^k-1Vk-1": v,
            "^k-1Pk": P,
            "barsigmak": 1 - slides,
            "sigmak": slides,
            "qdk": qd,
            "^kak": np.array([0, 0, 1]),
        }
        result = side_by_side(line.quote, letters)
        if not np.allclose(result, wk if line.expected[0] == "angular" else vk):
            return False
    return True


def body(paper, line):
    """Energy of twelve points with masses."""
    masses, (w, v, g, place) = RNG.uniform(0.1, 1, 12), RNG.normal(0, 1, (4, 3))
    xx, xy, xz, yy, yz, zz, *first, mass = m.POINTS_AS_PARAMETERS @ masses
    axes = m.about_z(0.3) @ m.about_x(0.7)
    letters = {
        **{"omegak^T": w, "omegak": w, "Mk": mass, "Vk^T": v, "Vk": v, "MSk^T": first, "^0g^T": g},
        **{"^0Pk": place, "^0Ak": axes, "^kSk": np.array(first) / mass},
        "Jk": [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
    }
    height = -masses @ np.array([g @ (place + axes @ r) for r in m.POINTS])
    wanted = masses @ m.point_energies(w, v) / 2 if line.expected[0] == "E" else height
    return bool(np.allclose(side_by_side(line.quote, letters), wanted))


# The wrist: its own links in floats, torques by differences of energies.


JOINTS = 3
LETTERS = {
    body: ("m", "t1", "t2", "t3", *(f"J{i}{j}" for i in "123" for j in "123" if i <= j))
    for body in "abc"
}


def wrist(seed):
    rng = np.random.default_rng(seed)
    table = {f"{b}{n}": rng.uniform(0.1, 1) for b, names in LETTERS.items() for n in names}
    return table | {"al1": 0.2, "bl1": rng.uniform(0.1, 1)}


def triads(q):
    a = m.about_x(q[0])
    b = a @ m.about_y(q[1])
    return {"a": a, "b": b, "c": b @ m.about_x(q[2])}


def centres(q, p):
    axes = triads(q)
    crossing = p["al1"] * axes["a"][:, 0]
    origin = {"a": 0, "b": crossing, "c": crossing + p["bl1"] * axes["b"][:, 0]}
    return {x: origin[x] + axes[x] @ [p[f"{x}t{k}"] for k in (1, 2, 3)] for x in "abc"}


def bodies(q, qd, p):
    """{body: (velocity of the centre in n, w in the body, its axes)}."""
    z = np.asarray(q) + 1j * m.STEP * np.asarray(qd)
    values, at = {}, centres(z, p)
    for body, turn in triads(z).items():
        w = m.rigid(m.Frame(turn, at[body]))[0]
        values[body] = (at[body].imag / m.STEP, w, turn.real)
    return values


def inertia_of(body, p):
    return np.array([[p[f"{body}J{min(i, j)}{max(i, j)}"] for j in (1, 2, 3)] for i in (1, 2, 3)])


def mass_matrix(q, p):
    total = np.zeros((3, 3))
    columns = [bodies(q, e, p) for e in np.eye(3)]
    for body in "abc":
        v, w = (np.array([column[body][k] for column in columns]) for k in (0, 1))
        total += p[f"{body}m"] * v @ v.T + w @ inertia_of(body, p) @ w.T
    return total


def function(name, q, p):
    """g_i, J_ij or S_ijk (the whole coefficient of qd_j qd_k, j <= k; g = 1)."""
    at = [int(k) - 1 for k in name[1:]]
    if name[0] == "g":
        step = np.eye(3)[at[0]] * 1j * m.STEP
        height = sum(p[f"{b}m"] * centres(q + step, p)[b][2] for b in "abc")
        return height.imag / m.STEP
    if name[0] == "J":
        return mass_matrix(q, p)[at[0], at[1]]
    step = 1e-5
    slope = [
        (mass_matrix(q + step * e, p) - mass_matrix(q - step * e, p)) / (2 * step)
        for e in np.eye(3)
    ]
    i, j, k = at
    if j > k:
        return 0.0
    one = lambda j, k: (slope[k][i, j] + slope[j][i, k] - slope[i][j, k]) / 2  # noqa: E731
    return one(j, k) if j == k else one(j, k) + one(k, j)


def trigonometry(q):
    known = {f"s{k + 1}": np.sin(x) for k, x in enumerate(q)}
    return known | {f"c{k + 1}": np.cos(x) for k, x in enumerate(q)}


@cache
def fitted(name, seed):
    """{coefficient: value}: the robot file's monomials fitted to the function at random postures.

    Which monomials a coefficient has is the paper's numbering; that they suffice is checked.
    """
    table = robots_of("hanssen-2000")["wrist"].table
    p, qs = wrist(seed), np.random.default_rng(seed).uniform(-3, 3, (14, 3))
    names = table.closed.algebra.names[: table.closed.algebra.moving]
    items = [c for c in table.coefficients if c.function == name]
    powers = [[x for x in zip(names, c.exponents, strict=False) if x[1]] for c in items]
    known = [trigonometry(q) for q in qs]
    matrix = np.array([[prod(at[str(n)] ** e for n, e in p) for p in powers] for at in known])
    wanted = np.array([function(name, q, p) for q in qs])
    values = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
    assert np.allclose(matrix @ values, wanted, atol=1e-7)
    return {c.name: x for c, x in zip(items, values, strict=True)}


@cache
def coefficients(seed=7):
    table = robots_of("hanssen-2000")["wrist"].table
    return {n: x for f in table.closed.by_name for n, x in fitted(f, seed).items()}


def wrist_function(paper, line):
    name, _, text = line.quote.partition(" = ")
    known, p = coefficients(), wrist(7)
    for q in RNG.uniform(-3, 3, (5, 3)):
        printed = value(text, known | trigonometry(q))
        if not np.isclose(printed, function(name, q, p), atol=1e-6):
            return False
    return True


def definition(paper, line):
    name, _, text = line.quote.partition(" = ")
    return bool(np.isclose(value(text, wrist(7)), coefficients()[name], atol=1e-6))


def solution(paper, line):
    name, _, text = line.quote.partition(" = ")
    above, _, below = text.partition(" over ")
    known = wrist(7) | coefficients()
    under = value(below or "1", known)
    return abs(under) > 1e-6 and bool(np.isclose(value(above, known) / under, wrist(7)[name]))


def independent(paper, line):
    """The rank of the coefficients' values over many wrists."""
    by_name = robots_of("hanssen-2000")["wrist"].table.by_name
    names = line.quote.split(", ")
    rows = [[fitted(by_name[n].function, seed)[n] for n in names] for seed in range(20, 41)]
    return np.linalg.matrix_rank(np.array(rows), tol=1e-6) == len(names)


def vector(text, q, p, qd):
    """`-at3 qd1 a2 + ...` in n."""
    known = p | trigonometry(q) | {f"qd{k + 1}": x for k, x in enumerate(qd)}
    known |= {f"tau{k}": 1.0 + k for k in (1, 2, 3)}
    axes = {
        f"{b}{k + 1}": t[:, k] for b, t in (triads(q) | {"n": np.eye(3)}).items() for k in range(3)
    }
    axes |= {f"v^CM{b}": v for b, (v, _, _) in bodies(q, qd, p).items()}
    total, depth, terms = np.zeros(3), 0, [""]
    for letter in text:
        depth += {"(": 1, ")": -1}.get(letter, 0)
        terms += [""] * (letter in "+-" and depth == 0)
        terms[-1] += letter
    for term in terms:
        if term.strip():
            factor, _, axis = term.strip().rpartition(" ")
            total = total + value(f"{factor} 1", known) * axes[axis]
    return total


def velocity(paper, line):
    """Velocities, their changes with one speed, and momenta, by complex steps of the places."""
    q, qd, p = *RNG.uniform(-1, 1, (2, 3)), wrist(8)
    for name, cell in zip(line.expected, line.text.split(";"), strict=True):
        row = re.fullmatch(r"(beta|p)(\d)(\d?)", name)
        which = "abc"[(int(row[2]) - 1) // 2] if row else name[-1].lower()
        turns = int(row[2]) % 2 == 0 if row else name.startswith("omega")
        speed = np.eye(3)[int(row[3]) - 1] if row and row[3] else qd
        v, w, turn = bodies(q, speed, p)[which]
        if row and row[1] == "p":
            v, w = p[f"{which}m"] * v, inertia_of(which, p) @ w
        if not np.allclose(vector(cell, q, p, qd), turn @ w if turns else v):
            return False
    return True


def applied(paper, line):
    """Power of the printed forces beside that of motors between bodies and of weights, g = 1."""
    q, qd, p = *RNG.uniform(-1, 1, (2, 3)), wrist(9)
    cells, power = line.quote.split(";"), 0.0
    for k, body in enumerate("abc"):
        v, w, turn = bodies(q, qd, p)[body]
        power += vector(cells[2 * k], q, p, qd) @ v
        power += vector(cells[2 * k + 1], q, p, qd) @ (turn @ w)
    weights = -sum(qd[i] * function(f"g{i + 1}", q, p) for i in range(3))
    return bool(np.isclose(power, qd @ np.array([2.0, 3.0, 4.0]) + weights))


def indices(paper, line):
    """Every term, summed over what stands twice, has one number for each i: each i stands once."""
    return all(
        re.findall(
            r"[ijk]", "".join(re.findall(r"(?:J|S|G|C|g|tau|ddotq|qd)([ijk]+)", term))
        ).count("i")
        == 1
        for term in re.split(r"[+=]", line.quote)
    )


def friction(paper, line):
    """What coupled motors take is C |motor speed|."""
    letters = re.fullmatch(r"G(\w\w) C(\w\w) sgn\(qd(\w)\)", line.quote)
    G, C = np.tril(RNG.normal(0, 1, (3, 3))), np.diag([3.0, 2.0, 1.2])
    qd = RNG.normal(0, 1, 3)
    torque = np.einsum(f"{letters[1]},{letters[2]},{letters[3]}->i", G, C, np.sign(qd))
    return bool(np.isclose(qd @ torque, np.diag(C) @ np.abs(G @ qd)))


# Counts and lists of names: columns that are 0, ranks.


def numbers(paper, line):
    wanted = COUNTS.get(line.quote)
    return (
        None if wanted is None else [float(n.value) for n in read_numbers(line.quote)] == wanted()
    )


def names(paper, line):
    wanted = NAMES.get(line.place)
    if wanted is None:
        return None
    actual = set(re.findall(r"\b(?!and\b)[A-Za-z]\w*", line.quote)) - {"0"}
    return {name.removeprefix("h") for name in actual} == wanted()


def without_effect(pattern):
    table = m.columns("evra")
    return {n for n, x in table.items() if re.fullmatch(pattern, n) and not np.any(abs(x) > 1e-9)}


def grouped_within(own, before):
    """Prefixes of a link that are combinations of those before, or of no effect at all."""
    table = m.columns("evra")
    stored = robots_of("houda")["evra"].independent_parameters
    others = [table[f"{p}{before}"] for p in m.INERTIA]
    others += [table[f"{p}{own}"] for p in m.INERTIA if f"{p}{own}" in stored]
    return {
        p
        for p in m.INERTIA
        if f"{p}{own}" not in stored
        and np.any(abs(table[f"{p}{own}"]) > 1e-9)
        and m.within(table[f"{p}{own}"], others)
    }


def eliminated():
    each = [len(without_effect(f"[A-Z]+{body}")) for body in ("s1", "11")]
    return [float(len(without_effect(".*"))), float(each[0]), 2.0, float(each[1]), 6.0]


def wrist_rank():
    p, table = wrist(7), robots_of("hanssen-2000")["wrist"].table
    rows = []
    for letter in p:
        moved = [values_at(p | {letter: p[letter] + sign * 1e-5}, table) for sign in (1, -1)]
        rows.append((moved[0] - moved[1]) / 2e-5)
    appearing = [letter for letter, row in zip(p, rows, strict=True) if np.any(abs(row) > 1e-6)]
    return appearing, int(np.linalg.matrix_rank(np.array(rows), tol=1e-5)), set(p) - set(appearing)


def values_at(p, table):
    """g, J and S at some postures: all that is observable."""
    qs = np.random.default_rng(1).uniform(-3, 3, (6, 3))
    rows = [[*mass_matrix(q, p).ravel(), *(function(f"g{k}", q, p) for k in (1, 2, 3))] for q in qs]
    return np.concatenate(rows)


WRIST = cache(wrist_rank)
COUNTS = {
    "(5 parameters eliminated by leg)": lambda: [float(len(without_effect("[A-Z]+11")))],
    "(9 parameters eliminated)": lambda: [float(len(without_effect("[A-Z]+s1")))],
    "48 (9 x 2 + 5 x 6) standard inertial parameters are eliminated": eliminated,
    "72 standard inertial parameters are grouped, 12 by leg": lambda: [
        210.0 - m.rank(list(m.columns("evra").values())) - len(without_effect(".*")),
        (210.0 - m.rank(list(m.columns("evra").values())) - len(without_effect(".*"))) / 6,
    ],
    "90 parameters instead of 210 standard inertial parameters": lambda: [
        float(m.rank(list(m.columns("evra").values()))),
        float(len(m.columns("evra"))),
    ],
    "the total number of parameters is 43": lambda: [
        float(m.rank(list(m.columns("orthoglide-2003").values())))
    ],
    "There are 14 base parameters": lambda: [
        float(m.rank(list(m.columns("orthoglide-leg").values())))
    ],
    "The wrist model contains 25 physical parameters": lambda: [float(len(WRIST()[0]))],
    "7 of these parameters": lambda: [float(len(WRIST()[2]))],
    "The 96 parameters (PG, PJ and PS)": lambda: [float(len(coefficients()))],
    "The following 18 independent equations": lambda: [float(WRIST()[1])],
    "From these, 18 physical parameters can be identified directly. The remaining 7 "
    "parameters": lambda: [float(WRIST()[1]), float(len(WRIST()[0]) - WRIST()[1])],
    "Of these 25 parameters, we are able to identify 18 parameters, given initial estimates of the "
    "remaining 7 parameters": lambda: [
        float(n) for n in (len(WRIST()[0]), WRIST()[1], len(WRIST()[0]) - WRIST()[1])
    ],
}


def zero_functions():
    q, p = np.array([0.3, -0.8, 1.1]), wrist(7)
    every = (f"S{i}{j}{k}" for i, j, k in product("123", repeat=3))
    return {n for n in every if abs(function(n, q, p)) < 1e-6}


NAMES = {
    "section 3": lambda: WRIST()[2],
    "section 2.2": zero_functions,
    "section 3, below eq. (5)": lambda: {"Gamma2i", "Gamma3i"},  # eq. (6): [Gamma1i 0 0]
    "Proposition 3, sliding joints": lambda: {n[:-2] for n in without_effect("[A-Z]+s1")},
    "Proposition 3, first link of a leg": lambda: {n[:-2] for n in without_effect("[A-Z]+11")},
    "Proposition 3, first rotational link": lambda: grouped_within("11", "s2"),
    "Proposition 3, second rotational link": lambda: grouped_within("21", "11"),
    "Proposition 3, prismatic link": lambda: grouped_within("31", "21"),
}


def arithmetic(paper, line):
    """Table 3 of 2003: a relative sigma has the sign of the value, eq. (37)."""
    values = [float(n.value) for n in read_numbers(line.quote)]
    if line.expected != ("b = abs(b)*a/abs(a)",):
        return None
    return values[-2] * values[-1] > 0


ORACLES = {
    "relation": relation, "row": row, "closure": closure, "platform": platform, "effort": effort,
    "energy": energy, "rotation": rotation, "element": element, "column": column, 
    "recursion": recursion, "body": body,
    "function": wrist_function, "definition": definition, "solution": solution,
    "independent": independent, "velocity": velocity, "applied": applied, "indices": indices,
    "friction": friction, "numbers": numbers, "names": names, "arithmetic": arithmetic,
}  # fmt: skip
