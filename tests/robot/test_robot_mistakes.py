"""Every mistake in a robot file is reported in one line: where, got, expected, what to do."""

import random

import pytest

from modeler.core.choices import list_builtin_robots, read_builtin_robot
from modeler.core.errors import RobotError
from modeler.formats import read_robot
from modeler.formats.par_convert import convert_par_file
from modeler.robot.read import parse_robot_text
from tests.robot.par_files import BOOM, par_text
from tests.robot.texts import (
    ARM,
    COUPLED,
    FIVE_BAR,
    LAW,
    MOTORS,
    OWN_EFFECTS,
    PLANAR,
    check_mistake,
)
from tests.rotation import with_cases

D = '0, "D3"'
V, U = "Fv1 = 2\n", "[parameters.uncertainty]"
EDDY = 'columns = {Keb = "v*exp(-((q - c)/w)**2)"}'
HOOK, TRAVEL = 'columns = {Kh = "z*cos(q)"}', "shapes = {d = [0.01, 0.1]}"
FIRST = "[own_effects.eddy_brake]"
TABLE = "{low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}"
TWO_AXES = "{low = [0, 0], high = [1, 1], cells = [1, 1], values = [%s]}" % ("1, " * 16)
RUB = "[effects]\npassive_friction = "

# (what is wrong, old text, new text, pieces of the message in this order)
IN_ARM = [
    ("unclosed text", 'title = "Arm for tests"', 'title = "Arm', "line 2, column 13 .. not TOML"),
    ("file ends early", 'PG1 = "m1*x1"', 'PG1 = """', "line .. not TOML"),
    ("no name", 'name = "arm"\n', "", 'name: is missing .. name = "arm"'),
    ("name no text", 'name = "arm"', "name = 3", "name: got 3 .. letters, digits"),
    ("name with space", 'name = "arm"', 'name = "my arm"', 'name: got "my arm" .. expected'),
    ("empty title", '"Arm for tests"', '""', 'title: got "" .. expected text'),
    ("unknown key", "notes =", "note =", 'unknown key "note" .. did you mean "notes"?'),
    ("mdh no table", "[mdh]", "[terms.x]\n[[mdh]]", "[mdh]: got [{ .. expected a table"),
    ("mdh key", "rows = [\n", "row = [\n", '[mdh] .. unknown key "row" .. did you mean "rows"?'),
    ("no columns", "columns = [", "#", "[mdh]: columns is missing .. columns = ["),
    ("bad column", '"alpha", "d"', '"alfa", "d"', 'columns .. "alfa" .. did you mean "alpha"?'),
    ("column twice", '"sigma", "alpha"', '"sigma", "d"', 'columns: "d" stands twice .. remove'),
    ("no j", 'columns = ["j",', 'columns = ["b",', 'column "j" .. is missing .. add it'),
    ("short row", 'pi/2 - q2", 0]', 'pi/2 - q2"]', 'row 2 ("2") .. got 7 cells .. 8 .. add 1'),
    ("row no list", '["1", "0", 1, 0, 0, 0, "q1", 0]', "7", "row 1 .. got 7 .. expected a list"),
    ("row twice", '["2", "1"', '["1", "1"', 'row "1" .. rows 1 and 2 .. its own name'),
    ("row 0", '["1", "0"', '["0", "0"', 'row 1, column j .. got "0" .. is the base'),
    ("row name", '["1", "0"', '["1-a", "0"', 'row 1, column j .. got "1-a" .. letters and digits'),
    ("row name true", '["1", "0"', '[true, "0"', "column j: got true .. expected a name"),
    ("q of another", '["E", "4"', '["d1", "4"', 'row "d1" .. qd1 mean two things .. row "1"'),
    ("no antecedent", '["3", "2"', '["3", "7"', 'row "3", column a .. got "7" .. (1, 2)'),
    ("circle", '["2", "1"', '["2", "4"', 'row "2" .. circle 2 -> 4 -> 3 -> 2 .. end at "0"'),
    ("sigma 3", '"1", "0", 1, 0', '"1", "0", 1, 3', 'row "1", column sigma .. got 3 .. 0 (rev'),
    ("mu 2", '"1", "0", 1, 0', '"1", "0", 2, 0', 'row "1", column mu .. got 2 .. 0 (passive)'),
    ("fixed motor", '"E", "4", 0', '"E", "4", 1', 'row "E", column mu .. got 1 .. write 0'),
    ("undeclared", '0, "D3"', '0, "D33"', 'row "3", column d .. got "D33" .. mean "D3"?'),
    ("far symbol", '0, "D3"', '0, "zeta"', "zeta is not declared .. declare it in [symbols]"),
    ("not arithmetic", '0, "D3"', '0, "D3^2"', 'column d .. got "D3^2" .. powers as x**2'),
    ("infinite", '0, "D3"', "0, inf", "column d .. got inf .. finite"),
    ("huge", '0, "D3"', '0, "1e400"', "column d .. 1e400 .. too large"),
    ("division by 0", '0, "D3"', '0, "1/(D3-D3)"', "column d .. no finite real value .. divisors"),
    ("root of -1", '0, "D3"', '0, "sqrt(-D3)"', "column d .. no finite real value .. roots"),
    ("no real power", D, '0, "(-D3)**0.5"', "column d .. no finite real value"),
    ("power of 0", D, '0, "0**-1"', "column d .. no finite real value"),
    ("no q in r", '"q3 + R4"', '"R4"', 'row "3", column r .. got "R4" .. expected q3'),
    ("q in d", '0, 0, "q1", 0]', '0, "q1", "q1", 0]', 'row "1", column d .. column theta .. move'),
    ("q of another row", '"q1", 0]', '"q1 + q2", 0]', 'row "1" .. another row .. follows'),
    ("q of fixed", '0.1, "pi", 0', '0.1, "qE", 0', 'row "E", column theta .. sigma 2 .. remove qE'),
    ("sin q", '0, "q1", 0]', '0, "sin(q1)", 0]', "theta .. sin(q1) .. not linear .. q1 + pi/2"),
    ("q squared", '0, "q1", 0]', '0, "q1**2", 0]', "column theta .. q1**2 .. not linear"),
    ("1 over q", '0, "q1", 0]', '0, "1/q1", 0]', "column theta .. 1/q1 .. not linear"),
    ("2 q", '0, "q1", 0]', '0, "2*q1", 0]', "column theta .. coefficient 2 .. expected 1 or -1"),
    ("degrees", '"pi/2", 0, "pi', '90, 0, "pi', "alpha .. 90 rad is more than a turn .. radians"),
    ("symbol q1", "D3 = 0.45", "D3 = 0.45\nq1 = 1", '[symbols] .. "q1" .. joint variable'),
    ("symbol pi", "D3 = 0.45", "D3 = 0.45\npi = 3", '[symbols] .. "pi" .. number pi'),
    ("symbol sin", "D3 = 0.45", "D3 = 0.45\nsin = 3", '[symbols] .. "sin" .. a function'),
    ("symbol MX1", "D3 = 0.45", "D3 = 0.45\nMX1 = 3", '[symbols] .. "MX1" .. standard parameter'),
    ("symbol double", "D3 = 0.45", "D3 = 0.45\ndouble = 3", '"double" .. C language'),
    ("symbol name", "D3 = 0.45", 'D3 = 0.45\n"a b" = 3', '[symbols] .. "a b" .. expected a letter'),
    ("symbol value", "D3 = 0.45", "D3 = [1]", "[symbols], D3 .. got [1] .. expected a number"),
    ("symbol unknown", '"D3 / 2"', '"D4 / 2"', "[symbols], R4 .. D4 is not .. among g, D3, R4"),
    ("symbols circle", "D3 = 0.45", 'D3 = "R4"', "[symbols] .. D3, R4 .. circle .. a number"),
    ("symbol 1/0", "D3 = 0.45", 'D3 = "1/0"', "[symbols], D3 .. no finite real value"),
    ("2 entries", '[0, 0, "-g"]', '[0, "-g"]', "gravity: got 2 entries, expected 3 .. add 1"),
    ("a number", '[0, 0, "-g"]', "9.81", "gravity: got 9.81 .. expected a list"),
    ("moving", '[0, 0, "-g"]', '[0, 0, "q1"]', "gravity, entry 3 .. joint variable q1"),
    ("motors no table", "notes =", "motors = 3\nnotes =", "[motors]: got 3; expected a table"),
    ("effect", "viscous =", "viscus =", '[effects] .. "viscus" .. did you mean "viscous"'),
    ("effects list", "[effects]", "[[effects]]", "[effects]: got [{ .. expected a table"),
    ("alias twice", "[effects]", '[effects]\nback_emf = "all"', "is viscous .. keep one"),
    ("effect joint", '["1", "2"]', '["1", "5"]', 'rotor_inertia .. joint "5" .. 1, 2, 3, 4'),
    ("joint twice", '["1", "2"]', '["1", "1"]', 'rotor_inertia .. "1" stands there twice'),
    ("joints word", '["1", "2"]', '"1"', 'rotor_inertia .. got "1" .. "all" or ["1", "2"]'),
    ("no coupling", '[coupling]\n2 = "q1 + 2*q2"', "", "friction .. add a table [coupling]"),
    ("uncoupled", '_friction = "all"', '_friction = ["3"]', '"3" has no line in [coupling]'),
    ("coupling joint", '2 = "q1 +', '5 = "q1 +', '[coupling], "5" .. no moving joint .. 1, 2, 3'),
    ("coupling product", '"q1 + 2*q2"', '"q1*q2"', '[coupling], "2" .. not linear .. q5 + q6'),
    ("coupling constant", '"q1 + 2*q2"', '"q2 + 1"', '[coupling], "2" .. constant 1 .. only'),
    ("coupling own", '"q1 + 2*q2"', '"q1"', '[coupling], "2" .. without q2 .. own joint'),
    ("priority", '"ZZ*"', '"zz1"', 'priority .. "zz1" matches no parameter .. mean "ZZ1"'),
    ("priority number", '"ZZ*"', "3", "priority: got 3 .. expected text"),
    ("priority text", '["ZZ*", "Ia?"]', '"ZZ*"', 'priority .. got "ZZ*" .. expected a list'),
    ("parameter", "ZZ1 = 0.5", "ZZ9 = 0.5", '[parameters] .. no parameter "ZZ9" .. did you mean'),
    ("parameter text", "ZZ1 = 0.5", 'ZZ1 = "big"', '[parameters], ZZ1 .. got "big" .. a number'),
    ("parameter inf", "ZZ1 = 0.5", "ZZ1 = nan", "[parameters], ZZ1 .. got nan .. finite"),
    ("uncertain text", V, f"{V}uncertainty.Fv1 = 'a'\n", f'{U}, Fv1 .. got "a" .. a number'),
    ("sigma 0", V, f"{V}uncertainty.Fv1 = 0\n", f"{U}, Fv1 .. got 0 .. above 0 .. held"),
    ("sigma name", V, f"{V}uncertainty.Fv9 = 1\n", f'{U} .. no parameter "Fv9" .. did you mean'),
    ("percent", V, "M2 = 3\nuncertainty.inertial = 10\n", f"{U} .. got 10 .. 0.10 for 10 %"),
    ("no body", V, f"{V}uncertainty.inertial = 0.1\n", f"{U} .. no body .. state masses"),
    ("held text", V, f"{V}held = 'Fv1'\n", '[parameters], held .. got "Fv1" .. a list'),
    ("held number", V, f"{V}held = [3]\n", "[parameters], held .. got 3 .. text such as"),
    ("held without value", V, f"{V}held = ['ZZ2']\n", "held: ZZ2 has no value; write ZZ2 = "),
    ("held and uncertain", V, f"{V}held = ['Fv1']\nuncertainty.Fv1 = 1\n", "one of both"),
    ("gain 0", "1 = 12.5", "1 = 0", '[drive_gains], "1" .. got 0 .. not zero'),
    ("gain text", "1 = 12.5", '1 = "12"', '[drive_gains], "1" .. got "12" .. expected a number'),
    ("limits joint", '1 = ["-pi",', '9 = ["-pi",', '[limits], "9" .. no moving joint'),
    ("limits short", ", 3, 10]", ", 3]", '[limits], "1" .. got 3 entries, expected 4 .. add 1'),
    ("limits range", '["-pi", 2.5', '["pi", 2.5', '[limits], "1" .. lower 3.14 .. lower < upper'),
    ("limits speed", "2.5, 3, 10", "2.5, 0, 10", '[limits], "1" .. speed 0 .. both positive'),
    ("physical value", "[physical.1]", "[physical]\n1 = 3\n[physical.9]", '"1": got 3 .. a table'),
    ("physical key", 'mass = "m1"', 'mas = "m1"', '[physical] .. key "mas" .. mean "mass"?'),
    ("physical missing", 'mass = "m1"\n', "", '[physical], "1" .. mass is missing .. inertia'),
    ("centre", '["x1", 0, "z1 - D3"]', '["x1"]', "centre .. got 1 entries, expected 3"),
    ("inertia", '"J2", 0, "J3"]', '"J2"]', "inertia .. got 4 entries, expected 6 .. YZ"),
    ("physical q", 'mass = "m1"', 'mass = "q1"', "[physical] .. joint variable q1 .. rigid"),
    ("physical text", 'mass = "m1"', 'mass = "m1 *"', 'mass .. got "m1 *" .. cannot be read'),
]

MOST = "expected at most "
UNITS_AND_SIZES_IN_ARM = [
    ("angle for length", D, '0, "90 deg"', "column d .. an angle; expected a length, m"),
    ("length for angle", '"pi/2", 0, "pi', '"60 mm", 0, "pi', "alpha .. a length .. an angle, rad"),
    ("angle of a symbol", "D3 = 0.45", 'D3 = "30 deg"', "column d .. an angle"),
    ("length in limits", '["-pi", 2.5', '["-pi", "9 mm"', "[limits] .. entry 2 .. a length"),
    ("length in home", "[limits]", '[home]\nq1 = "9 mm"\n[limits]', "[home] .. expected an angle"),
    ("greek variable", '0, 0, "q1", 0]', '0, 0, "θ1", 0]', "expected q1, the variable of this row"),
    ("t for q", '0, 0, "q1", 0]', '0, 0, "t1", 0]', "expected q1, the variable of this row"),
    ("d for q", '"q3 + R4"', '"d3"', "expected q3, the variable of this row"),
    ("i for j", '["j", "a"', '["i", "a"', 'entry 1 is "i" .. row names stand in column "j"'),
    ("link for j", '["j", "a"', '["link", "a"', 'entry 1 is "link" .. row names stand in column'),
    ("deep", D, '0, "%s"' % ("sin(" * 31 + "D3" + ")" * 31), MOST + "30"),
    ("far too deep", D, '0, "%s"' % ("sin(" * 2000 + "D3" + ")" * 2000), MOST + "4000"),
    ("signs", D, '0, "%s"' % ("-" * 100 + "D3"), MOST + "30"),
    ("sum", D, f'0, "{"+".join(["D3"] * 400)}"', "of 399 operations; " + MOST + "300"),
    ("tower", D, '0, "2**2**2**2**2"', "an exponent of 6.55e+04; " + MOST + "100"),
    ("exponent", D, '0, "D3**(50 + 51)"', "an exponent of 101; " + MOST + "100"),
    ("negative exponent", D, '0, "D3**-101"', "an exponent of 101; " + MOST + "100"),
    ("infinite exponent", D, '0, "D3**(10.0**400)"', "an exponent of inf; " + MOST + "100"),
    ("product", D, '0, "10**99*10**99"', "which is 1e+198; " + MOST),
    ("length", D, '0, "1e5"', "which is 1e+05; " + MOST + "10000"),
    ("length of a symbol", "D3 = 0.45", "D3 = 1e11", 'got "D3", which is 1e+11; expected at most'),
    ("symbol", "D3 = 0.45", "D3 = 1e200", "[symbols], D3: got .. at most 1e+12"),
    ("symbol's exponent", "D3 = 0.45", 'D3 = "0.5**N"\nN = 1000000000', "D3 .. a larger exponent"),
    ("name of 64", "D3 = 0.45", f"D3 = 0.45\n{'D' * 64} = 1", "of 64 letters; expected at most 63"),
    ("robot of 64", '"arm"', f'"{"a" * 64}"', "name: got .. of 64 letters"),
    ("row of 64", '["1", "0"', f'["{"2" * 64}", "0"', "column j: got .. of 64 letters"),
    ("gravity", '"-g"', '"-1e9*g"', "gravity, entry 3: got .. at most 10000"),
    ("parameter", "ZZ1 = 0.5", "M2 = 1e300", "[parameters], M2: got 1e+300; .. 1e+12"),
    ("coupling", '"q1 + 2*q2"', '"1e5*q1 + q2"', '[coupling], "2": .. at most 10000'),
]

IN_PLANAR = [
    ("mark without legs", 'legs = ["1", "2"]\n', "", "{i} stands for the legs .. names none"),
    ("legs no list", 'legs = ["1", "2"]', 'legs = "1"', "legs: got .. expected a list"),
    ("leg twice", 'legs = ["1", "2"]', 'legs = ["1", "1"]', 'legs .. "1" stands there twice'),
    ("leg name", 'legs = ["1", "2"]', 'legs = ["1", "a b"]', 'legs .. "a b" .. letters'),
    ("no legs", 'legs = ["1", "2"]', "legs = []", "legs .. no legs"),
    ("other mark", '"1{i}", "2{i}"]', '"1{k}", "2{i}"]', "effects .. {k} .. only mark"),
    ("relation of nothing", "q7 = ", "q9 = ", '[relations] .. "q9" .. no joint variable .. q4'),
    ("relation of itself", "-q21 + pi/2", "q7 + q12", "holds q7 itself"),
    ("large relation", "-q21 + pi/2", "1e5*q12", '"q7": .. at most 10000'),
    ("constant relation", "-q21 + pi/2", "pi/2", "a constant .. sigma 2"),
    ("actuated follows", '["7", "21", 0,', '["7", "21", 1,', "column mu .. follows .. write 0"),
    ("circle", '"-q21 + pi/2"', '"-q21"\nq21 = "q7"', "follow each other in a circle"),
    ("twice", '0, 0, 0, "q7"]', '0, 0, 0, "q12"]', "stands as a relation in the table too"),
    ("platform key", 'motion = "tr', 'moves = "tr', '[platform] .. unknown key "moves"'),
    ("no motion", 'motion = "translation"\n', "", "[platform] .. motion is missing"),
    ("motion", '"translation"', '"spatial"', '[platform] .. motion .. "spatial" .. planar'),
    ("platform name", 'name = "P"', 'name = "P 1"', '[platform] .. name .. "P 1" .. letters'),
    ("platform name taken", 'name = "P"', 'name = "12"', "12 .. [platform]"),
    ("loop columns", '"meets", "joint"]', '"meets", "kind"]', "[loops] .. columns .. expected"),
    ("loop cells", '"P", "position"]', '"P"]', "[loops] .. row 1 .. got 3 entries, expected 4"),
    ("loop frame", '"3{i}", "P"', '"9{i}", "P"', '[loops] .. "leg 1" .. frame .. "91" .. no row'),
    ("loop joint", '"position"', '"ball"', '[loops] .. joint .. "ball" .. spherical'),
    ("nothing to close", '"3{i}", "P"', '"3{i}", "2{i}"', "both fixed on link 21 .. nothing"),
    ("home of nothing", "q21 = ", "q91 = ", '[home] .. "q91" .. no joint variable'),
    ("links row", "7 = []", "8 = []", '[links] .. "8" .. no moving joint'),
    ("links parameter", '["M", "MX"]', '["M", "X"]', '[links] .. "P" .. "X" .. expected some of'),
    ("shared without mark", '"*2{i}"', '"*2"', 'shared .. "*2" .. {i}'),
    ("shared nothing", '"*2{i}"', '"*9{i}"', "shared .. matches no parameter of leg 1"),
]

IN_OWN_EFFECTS = [
    ("no table", "[own_effects.wave]", "[own_effects]\nwave = 3\n[terms]", "wave]: got 3"),
    ("id of the catalogue", FIRST, "[own_effects.spring]", "spring]: .. of the catalogue"),
    ("capital id", FIRST, "[own_effects.Eddy]", 'got the name "Eddy" .. small letters'),
    ("id of a word", FIRST, "[own_effects.undo]", 'got the name "undo" .. not all, auto, undo'),
    ("unknown key", "nonnegative =", "positive =", 'unknown key "positive" .. expected title'),
    ("no columns", EDDY, "", "eddy_brake], columns: is missing .. as in [own_effects."),
    ("columns no table", EDDY, 'columns = "v"', 'columns: got "v"; expected a table'),
    ("unknown function", "v*exp", "v*ln", "columns, Keb: .. no function ln .. sin, cos"),
    ("unknown variable", "v*exp", "u*exp", "Keb: got .. u is unknown .. names among q, v, a"),
    ("misspelt shape", "- c)", "- cc)", 'cc is unknown .. did you mean "c"? .. under shapes'),
    ("speed of a position", "cos(k*q)", "v*cos(k*q)", "v is unknown .. names among q, k"),
    ("kink of a position", "cos(k*q)", "abs(k*q)", "wave], columns, Wc: .. without abs and sign"),
    ("no joint", "v*exp", "v3*exp", "v3 is unknown .. the name of a joint (1, 2); list"),
    ("own joint", "v*exp", "v2*exp", 'joint "2" is the one whose v2 .. write v for its own'),
    ("shape a motion", "{c = [1,", "{v1 = [1,", '"v1", which is the speed of joint 1'),
    ("prefix of the catalogue", "{Keb", "{Ks", 'the parameter "Ks" is that of spring already'),
    ("prefix of a link", "{Keb", "{MX", 'the parameter "MX" is that of the links already'),
    ("prefix of the other", "{Wc", "{Keb", 'wave], columns: .. "Keb" is that of eddy_brake'),
    ("prefix with digit", "{Keb", "{K1", 'the parameter "K1" .. a letter first and last'),
    ("shapes no table", "{k = 2}", "[2]", "shapes: got [2]; expected a table"),
    ("shape a variable", "{k = 2}", "{k = 2, v = 1}", 'the name "v" .. neither a variable (q,'),
    ("empty grid", "[0.1, 0.3]", "[]", "shapes, w: got an empty list .. [0.1, 0.3]"),
    ("value twice", "[0.1, 0.3]", "[0.3, 0.3]", "shapes, w: .. stands there twice"),
    ("value no number", "[0.1, 0.3]", '["x"]', 'shapes, w: got "x"; expected a number'),
    ("unused shape", "{k = 2}", "{k = 2, m = 1}", "shapes: no equation uses m .. take it out"),
    ("too many", "[0.1, 0.3]", str([*range(1, 40)]), "117 combinations of c, w"),
    ("large", "v*exp", "1e300*v + exp", "Keb = .. one of at most 1e+12"),
    ("load", "z*cos(q)", "z*load", "[reference]: is missing; hook depends on the torques"),
    ("complex", "v*exp", "v**0.5 + exp", "columns: Keb = .. no finite value at"),
    ("shape 0", "[0.1, 0.3]", "[0, 0.3]", "no finite value at .. w = 0; .. at rest too"),
    ("lag unknown", HOOK, f'{HOOK}\nlag = "abs(u)"', "lag: got .. u is unknown .. among q, v, a"),
    ("lag no text", HOOK, f"{HOOK}\nlag = [1]", "hook], lag: got [1] .. expression"),
    ("lag without tau", HOOK, f'{HOOK}\nlag = "v*d"', "shapes: z lags by a time .. {tau ="),
    ("lag unused", EDDY, f'{EDDY}\nlag = "v"', "lag: no equation uses z, which lags"),
    (
        "lag infinite",
        f"{HOOK}\n{TRAVEL}",
        f'{HOOK}\nlag = "1/v"\nshapes = {{tau = [0.1, 1]}}',
        "lag = .. no finite value at v = 0",
    ),
    ("unit no text", '"N*m*s/rad"', "3", "unit: got 3; expected text"),
    ("unit ends comment", '"N*m*s/rad"', '"N */ x"', "unit: got .. expected text such as"),
    ("unit of another", "{Ws =", "{Wx =", 'unit: got "Wx" .. no parameter of this .. Wc, Ws'),
    ("nonnegative no word", "= true", "= 1", "nonnegative: got 1; expected true or false"),
    ("acts unknown", '"position"', '"motor"', 'acts: got "motor"; expected "joint"'),
    ("empty title", '"drag of a magnet"', '""', 'title: got ""; expected text'),
    ("z without travel", "{d = [0.01, 0.1]}", "{}", "shapes: z turns over a travel .. {d ="),
    ("z with travel 0", "[0.01, 0.1]", "[0, 0.1]", "shapes: z turns over .. no positive values"),
    ("no shapes", '[{joint = "2", c = 0.7, w = 0.2}]', '"all"', 'got "all"; expected its shapes'),
    ("one missing", ", w = 0.2", "", "eddy_brake: got the shapes c; expected eddy_brake = [{"),
    ("shape 0 there", "w = 0.2", "w = 0", 'joint "2": Keb = .. no finite value'),
]

IN_FRAMES_AND_TOOL = [
    ("column twice", '"link", "row"', '"link", "link"', "[frames], columns: got .. link, row and"),
    ("no row", '"hand", "4"', '"hand", "7"', 'row 1 ("hand"), column row: got "7"; expected the'),
    ("link twice", '"base", 0', '"hand", 0', 'row 2 ("hand"): the link stands there twice'),
    ("no link", '"base", 0', '"", 0', 'column link: got ""; expected text such as "hand"'),
    ("joint no text", '"wrist"', "7", 'column joint: got 7; expected a name, or ""'),
    ("undeclared", '"R4/2"', '"R4/K"', 'row 1 ("hand"), column x: .. K is not declared'),
    ("a length", '"90 deg"', '"0.2 m"', 'column yaw: got "0.2 m"'),
    ("short", '"base", 0, "", 0, 0]', '"base", 0, ""]', "row 2: got 3 entries, expected 5"),
    ("key", 'rows = [["hand"', 'lines = [["hand"', 'unknown key "lines"'),
    ("tool key", 'x = "2*D3"', "xx = 1", '[tool]: unknown key "xx"'),
    ("tool truth", 'x = "2*D3"', "yaw = true", "[tool], yaw"),
    ("tool row", 'link = "hand"', 'row = "7"', '[tool], row: got "7"; expected the name of a row'),
    ("tool link", 'link = "hand"', 'link = "han"', '[tool] .. did you mean "hand"'),
    ("tool link no text", 'link = "hand"', "link = 1", "link: got 1"),
    ("tool on both", 'x = "2*D3"', 'row = "2"', "[tool] .. keep one of them"),
    ("tool angle", '"2*D3"', '"30 deg"', "[tool], x"),
]

IN_MOTORS = [
    ("singular", "q2 - 0.4*q1", "2*q1", "[motors] .. singular, some motion of 1, 2, 3 turns no"),
    ("nearly", "q2 - 0.4", "1e-5*q2 - 0.4", "nearly singular, a joint moves 1e+05 times as far"),
    ("no joint", "0.4*q1", "0.4*q7", "q7 is not declared"),
    ("constant", "q2 - 0.4*q1", "q2 + 0.1", "with the constant 0.1"),
    ("no variable", "q2 - 0.4*q1", "0.1", "without a joint variable"),
    ("large", "q2 - 0.4*q1", "q2 - 1e5*q1", "expected at most 10000"),
    ("one less", 'm2 = "q2 - 0.4*q1"\n', "", "got 2 motors (m1, m3) for the 3 joints 1, 2, 3"),
    ("a joint without", MOTORS, 'm1 = "q1"\nm2 = "q2"\n', "no motor turns with q3, which has one"),
    ("name of a row", "m2 =", "2 =", 'row "2" of [mdh] has that name; call the motor m2'),
    ("dash", "m2 =", '"m-2" =', "expected a name of letters and digits"),
    ("no sum", '"q2 - 0.4*q1"', "[1]", "expected a number or an expression"),
    ("relation", MOTORS, f'{MOTORS}[relations]\nq3 = "q2"\n', "follows motors of [motors] too"),
]

IN_PASSIVE_FRICTION = [
    ("motor", "[effects]", f'{RUB}["11"]', 'joint "11" has a motor .. write viscous and coulomb'),
    ("twice", "[effects]", f'{RUB}["21"]\ncoulomb = ["21"]', '"21" has coulomb already .. of one'),
]

IN_LAW = [
    ("no table", f"law = {TABLE}\n", "", "no function law; .. key `law`"),
    ("a name", "law(q)", "law*q", "law needs an argument, as in law(x)"),
    ("two for one", "law(q)", "law(q, v)", "law takes one argument"),
    ("one for two", TABLE, TWO_AXES, "law takes 2 arguments"),
    ("not called", "law(q)", "q", "law: no equation calls law; use it, as in law"),
    ("no list", "cells = [2]", "cells = 2", "law, cells: got 2; expected a list of num"),
    ("a word", "[-1]", '["a"]', 'law, low: got "a"; expected'),
    ("a key too many", "1, 1]}", "1, 1], odd = true}", "law: .. odd"),
    ("a key too few", ", values = [0, 0, 0, 1, 1]", "", "law: .. values .. missing"),
    ("no axis", "[-1]", "[]", "law: got 0, 1 and 1 entries of low, hi"),
    ("three axes", TABLE, TABLE.replace("[-1]", "[0, 0, 0]"), "entries .. which has one or two"),
    ("turned", "[-1]", "[1]", "got an axis from 1 to 1 of 2 cells; exp"),
    ("too narrow", "[-1], high = [1]", "[0], high = [1e-315]", "got an axis from 0 to"),
    ("half a cell", "[2]", "[2.5]", "of 2.5 cells; expected low < high"),
    ("no cell", "[2]", "[0]", "of 0 cells; expected"),
    ("too few", "[2]", "[3]", "values: got 5 numbers; expected 6, 3 more"),
]

TABLES = {
    "arm": (ARM, IN_ARM),
    "units and sizes": (ARM, UNITS_AND_SIZES_IN_ARM),
    "frames and tool": (ARM, IN_FRAMES_AND_TOOL),
    "planar": (PLANAR, IN_PLANAR),
    "own effects": (OWN_EFFECTS, IN_OWN_EFFECTS),
    "law": (LAW, IN_LAW),
    "motors": (COUPLED, IN_MOTORS),
    "passive friction": (FIVE_BAR, IN_PASSIVE_FRICTION),
}


@pytest.mark.parametrize(
    ("text", "old", "new", "message"),
    [
        pytest.param(text, *row[1:], id=f"{table}: {row[0]}")
        for table, (text, rows) in TABLES.items()
        for row in rows
    ],
)
def test_a_mistake_is_told(text, old, new, message):
    check_mistake(text, old, new, message)


def test_the_good_files_are_read():
    robots = {table: parse_robot_text(text, "x") for table, (text, _) in TABLES.items()}
    assert [joint.name for joint in robots["arm"].moving_joints] == ["1", "2", "3", "4"]


def test_a_row_before_its_antecedent_is_told_where_to_go():
    first, last = '["1", "0", 1, 0, 0, 0, "q1", 0],', '["E", "4"'
    text = 'row "2", column a: got "1" .. move row "1" above row "2"'
    check_mistake(ARM.replace(first, "", 1), last, first + last, text)


ROCK = 'name = "rock"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "sigma", "theta"]\nrows = ['


@with_cases(
    "rows, text",
    ('["1", 2, 0]', '[mdh], row "1": no row of the table moves'),
    ("", "[mdh], rows: the table is empty; write one row"),
    ('["1", 0, "q1"], ["1R", 0, "q1R"]', 'row "1R": the name makes XX1R a parameter, which is'),
    ('["1", 0, "q1"], ["X1", 0, "qX1"]', 'row "X1" .. MX1 mean two parameters, with row "1"'),
)
def test_a_table_that_is_no_robot_is_refused(rows, text):
    check_mistake(f"{ROCK}x]", "x]", f"{rows}]", text)


def test_unknown_names_suggest_built_in_robots():
    with pytest.raises(KeyError):
        read_builtin_robot("pumma560")
    with pytest.raises(RobotError, match=r'"pumma560" is neither.*did you mean "puma560".*wrist'):
        read_robot("pumma560")
    with pytest.raises(RobotError, match=r"wirst\.toml: there is no such file.*\"wrist\""):
        read_robot("wirst.toml")


def test_unreadable_files_are_told(tmp_path):
    with pytest.raises(RobotError, match="is a folder; expected a robot file"):
        read_robot(tmp_path)
    latin = tmp_path / "latin.toml"
    latin.write_bytes('name = "Stäubli"'.encode("latin-1"))
    with pytest.raises(RobotError, match=r"latin\.toml: byte 10 is not UTF-8"):
        read_robot(latin)
    with pytest.raises(RobotError, match=r"cannot be read \(File name too long\); check the path"):
        read_robot("x" * 300 + ".toml")


PAR = par_text(BOOM, links=3, joints=4)
SHARDS = [
    *("", '"', "[", "]", "{}", "0", "-", ".", "=", "\n", "(", "**", "é", "true", "pi", "q1", "q2"),
    *("1e999", "9" * 5000, "0x" + "f" * 5000, ",", "e", ";", "\\", "^"),
]


@pytest.mark.parametrize("seed", range(50))
def test_damaged_files_raise_nothing_but_robot_errors(seed):
    """Ours, one with effects of its own, one of SYMORO."""
    rng = random.Random(seed)
    of_ours = rng.choice([ARM, *map(read_builtin_robot, list_builtin_robots())])
    for name, text in (("x.toml", of_ours), ("x.toml", OWN_EFFECTS), ("x.par", PAR)):
        for _ in range(rng.randint(1, 4)):
            at, other = rng.randrange(len(text)), rng.randrange(len(text))
            length = rng.choice([0, 1, 1, 3, 20])
            piece = rng.choice([*SHARDS, text[other : other + length]])
            text = text[:at] + piece + text[at + length :]
        try:
            text = convert_par_file(text.encode(), name).text if name == "x.par" else text
            assert parse_robot_text(text, name).moving_joints
        except RobotError as error:
            assert str(error).startswith(name) and "\n" not in str(error)
