"""Robot files: legs, relations, platforms, loops, homes, links."""

from tests.bad_input.robot_texts import CRANK, LEGS, derived, edited, refusals, writes
from tests.bad_input.row import row

LOOPS = refusals(
    "loops", CRANK,
    [
        ("a list", "[loops]", "[[loops]]", "[loops]"),
        ("no columns", 'columns = ["loop"', 'cols = ["loop"', "[loops]", "cols"),
        ("no rows", 'rows = [\n  ["pin"', 'lines = [\n  ["pin"', "[loops]", "lines"),
        ("rows empty", '  ["pin",  "tip",   "3",     "position"],\n', "", "[loops]"),
        ("row short", '"3",     "position"', '"3"', "[loops]", "3 entries|cells"),
        ("joint unknown", '"position"],', '"ball"],', "ball", "spherical"),
        ("joint misspelt", '"position"],', '"postion"],', "postion", "position"),
        ("frame unknown", '["pin",  "tip"', '["pin",  "top"', "top", "tip"),
        ("frame meets itself", '"tip",   "3"', '"tip",   "tip"', "tip"),
        ("meets unknown", '"tip",   "3"', '"tip",   "9"', '"9"'),
        ("name twice", '"position"],', '"position"], ["pin", "tip", "3", "position"],', "pin"),
        ("too few motors", '["1",   "0",  1', '["1",   "0",  0', "actuated"),
        ("too many motors", '["3",   "0",  0', '["3",   "0",  1', "over-constrained", "pin"),
        ("rigid where it cannot be", '"position"],', '"rigid"],', "over-constrained|pin"),
    ],
)  # fmt: skip

HOME = refusals(
    "home", CRANK,
    [
        ("unknown variable", "q2 = -1.86", "q9 = -1.86", "[home]", "q9"),
        ("joint for its variable", "q2 = -1.86", "2 = -1.86", "[home]", "2"),
        ("a text", "q2 = -1.86", 'q2 = "left"', "[home]", "left"),
        ("nan", "q2 = -1.86", "q2 = nan", "[home]", "nan"),
        ("inf", "q2 = -1.86", "q2 = inf", "[home]", "inf"),
        ("a list", "[home]", "[[home]]", "[home]"),
        ("in degrees", "q2 = -1.86", "q2 = -106", "home"),
    ],
)  # fmt: skip

LEG = refusals(
    "legs", LEGS,
    [
        ("a text", 'legs = ["1", "2"]', 'legs = "12"', "legs"),
        ("a number", 'legs = ["1", "2"]', "legs = 2", "legs", "got 2"),
        ("empty", 'legs = ["1", "2"]', "legs = []", "legs"),
        ("twice the same", 'legs = ["1", "2"]', 'legs = ["1", "1"]', "legs", "twice"),
        ("with a space", 'legs = ["1", "2"]', 'legs = ["1", "leg 2"]', "leg 2"),
        ("none said", 'legs = ["1", "2"]\n', "", "{i}|legs"),
        ("shared a text", 'shared = ["*1{i}"]', 'shared = "*1{i}"', "shared", "list"),
        ("shared matches none", '"*1{i}"', '"*7{i}"', "shared", "*7{i}"),
        ("shared without the leg", '"*1{i}"', '"ZZ11"', "shared"),
    ],
)  # fmt: skip

RELATIONS = refusals(
    "relations", LEGS,
    [
        ("of an unknown", 'q22 = "-q21"', 'q99 = "-q21"', "[relations]", "q99"),
        ("to an unknown", 'q22 = "-q21"', 'q22 = "-q99"', "[relations]", "q99"),
        ("not linear", 'q22 = "-q21"', 'q22 = "q21**2"', "[relations]", "linear"),
        ("to itself", 'q22 = "-q21"', 'q22 = "q22"', "q22"),
        ("in a circle", 'q22 = "-q21"', 'q22 = "-q21"\nq21 = "-q22"', "circle|follow"),
        ("a number", 'q22 = "-q21"', "q22 = [3]", "[relations]"),
        ("of an actuated joint", 'q22 = "-q21"', 'q12 = "-q11"\nq22 = "-q21"', "actuated|mu"),
        ("a list", "[relations]", "[[relations]]", "[relations]"),
        ("empty text", 'q22 = "-q21"', 'q22 = ""', "[relations]"),
    ],
)  # fmt: skip

PLATFORM = refusals(
    "platform", LEGS,
    [
        ("motion unknown", '"planar"', '"flying"', "[platform]", "flying", "planar"),
        ("motion missing", 'motion = "planar"\n', "", "[platform]", "motion"),
        ("name missing", 'name = "P"\n', "", "[platform]", "name"),
        ("name of a row", 'name = "P"', 'name = "11"', "11"),
        ("name with a space", 'name = "P"', 'name = "P 1"', "P 1"),
        ("name 0", 'name = "P"', 'name = "0"', "P"),
        ("unknown key", "motion =", "moves =", "moves", "motion"),
        ("a list", "[platform]", "[[platform]]", "[platform]"),
        ("nothing holds it", '"4{i}", "revolute"', '"3{i}", "revolute"',
         "platform|degrees of freedom|P|loop"),
        ("link unknown", 'P = ["M"]', 'Q = ["M"]', "[links]", "Q"),
        ("link parameter unknown", 'P = ["M"]', 'P = ["Mass"]', "[links]", "Mass"),
        ("link a text", 'P = ["M"]', 'P = "M"', "[links]", "list"),
        ("link a number", 'P = ["M"]', "P = [1]", "[links]"),
    ],
)  # fmt: skip

ODD = derived(
    "loops", CRANK,
    [
        ("as it is", "crank", "crank", "8 base"),
        ("home with the rod in line with the crank", "q2 = -1.86", "q2 = 0", "8 base"),
        ("loop whose name is a number", '["pin"', "[3", "8 base"),
        ("home far away", "q3 = 0.33", "q3 = 1e12", "[home] completed", "8 base"),
        ("home out of reach", "L = 0.35", "L = 0.01", "[home] completed", "8 base"),
        ("home left out", '\n[home]\nq1 = "pi/2"\nq2 = -1.86\nq3 = 0.33\n', "", "crank"),
        ("loop described from the other side", '"tip",   "3"', '"3",   "tip"', "8 base"),
        ("home a turn off", "q2 = -1.86", "q2 = 4.4232", "8 base"),
    ],
)  # fmt: skip

TWINS = derived("legs", LEGS, [("as they are", "twins", "twins", "base parameters")])

_MANY = edited(LEGS, '["1", "2"]', str([str(k) for k in range(1, 3001)])).replace("B{i}", "L")

MANY = row(
    "legs: 3000 of them", "refused", "derive twins.toml", "legs|rows|joints", "3000|6000|9000",
    make=writes("twins.toml", _MANY.replace("W{i}", "L")),
)  # fmt: skip

ROWS = [MANY, *TWINS, *LOOPS, *HOME, *LEG, *RELATIONS, *PLATFORM, *ODD]
