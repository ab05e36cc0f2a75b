"""The commands that hand a model to other programs: C for controllers, files of other formats."""

from typing import get_args

from modeler.cli import places
from modeler.cli.options import Command, choice, flag, repeated, value
from modeler.cli.shared_arguments import CHANGED, FORCE, REQUIRED, ROBOT_OR_MODEL
from modeler.core import choices

GENERATE = Command(
    "generate", "derive:run_generate",
    "C source, header, manifest and build files",
    "Writes dependency-free C99 for ROBOT: regressors, inverse dynamics, inertia matrix, gravity, "
    "Coriolis, and the batch observation matrix, in a folder that builds by itself with make or "
    "cmake. Of a MODEL also functions that have its fitted values: they take no parameters, and "
    "their Coulomb friction can be smoothed.",
    "modeler generate panda --out panda_c; of a fitted model: "
    "modeler generate arm.model.json --out arm_c",
    (
        value("robot", "ROBOT|MODEL", places.RobotOrModel, ROBOT_OR_MODEL),
        CHANGED,
        value("--out", "DIR", places.ModuleFolder, "folder to write", **REQUIRED),
        choice("--precision", get_args(choices.Precision),
               "of all numbers of the C: double, or float for a microcontroller", "double"),
        flag("--cuda", "also the base regressor for graphics processors"),
        flag("--structured-text", "also function blocks for a PLC, IEC 61131-3"),
        flag("--a2l", "also a description of the parameter set for calibration tools"),
        repeated("--frame", "NAME", places.Word,
                 "also pose, Jacobian and twist of this row, or link of [frames]"),
        value("--only", "LIST", places.Word,
              'leave out what is not named: "inverse_dynamics,gravity"; with values and without; '
              "observation is that of many samples"),
        flag("--vectors",
             "also vectors.csv, 50 states with 50 digits, and a program in C that checks a port "
             "by them"),
        choice("--measure", get_args(choices.Machine),
               "also cost.json: stack, flash and instructions of every function there; wants gcc, "
               "for a Cortex-M arm-none-eabi-gcc"),
        FORCE,
    ),
    "write the manifest for machines",
)  # fmt: skip

EXPORT = Command(
    "export", "export:run_export",
    "the identified robot for another program: URDF, MJCF, SDF, CasADi, FMU, ROS 2",
    "Writes the masses, mass centres, inertias, friction and rotor inertias of MODEL as a machine "
    "that could be built: into the bytes of an ORIGINAL, of which nothing else changes, or into a "
    "file of its own whose links are capsules. Says what every number was and is, and which "
    "effects the format cannot hold. CasADi, FMU and ROS 2 get the equations instead, with the "
    "base parameters as they are.",
    "modeler export arm.model.json --like arm.urdf --out better.urdf",
    (
        value("source", "MODEL|ROBOT", places.RobotOrModel, ROBOT_OR_MODEL),
        choice("--to", ("urdf", "mjcf", "sdf", "casadi", "fmu", "simulink", "ros2"),
               "format; by --like, or by the ending of --out (.xml is MJCF)"),
        value("--like", "ORIGINAL", places.OriginalFile,
              "a file of the same robot: only its numbers are replaced"),
        value("--out", "FILE", places.OtherProgramsFile, "file to write; of ros2 a folder",
              **REQUIRED),
        flag("--force", "write over a file that is there"),
    ),
    "write the numbers for machines",
)  # fmt: skip
