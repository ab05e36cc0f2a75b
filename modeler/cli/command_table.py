"""All that can be typed: each command with its arguments, without what it runs.

Nothing that takes long to load is imported here: `modeler --help`, and the answer to a wrong
usage, come at once.
"""

import argparse
from typing import get_args

from modeler.cli import places
from modeler.cli.options import (
    ALL,
    FEW_JOINTS,
    Argument,
    Command,
    Form,
    Group,
    Methods,
    choice,
    flag,
    repeated,
    value,
)
from modeler.cli.shared_arguments import (
    CHANGED,
    DASK,
    DRAWN,
    EFFECTS_FROM,
    FORCE,
    LOGS,
    MAP,
    MODEL,
    PARALLEL,
    REQUIRED,
    ROBOT,
    ROBOT_FILE,
    ROBOT_OR_MODEL,
    WINDOW,
    logs,
    page,
    pictures,
)
from modeler.cli.use_commands import EXPORT, GENERATE
from modeler.core import choices
from modeler.core.choices import (
    ABOUT,
    APART,
    CONVENTIONS,
    EFFECTS,
    MOTIONS,
    SIMULATED,
    TEMPLATES,
    list_papers,
)

NOMINAL = ""
"""`--cad` without a file: the values of the robot file."""

# Of a robot: its model, its C, its pictures, its postures.

_DERIVE = Command(
    "derive", "derive:run_derive",
    "base parameters and grouping relations, with their proof",
    "Derives the model of ROBOT, linear in the dynamic parameters: which base parameters it has, "
    "how the standard parameters group, and the proof. Robots of up to "
    f"{FEW_JOINTS} joints also get their PG/PJ/PS coefficients, unless these are more than a page.",
    "modeler derive puma560 --format latex --document > puma560.tex",
    (
        ROBOT, CHANGED,
        Group("what is printed", None, (
            choice("--format", sorted(get_args(Form)), "of what is printed", "text"),
            flag("--document",
                 "with --format latex: a whole document; without, what \\input takes beside "
                 "amsmath"),
            Argument(("--terms",), {"action": argparse.BooleanOptionalAction,
                                    "help": "PG/PJ/PS coefficients or not"}),
            flag("--closed-form",
                 "M(q), Christoffel coefficients and gravity; of loops J_t and J_p too"),
            flag("--regressor", "every base column, that of friction too"),
            flag("--blocks",
                 "of parallel robots: the regressor in blocks of platform, motors and legs, with "
                 "the Jacobian of each leg and of the robot (Guegan, Khalil, Lemoine 2003)"),
            flag("--energy",
                 "velocities and energy functions h of every link: H = h xi, the energy model"),
            flag("--kane", "Kane's form: velocities, tangent vectors beta, momenta, forces"),
            flag("--expanded",
                 "with --closed-form: sums of monomials instead of named quantities; with --terms: "
                 "all coefficients, those that follow from others too"),
            flag("--nonzero",
                 "with --closed-form, --regressor and --blocks: leave out base parameters that are "
                 "0 at the values of [parameters]"),
        )),
        flag("--cut-loops", "cut the loops: the tree, as counted leg by leg"),
        value("--coefficients-out", "FILE.md", places.Output, "write the page of the coefficients"),
        *page(),
    ),
)  # fmt: skip

_SHOW = Command(
    "show", "show:run_show",
    "the robot in 3-D: a page with sliders, a picture for papers",
    "Draws the skeleton of ROBOT at home: frames, joint axes, links, loops, platform, gravity. The "
    "page stands alone, its sliders move the actuated joints and the loops follow. Loops that do "
    "not close are drawn open, with the gap.",
    "modeler show orthoglide-2003 --picture orthoglide.pdf",
    (
        ROBOT,
        value("--out", "PAGE", places.Output,
              "page to write (default NAME.html, if no picture is asked for)"),
        value("--picture", "FILE", places.Output, f"{DRAWN}, one column wide"),
        flag("--open", "show the page in the browser"),
    ),
    "write poses at home and gaps of loops for machines",
)  # fmt: skip

_HOME = Command(
    "home", "home:run_home",
    "closed postures of a robot with loops, and its assembly modes",
    "Finds the ways in which the loops of ROBOT can be put together with its actuated joints where "
    "[home] says, else in the middle of their [limits], else far from singularities; each gets a "
    "letter, A the best to start from. What [home] or --near say of passive joints ranks them: one "
    "near to it comes first.",
    "modeler home crank.toml --report modes.html --mode B --write",
    (
        ROBOT,
        value("--near", "q1=0.3,...", places.Word,
              "values to stay near, rad and m, in place of the passive joints' in [home]"),
        flag("--anew", "as if the file had no [home]"),
        value("--mode", "LETTER", places.Word, "the mode that is meant (default A)"),
        flag("--write", "write it into the robot file as [home]"),
        value("--picture", "FILE", places.Output,
              "draw every mode, beside each other: .png, .svg or .pdf"),
        *page(),
    ),
    "write the modes for machines",
)  # fmt: skip

_PHYSICAL = Command(
    "physical", "physical:run_physical",
    "masses, mass centres and inertias that follow from a fit and from known ones",
    "Which physical parameters follow from the base parameters if some are known: formulas in an "
    "order that can be checked, with a MODEL values and sigma; which sets of known parameters "
    "suffice; a fit against CAD values. Without options: what there is to know, and the easiest "
    "set that suffices.",
    "modeler physical wrist --known am,bm,bl1,bt2,ct1,bJ33,cJ33,cm",
    (
        value("source", "ROBOT|MODEL", places.RobotOrModel, ROBOT_OR_MODEL),
        value("--known", "LIST", places.Word,
              'parameters that are known, "am,bm"; with a MODEL their values in SI units, and '
              'standard deviations where they have one: "am=12+-0.1,bm=6"'),
        value("--near", "LIST", places.Word,
              'about what a parameter is, "cm=4": chooses between roots where several fit'),
        value("--sets", "N", int,
              "count and rank the sets of N known parameters that suffice; the smallest without N",
              nargs="?", const=True),
        value("--cad", "FILE.toml", places.Word,
              "with a MODEL: the fit against these values, am = 12.0 or am = [12.0, 0.1]; without "
              "FILE against those of the robot file. With --sets: where errors are compared",
              nargs="?", const=places.Word(NOMINAL)),
        choice("--format", ("text", "latex", "python"), "of the formulas", "text"),
        Argument(("--from",), {"dest": "of", "choices": ("base", "coefficients"), "help":
                 "formulas from base parameters, or from the coefficients PG, PJ of the closed "
                 "form; default: coefficients where a fit leaves a length free"}),
    ),
)  # fmt: skip

_NEW = Command(
    "new", "new:run_new",
    "a robot file to start from",
    "Writes a commented robot file that derives as it is: on a terminal after a few questions, "
    "else the template asked for (by default a serial robot of three joints).",
    "modeler new arm.toml --joints RRPRRR --convention craig",
    (
        value("file", "ROBOT.toml", places.NewRobot, "robot file to write"),
        choice("--template", TEMPLATES, "kind of robot"),
        value("--joints", "LETTERS", places.Word,
              "of a serial robot from the base, R revolute, P prismatic: RRPRRR"),
        choice("--convention", CONVENTIONS, "whose table, of a serial robot"),
        flag("--force", "write over a file that is there"),
    ),
    "write what was begun for machines",
)  # fmt: skip

_CONVERT = Command(
    "convert", "new:run_convert",
    "another program's robot file as ours",
    "Writes the robot of a URDF, MJCF or SYMORO file (.par) as a robot file, and says what was "
    "decided and what has no place there. Every command reads such files as well; converted, they "
    "can be edited.",
    "modeler convert arm.urdf --tip tool0 --out arm.toml",
    (
        value("file", "FILE", places.RobotFile, "a URDF, MJCF or SYMORO file"),
        value("--out", "ROBOT.toml", places.Output, "robot file to write", **REQUIRED),
        value("--base", "LINK", places.Word, "link that stands still; default: the first",
              default=""),
        value("--tip", "LINK", places.Word, "last link of the chain that is meant; default: all",
              default=""),
        repeated("--lock", "JOINT=POSITION", places.Word,
                 "hold a joint, as elbow=0.3 or 'elbow=30 deg'"),
        flag("--exact-decimals", "take 1.5708 as it is, not as pi/2, and lengths below 1 um"),
        flag("--force", "write over a file that is there"),
    ),
    "write what was converted for machines",
)  # fmt: skip

# From logs: what is in them, a fit, whether it is true, what drifts.

_LOG = Command(
    "log", "log:run_log",
    "what is in a log: channels, rates, gaps, doubts, pictures",
    "Lists what LOG holds: topics and columns, rate, jitter, gaps, ranges, resolution, missing "
    "values, limits. Names doubts, and suggests a [log] to start from, guessed from names and "
    "ranges. With a robot: fits it, and says what contradicts it.",
    "modeler log run1.mat --robot arm.toml --report run1.html",
    (
        value("log", "LOG", places.LogFile,
              f"Parquet, CSV, MAT, HDF5, numpy or MCAP file, or ROS bag; {WINDOW}"),
        value("--robot", "ROBOT", places.RobotFile,
              f"{ROBOT_FILE}: its [log], its joints, and doubts that a fit shows"),
        flag("--write", "put the guessed [log] into the file of --robot, in place of its own"),
        MAP, *page(), pictures(places.LogPictures),
    ),
    "write what is in it for machines",
)  # fmt: skip

_PROCESSING = Group(
    "processing", "chosen from the logs and told where left out",
    (
        value("--cutoff", "HZ", float,
              "low-pass of the positions (zero phase, Butterworth order 4)"),
        value("--parallel-cutoff", "HZ", float, PARALLEL),
        value("--decimate", "N", int, "keep every N-th row after it"),
        choice("--derivatives", get_args(choices.Derivatives),
               "logged velocities, or positions differentiated; auto: the quieter", "auto"),
        value("--low-speed", "SHARE", float,
              "leave out rows below this share of the joint's top speed, where the sign of the "
              "speed is doubtful", default=choices.LOW_SPEED),
        flag("--keep-saturated", "use rows whose torque is stuck at its limit"),
        flag("--keep-contradicted",
             "use rows whose logged derivatives contradict the signals below them"),
        flag("--keep-damaged",
             "use leaps, spikes and repeated values, which no robot can have made, as logged"),
    ),
)  # fmt: skip

_PAYLOAD_LINK = value(
    "--payload-link", "J", places.Word, "the link that carries it; default: the last"
)

_LOAD = Group(
    "load", "some of the logs carry a load on a link",
    (
        repeated("--payload-log", "LOG", places.LogFile,
                 "a further log, with the load"),
        value("--payload-mass", "KG", float, "its mass, if it is known"),
        flag("--payload-moved",
             "it was taken off between the loaded logs: the same mass, but its own centre and "
             "inertia in each"),
        _PAYLOAD_LINK,
    ),
)  # fmt: skip


def _check_fit_output(args: argparse.Namespace) -> str:
    """A model is written of one method, and of several none."""
    alone = args.out is None and not args.method.is_several
    return "the following arguments are required: --out" if alone else ""


_FIT = Command(
    "fit", "fit:run_fit",
    "estimate the base parameters from logs",
    "Filters the logs, builds the observation matrix and estimates the base parameters of ROBOT: "
    "value, sigma, %sigma, errors per joint; saves a model file. Of several methods it shows "
    "values, errors, seconds and warnings side by side, and saves none.",
    "modeler fit ur10e run1.parquet run2.parquet --out ur10e.model.json; which estimator: "
    "modeler fit emps train.parquet --method all --holdout pulses.parquet",
    (
        ROBOT, CHANGED, logs(LOGS), MAP,
        value("--out", "MODEL", places.Output, "model file to write; none of several methods"),
        value("--method", "METHOD[,METHOD...]", Methods,
              "; ".join(f"{about.id}: {about.title}" for about in (*ABOUT.values(), *APART))
              + f"; several with commas between, or {ALL}: compared on the same rows; `modeler "
              "estimators` says when each is the wrong one (default %(default)s)",
              default=Methods("weighted")),
        repeated("--holdout", "LOG", places.LogFile,
                 "with several methods: logs of other motion, not fitted: their error"),
        value("--robot-out", "FILE.toml", places.Output,
              "write the robot file with the values found, for simulators (--method consistent), "
              "or with the drive gains found (--method tls)"),
        choice("--model", get_args(choices.ModelKind),
               "one equation a joint and sample, or the energy balance of windows (default "
               "%(default)s)", "torque"),
        value("--window", "S", float,
              "length of a window of --model energy; left out: the spacing of the torque model's "
              "rows"),
        value("--essential-below", "PERCENT", float,
              "keep in the reduced model what has a sigma below this share of its value (papers: "
              "15); left out: what an F-test misses"),
        _PROCESSING, _LOAD, DASK, *page(), pictures(),
    ),
    lacks=_check_fit_output,
)  # fmt: skip

_FREE_RUN = Group(
    "free run", "positions instead of torques, simulated from the logged torques",
    (
        flag("--free-run",
             "simulate the robot under the torques of the logs, window after window from the "
             "measured state: fit of the positions per joint, how long the error stays within a "
             "bound, and whether errors grow by the robot's nature whatever the model; where "
             "commanded positions were logged, also under a controller that follows them"),
        value("--window", "S", float, "seconds from one measured state to the next (default 1)"),
        value("--bound", "SHARE", float,
              "of a joint's range of motion: an error above it ends the horizon (default 0.05)"),
        value("--controller", "HZ,RATIO[,INTEGRAL[,FORWARD]]", places.Word,
              "the controller that follows the commands: speed loop, ratio of the position loop to "
              "it, integral action and feedforward (1 or 0); default: the one that comes nearest"),
    ),
)  # fmt: skip

_COMPARE = Command(
    "compare", "compare:run_compare",
    "measured against predicted torque: how good, where it fails",
    "Predicts the torques of the logs with MODEL and shows per joint how good it is, where it "
    "fails, and whether the rest still has structure. Of several models: whose error is smaller on "
    "which joint, and where that is beyond doubt. Of a ROBOT: with the values that its file "
    "states, 0 for others. With --free-run: the positions that the robot takes under the logged "
    "torques.",
    "modeler compare ur10e.model.json held_out.parquet --report page.html; "
    "modeler compare ur10e.model.json better.model.json held_out.parquet; "
    "modeler compare ur10e.model.json held_out.parquet --free-run --picture free_run",
    (
        value("model", "MODEL|ROBOT", places.RobotOrModel, ROBOT_OR_MODEL),
        value("logs", "LOG", places.parse_model_or_log,
              f"{LOGS}; before them perhaps further models or robot files, which are set beside "
              "the first", nargs="+"),
        MAP, *page(places.PageOrFolder), pictures(places.PictureFolder),
        Group("load", "that the robot carries in these logs", (
            value("--payload-mass", "KG", float,
                  "its mass: the model of the robot with it, beside that without"),
            value("--payload-centre", "X,Y,Z", places.Word,
                  "where its mass is, m, in the frame of the link; default: the origin"),
            _PAYLOAD_LINK,
        )),
        flag("--essential",
             "predict with the reduced model of the fit: its essential parameters, all others 0"),
        flag("--run-embedded-c",
             "compile the C in MODEL instead of emitting it anew: only for files that you trust"),
        _FREE_RUN,
    ),
)  # fmt: skip

_FLEET = Command(
    "fleet", "fleet:run_fleet",
    "one robot kind, many machines and days: what drifts where",
    "Fits all logs of machines of one kind together: inertial parameters in common, friction, "
    "offset and drive gain of every joint log by log. Says which of them drifts, leaps, or is "
    "apart from those of the other machines, beyond doubt.",
    "modeler fleet ur10e plant/*/*.parquet --report fleet.html",
    (
        ROBOT, CHANGED, logs(f"logs, or folders of logs; {WINDOW}", "*"),
        Group("names", "which machine and period a log is of", (
            value("--name", "PATTERN", places.Word,
                  "how paths end, as '{machine}-{period}.csv'; left out: the folder is the "
                  "machine, the file the period"),
            value("--list", "FILE", places.ListFile,
                  "logs by name, in place of LOG: .csv with machine, period, log in its first "
                  "line, or .toml with [[log]] tables"),
        )),
        MAP,
        Group("processing", "chosen for each log, from its own noise", (
            value("--cutoff", "HZ", float, "low-pass of the positions"),
            value("--parallel-cutoff", "HZ", float, PARALLEL),
        )),
        Group("workers", None, (
            value("--workers", "N", int,
                  "processes that read logs; left out: one for few logs, all processors for many"),
            DASK,
        )),
        *page(), pictures(),
    ),
)  # fmt: skip

# What a model lacks; motions and measurements that show it.

_DIAGNOSE = Command(
    "diagnose", "improve:run_diagnose",
    "which physical effect is missing",
    "Looks for the physical effects that MODEL lacks on the logs: which, on which joint, how "
    "large, what adding them would gain on motion not used for the fit, what they could be "
    "mistaken for, and what these logs cannot show.",
    "modeler diagnose arm.model.json train.parquet --holdout other.parquet",
    (
        MODEL, logs(f"logs to explain; {WINDOW}"),
        repeated("--holdout", "LOG", places.LogFile,
                 "logs of other motion: errors come from them, nothing is fitted to them"),
        repeated("--without", "EFFECT[@J]", places.Word,
                 "an effect that this robot does not have, on one joint or at all"),
        EFFECTS_FROM,
        MAP, *page(), pictures(),
        Group("what has no name", None, (
            flag("--discover", "propose equations, as [own_effects] to paste"),
            flag("--add", "put the first of each joint into the model, with the effects beside "
                          "which it stands, where that lowers the error"),
            value("--out", "MODEL2", places.Output, "with --add: model file to write"),
        )),
    ),
)  # fmt: skip

_ADD = Command(
    "add", "improve:run_add",
    "put a physical effect into a model and watch the error fall",
    "Adds EFFECT to the robot of MODEL, derives and emits it anew, fits it to the logs and shows "
    "the error before and after. EFFECT may also be `auto`: all that `modeler diagnose` names, "
    "`undo`: without the last one, or `learned`: a smooth law of one or two quantities, for what "
    "has no name.",
    "modeler add arm.model.json load_friction --joint 2 train.parquet "
    "--holdout other.parquet --out arm2.model.json",
    (
        MODEL,
        value("effect", "EFFECT", places.Word, "see `modeler effects`; auto; undo; learned"),
        logs("logs to fit to"),
        value("--joint", "J", places.Word, "default: where it explains most"),
        value("--out", "MODEL2", places.Output, "model file to write", **REQUIRED),
        repeated("--holdout", "LOG", places.LogFile, "logs of other motion to judge on"),
        value("--robot-out", "FILE.toml", places.Output, "write the new robot file too"),
        EFFECTS_FROM,
        MAP, *page(), pictures(),
        Group("of `learned`, and of `auto`", None, (
            value("--of", "X[,Y]", places.Word,
                  "what the law is a function of, of the variables of [own_effects]: q,v or v,load "
                  "or q (default: what predicts best)"),
            flag("--odd", "odd in v: times its sign, of |v|"),
            choice("--monotone", ("rising", "falling"), "along the first quantity"),
            flag("--learned", "`auto`: a learned law at last, for what is left"),
        )),
    ),
)  # fmt: skip

_EXCITE = Command(
    "excite", "motion:run_excite",
    "a motion within limits that tells the parameters apart",
    "Finds a motion of ROBOT within its [limits] along which the parameters are well told apart, "
    "and writes it as a table for a controller or `modeler simulate --motion`. Of a MODEL: its "
    "essential parameters, its torque noise. With --from: what to record next, beside logs that "
    "there are. With --between: the motion that tells two effects apart. With --choose: the best "
    "of motions that there are. With --check: do links run into each other along a motion? The "
    "page shows the robot where two links come nearest.",
    "modeler excite panda --duration 10 --out motion.csv --picture motion.png",
    (
        value("robot", "ROBOT|MODEL", places.RobotOrModel, ROBOT_OR_MODEL),
        CHANGED,
        value("--out", "MOTION", places.NewLog,
              "motion to write, .csv or .parquet: time, q, qd and qdd of every joint"),
        value("--picture", "FILE", places.Output, "draw it against its limits: .png, .svg or .pdf"),
        *page(),
        Group("the motion", None, (
            choice("--family", ("fourier", "bspline", "trapezoid"),
                   "fourier: periodic; bspline: quintic; trapezoid: moves from place to place, "
                   "speed a trapezoid, jerk limited (default %(default)s)", "fourier"),
            value("--duration", "S", float, "seconds, from rest to rest", default=10.0),
            value("--laps", "N", int, "times that this motion is driven in MOTION", default=1),
            value("--rate", "HZ", float, "samples per second of MOTION", default=200.0),
            repeated("--limit", "J=LOWER,UPPER,SPEED,ACCELERATION[,TORQUE]", places.Word,
                     "of a joint, instead of those of the file, SI units; torques "
                     "need values of the parameters"),
            repeated("--box", "FRAME=X0,X1,Y0,Y1,Z0,Z1", places.Word,
                     "where the origin of a frame must stay, m, in frame 0"),
            value("--clearance", "M", float,
                  "that links keep from each other and from planes, m; default: 0.01 if the robot "
                  "file has [capsules], else links are not looked at"),
        )),
        Group("the search", None, (
            choice("--objective", ("both", "condition", "information"),
                   "condition: the condition number, columns of length one; information: log det "
                   "of the information matrix; both: the sum of their logarithms (default: both; "
                   "with --from: information, of logs and motion together)", None),
            value("--harmonics", "N", int,
                  "of the series; other families have as many coefficients, 2 N - 1 a joint; "
                  "default: 5 to 10, by the limits"),
            value("--starts", "N", int, "searches, from the best of 50 random motions", default=6),
            value("--seed", "N", int, "of the random motions", default=0),
            value("--time-limit", "S", float, "take the best after so many seconds"),
        )),
        Group("the forecast of sigmas", "of a MODEL", (
            value("--encoder-counts", "N", int, "per turn, of the log; default: exact"),
            value("--position-noise", "X", float,
                  "rad or m, white, of its positions; default: none"),
        )),
        Group("other tasks", None, (
            value("--between", "EFFECT@J,EFFECT@J", places.Word,
                  "make what the first effect alone explains large, and the second: of a MODEL"),
            value("--choose", "N", int, "take N of the motions of --from; takes no --out"),
            repeated("--from", "LOG", places.MotionFile,
                     "logs that there are: the motion adds to what they tell; with --choose: logs "
                     "or motions to choose from", dest="candidates"),
            value("--check", "MOTION", places.MotionFile,
                  "does this motion or log keep to [limits], start and end at rest, and keep links "
                  "apart by --clearance? status 1 if not; takes no --out"),
        )),
    ),
    "write what was found for machines",
)  # fmt: skip

_SIMULATE = Command(
    "simulate", "motion:run_simulate",
    "measurements by forward simulation in closed loop",
    "Simulates ROBOT under a controller that sees quantised encoders, and writes the log that its "
    "logger would have written; a robot with loops carries out the commanded motion exactly, "
    "unless --controller is given. Parameters that the robot file leaves open are drawn from the "
    "seed.",
    "modeler simulate demo-arm --duration 30 --seed 1 --out run1.parquet",
    (
        ROBOT, CHANGED,
        value("--out", "LOG", places.NewLog, "log to write, .parquet or .csv", **REQUIRED),
        value("--truth-out", "FILE.json", places.Output, "write the true parameters"),
        Group("the motion", None, (
            value("--motion", "MOTION", places.MotionOrKind,
                  "exciting: at several speeds, and a Fourier series; point-to-point: as fast as "
                  "[limits] allow; one-joint: one after the other alone; or a file of `modeler "
                  "excite` or a log, whose (commanded) positions are then the motion, as long as "
                  "it is (default %(default)s)", default=MOTIONS[0]),
            value("--duration", "S", float,
                  f"seconds (default {SIMULATED['duration']:g}); not of a file, which is as long "
                  "as it is"),
            value("--rate", "HZ", float, "samples per second", default=SIMULATED["rate"]),
            value("--seed", "N", int, "of motion and noise", default=SIMULATED["seed"]),
            flag("--controller",
                 "a robot with loops is moved by a controller too, as others always are"),
        )),
        Group("the machine", None, (
            value("--parameter-seed", "N", int,
                  "of parameters the file leaves open", default=SIMULATED["parameter_seed"]),
            repeated("--hide", "EFFECT[@JOINT][:NAME=VALUE,...]", places.Word,
                     "physics that the machine has and the robot file lacks; "
                     "joint and values left out are drawn from --parameter-seed: "
                     f"{', '.join(EFFECTS)}"),
        )),
        Group("what is measured", None, (
            value("--noise", "SHARE", float,
                  "torque noise, share of the rms torque", default=SIMULATED["torque_noise"]),
            value("--process-noise", "SHARE", float,
                  "random torque on the machine, share of the rms torque",
                  default=SIMULATED["process_noise"]),
            value("--encoder-counts", "N", int,
                  "per turn, 0 for an ideal encoder", default=SIMULATED["encoder_counts"]),
            repeated("--drive-gain", "JOINT=VALUE", places.Word,
                     "true torque per drive unit of a joint; its current is logged in place of its "
                     "torque"),
        )),
    ),
    "write what was simulated for machines",
)  # fmt: skip

# What is built in, what papers print, a demonstration, completion.

_ROBOTS = Command(
    "robots", "lists:run_robots",
    "the built-in robots, or one's file",
    "Lists the built-in robots: names to use wherever a command asks for ROBOT. With one, prints "
    "its file, to start your own.",
    "modeler robots wrist",
    (value("robot", "ROBOT", places.RobotFile, "print this robot's file", nargs="?"),),
    "write the list for machines",
)  # fmt: skip

_CATALOGUE = Command(
    "effects", "lists:run_effects",
    "the physical effects, or all about one",
    "Lists the physical effects that a robot file may name under [effects].",
    "modeler effects coulomb",
    (
        value("effect", "EFFECT", places.Word, "one effect, in full", nargs="?"),
        value("--robot", "ROBOT|MODEL", places.RobotFile, "with the effects that it defines"),
        value("--export", "EFFECT", places.Word,
              "write one of these as EFFECT.toml and a page, for --effects-from of others"),
        value("--out", "FOLDER", places.OutputFolder, "of these files (default: this one)"),
        flag("--force", "write over files that are there"),
    ),
    "write the catalogue for machines",
)  # fmt: skip

_ESTIMATORS = Command(
    "estimators", "lists:run_estimators",
    "the ways to estimate, and when each is the wrong one",
    "Lists the estimators of `modeler fit --method`: law, source, and when not to use each. "
    "`modeler fit ROBOT LOG... --method all` shows all of them on the same logs.",
    "modeler estimators robust",
    (value("methods", "METHOD", places.Word, "one, or some with commas between", nargs="?"),),
    "write the list for machines",
)  # fmt: skip

_REPRODUCE = Command(
    "reproduce", "reproduce:run_reproduce",
    "what a paper prints beside what is derived, its identification run again",
    "Quotes what a paper prints, derives it, and says of every line: printed and equal, printed "
    "and different (a misprint, an omission, an error, or perhaps the scan), or our consequence, "
    "not printed. Then runs the paper's identification again in simulation and sets its tables "
    "beside ours. Exit status 1 if a line differs unexpectedly.",
    "modeler reproduce guegan-2003 --section methods",
    (
        value("paper", "PAPER", places.Word,
              f"one of {', '.join(list_papers())}, or a robot of theirs"),
        choice("--section", ("print", "methods"), "what is printed, or methods; default: both"),
        pictures(),
    ),
    "write the lines for machines",
)  # fmt: skip

_DEMO = Command(
    "demo", "demo:run_demo",
    "the whole story on built-in robots with a hidden effect",
    "Simulates an arm, then a robot with closed loops, each with a physical effect that its robot "
    "file lacks: derives, emits C, fits, compares, finds out which effect is missing, adds it, and "
    "shows the error falling on motion that was never fitted.",
    "modeler demo --out demo",
    (
        value("--out", "DIR", places.DemoFolder, "folder (default %(default)s)", default="demo"),
        FORCE,
        flag("--open", "show the pages in the browser"),
        value("--duration", "S", float, "seconds of each simulated run", default=20.0),
    ),
    "write the diagnoses for machines",
)  # fmt: skip

_STUDIO = Command(
    "studio", "studio:run_studio",
    "all of this in the browser: see where the model fails, add what is missing",
    "Opens the workbench in the browser, for this machine alone, until Ctrl-C: describe a robot, "
    "drop logs, fit, see where the model fails, add what is missing. FOLDER keeps all of it.",
    "modeler studio arm",
    (
        value("folder", "FOLDER", places.Word, "of the project, made if it is not there (default: "
              "the current one)", nargs="?", default="."),
        flag("--demo", "begin with the built-in arm that has a hidden effect"),
        repeated("--allow", "DIR", places.Word, "folder whose files may be chosen where they lie, "
                 "besides FOLDER and the current one"),
        value("--port", "N", int, "at which it answers; 0: one that is free", default=0),
        flag("--no-open", "print the address, open no browser"),
    ),
    "write its address, before it serves, for machines",
)  # fmt: skip

_COMPLETION = Command(
    "completion", "completion:run_completion",
    "a script that lets a shell complete what you type",
    "Prints a script for bash, zsh or fish: with it, the Tab key completes commands, options, "
    "built-in robots, effects, and files of the right kind.",
    'eval "$(modeler completion bash)"',
    (
        Argument(("shell",), {"metavar": "SHELL", "choices": ("bash", "zsh", "fish"),
                              "help": "bash, zsh, fish"}),
        # what the scripts call: the line so far, its last word unfinished
        Argument(("--words",), {"nargs": argparse.REMAINDER, "type": places.Word,
                                "help": argparse.SUPPRESS}),
    ),
    "write the script for machines",
)  # fmt: skip

FAMILIES: dict[str, tuple[Command, ...]] = {
    "workbench": (_STUDIO,),
    "describe": (_NEW, _CONVERT, _SHOW, _HOME, _DERIVE),
    "measure": (_EXCITE, _SIMULATE, _LOG),
    "identify": (_FIT, _COMPARE),
    "understand": (_DIAGNOSE, _ADD, _PHYSICAL, _FLEET),
    "use": (GENERATE, EXPORT),
    "about": (_ROBOTS, _CATALOGUE, _ESTIMATORS, _REPRODUCE, _DEMO, _COMPLETION),
}
"""What belongs together, in the order of `modeler --help`."""

COMMANDS = {command.name: command for family in FAMILIES.values() for command in family}
