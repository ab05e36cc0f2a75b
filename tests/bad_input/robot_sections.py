"""Robot files: symbols, effects, couplings, values, limits."""

from tests.bad_input.robot_texts import MAGNET, SERIAL, derived, edited, refusals, writes
from tests.bad_input.row import row

_DEEP = "sin(" * 200 + "q" + ")" * 200

SYMBOLS = refusals(
    "symbols", SERIAL,
    [
        ("a joint variable", "g = 9.81", "g = 9.81\nq1 = 1", "[symbols]", "q1"),
        ("value a table", "D3 = 0.45", "D3 = {a = 1}", "[symbols], D3"),
        ("value true", "D3 = 0.45", "D3 = true", "[symbols], D3"),
        ("value nan", "D3 = 0.45", "D3 = nan", "[symbols], D3", "nan"),
        ("value inf", "D3 = 0.45", "D3 = inf", "[symbols], D3", "inf"),
        ("value empty", "D3 = 0.45", 'D3 = ""', "[symbols], D3"),
        ("value of an undeclared one", '"D3 / 2"', '"D4 / 2"', "[symbols], R4", "D4"),
        ("symbols a list", "[symbols]", "[terms.x]\n[[symbols]]", "[symbols]", "table"),
    ],
) + derived(
    "symbols", SERIAL,
    [
        ("worth zero", "D3 = 0.45", "D3 = 0"),
        ("negative", "D3 = 0.45", "D3 = -0.45"),
        ("one that nobody uses", "g = 9.81", "g = 9.81\nspare = 1"),
        ("an angle worth pi/2", 'tilt = "pi/6"', "tilt = 1.5707963267948966"),
        ("an integer", "D3 = 0.45", "D3 = 1"),
    ],
)  # fmt: skip

EFFECTS = refusals(
    "effects", SERIAL,
    [
        ("misspelt", "viscous =", "viscus =", "viscus", "viscous"),
        ("a list of tables", "[effects]", "[[effects]]", "[effects]", "table"),
        ("joint unknown", 'coulomb = ["1", "2"]', 'coulomb = ["1", "5"]', "coulomb", '"5"'),
        ("joint twice", 'coulomb = ["1", "2"]', 'coulomb = ["1", "1"]', "coulomb", "twice"),
        ("joint a number", 'coulomb = ["1", "2"]', "coulomb = 1", "coulomb", "got 1"),
        ("joint a word", 'coulomb = ["1", "2"]', 'coulomb = "1"', "coulomb", '"1"'),
        ("true", 'viscous = "all"', "viscous = true", "viscous", "true"),
        ("ALL", 'viscous = "all"', 'viscous = "ALL"', "viscous", "ALL", '"all"'),
        ("shape unknown", "vs = 0.1, d = 2", "vs = 0.1, e = 2", "stribeck", "e"),
        ("shape missing", "vs = 0.1, d = 2", "vs = 0.1", "stribeck", "d"),
        ("shape a text", "vs = 0.1", 'vs = "fast"', "stribeck", "vs"),
        ("shape nan", "vs = 0.1", "vs = nan", "stribeck", "vs"),
        ("shape zero", "vs = 0.1", "vs = 0", "stribeck", "vs"),
        ("shape negative", "vs = 0.1", "vs = -0.1", "stribeck", "vs"),
        ("shape a list", "vs = 0.1", "vs = [0.1]", "stribeck", "vs"),
        ("shapes without joint", '{joint = "1", vs', '{vs', "stribeck", "joint"),
        ("shapes left out", 'stribeck = [{joint = "1", vs = 0.1, d = 2}]', 'stribeck = "all"',
         "stribeck", "vs"),
        ("ripple twice the same", '{joint = "2", m = 14}', '{joint = "2", m = 7}', "motor_ripple"),
        ("ripple of order 0", "m = 14", "m = 0", "motor_ripple", "m"),
        ("shapes of an effect without", 'viscous = "all"', 'viscous = [{joint = "1", m = 1}]',
         "viscous"),
        ("no column: payload", 'viscous = "all"', 'payload = "all"', "payload"),
        ("no column: time_delay", 'viscous = "all"', 'time_delay = "all"', "time_delay"),
        ("coupling of an unknown joint", '2 = "q1 +', '5 = "q1 +', "[coupling]", '"5"'),
        ("coupling unknown", '"q1 + 2*q2"', '"q2 + q9"', "[coupling]", "q9"),
    ],
) + derived(
    "effects", SERIAL,
    [
        ("an empty list of joints", 'coulomb = ["1", "2"]', "coulomb = []"),
        ("by alias", "viscous =", "back_emf ="),
    ],
)  # fmt: skip

OWN = refusals(
    "own effects", MAGNET,
    [
        ("no columns", 'columns = { Keb = "v*exp(-((q - c)/w)**2)" }\n', "", "columns", "missing"),
        ("columns a text", '{ Keb = "v*exp(-((q - c)/w)**2)" }', '"v"', "columns"),
        ("equation a list", '"v*exp(-((q - c)/w)**2)"', "[1]", "Keb"),
        ("equation unfinished", "**2)", "**2", "Keb"),
        ("equation of an unknown", "v*exp", "u*exp", "Keb", "u"),
        ("equation with an unused shape", "v*exp(-((q - c)/w)**2)", "v*c", "w"),
        ("equation that explodes at rest", "v*exp(-((q - c)/w)**2)", "c*w/v", "Keb"),
        ("parameter named as another", "Keb =", "Fv =", "Fv"),
        ("parameter with a digit last", "Keb =", "Keb2 =", "Keb2"),
        ("id of the catalogue", "[own_effects.eddy_brake]", "[own_effects.viscous]", "viscous"),
        ("id with a dash", "[own_effects.eddy_brake]", "[own_effects.eddy-brake]", "eddy-brake"),
        ("shape without values", "c = [-1, 0, 1]", "c = []", "c"),
        ("shape a text", "c = [-1, 0, 1]", 'c = "wide"', "c", "wide"),
        ("shape nan", "c = [-1, 0, 1]", "c = [nan]", "c", "nan"),
        ("shape twice the same value", "c = [-1, 0, 1]", "c = [1, 1]", "c"),
        ("shapes in 10000 combinations", "c = [-1, 0, 1]",
         f"c = {[k / 100 for k in range(5000)]}", "100"),
        ("shape called q", "shapes = { c", "shapes = { q", "q"),
        ("unknown key", "unit =", "units =", "units", "unit"),
        ("unit a number", 'unit = "N*m*s/rad"', "unit = 3", "unit"),
        ("nonnegative a text", "nonnegative = true", 'nonnegative = "yes"', "nonnegative"),
        ("acts unknown", "nonnegative = true", 'acts = "force"', "acts", "force"),
        ("acts on the position with speed", "nonnegative = true", 'acts = "position"', "v"),
        ("load without reference", "v*exp(-((q - c)/w)**2)", "load*c*w", "reference"),
        ("used without its shape", "c = 0.7, w", "w", "c"),
        ("used with one shape more", "c = 0.7, w", "c = 0.7, e = 1, w", "e"),
        ("own_effects a list", "[own_effects.eddy_brake]", "[[own_effects]]", "own_effects"),
        ("definition a number", "[own_effects.eddy_brake]", "[own_effects]\nx = 1\n[terms.x]",
         "own_effects"),
    ],
)  # fmt: skip

VALUES = refusals(
    "values", SERIAL,
    [
        ("unknown parameter", "ZZ1 = 0.5", "ZZ9 = 0.5", "[parameters]", "ZZ9"),
        ("parameter of an absent effect", "ZZ1 = 0.5", "Off1 = 1", "[parameters]", "Off1"),
        ("parameter inf", "ZZ1 = 0.5", "ZZ1 = inf", "[parameters], ZZ1", "inf"),
        ("parameter true", "ZZ1 = 0.5", "ZZ1 = true", "[parameters], ZZ1"),
        ("sigma of nothing", "Fv1 = 2\n", "Fv1 = 2\nuncertainty.ZZ9 = 1\n", "uncertainty], ZZ9"),
        ("sigma nan", "Fv1 = 2\n", "Fv1 = 2\nuncertainty.Fv1 = nan\n", "uncertainty], Fv1", "nan"),
        ("sigma true", "Fv1 = 2\n", "Fv1 = 2\nuncertainty = true\n", "[parameters.uncertainty]"),
        ("held a table", "Fv1 = 2\n", "Fv1 = 2\nheld.Fv1 = 1\n", "[parameters], held"),
        ("parameters a list", "[parameters]", "[[parameters]]", "[parameters]"),
        ("gain of an unknown joint", "1 = 12.5", "8 = 12.5", "[drive_gains]", '"8"'),
        ("gain nan", "1 = 12.5", "1 = nan", "[drive_gains]", "nan"),
        ("limits of an unknown joint", '1 = ["-pi",', '9 = ["-pi",', "[limits]", '"9"'),
        ("limits inf", "2.5, 3, 10", "inf, 3, 10", "[limits]", "inf"),
        ("limits nan", "2.5, 3, 10", "2.5, nan, 10", "[limits]", "nan"),
        ("limits a number", '["-pi", 2.5, 3, 10]', "3", "[limits]", "got 3"),
        ("limits undeclared", '["-pi", 2.5', '["-PI", 2.5', "[limits]", "PI"),
        ("reference of an unknown", "[limits]", "[reference]\nZZ77 = 1\n[limits]", "ZZ77"),
        ("reference a text", "[limits]", '[reference]\nZZ1 = "x"\n[limits]', "[reference]"),
        ("physical of an unknown joint", "[limits]", "[physical.7]\n[limits]", "[physical]", '"7"'),
        ("terms a list", "[limits]", "[[terms]]\n[limits]", "[terms]"),
    ],
) + derived(
    "values", SERIAL,
    [
        ("negative mass", "ZZ1 = 0.5", "M1 = -3"),
        ("home of a robot without loops", "[limits]", "[home]\nq1 = 0.1\n[limits]"),
        ("negative gain", "1 = 12.5", "1 = -12.5"),
        ("table of values empty", "ZZ1 = 0.5\nFv1 = 2\n", ""),
    ],
)  # fmt: skip

DEEP = [
    row("symbols: nested 200 deep", "ends", "derive arm.toml --no-terms", "arm",
        make=writes("arm.toml", edited(SERIAL, "0.45", f'"{_DEEP.replace("q", "1")}"'))),
    row("own effects: equation nested 200 deep", "ends", "derive magnet.toml --no-terms", "magnet",
        make=writes("magnet.toml", edited(MAGNET, "v*exp", f"{_DEEP}*exp"))),
    row("own effects: equation nested 200 deep, in C", "ends", "generate magnet.toml --out c",
        "magnet", make=writes("magnet.toml", edited(MAGNET, "v*exp", f"{_DEEP}*exp"))),
]  # fmt: skip

ROWS = [*DEEP, *SYMBOLS, *EFFECTS, *OWN, *VALUES]
