"""Robot files of machines that are not built in as they are measured here."""

from modeler.core.builtin import builtin_text

DUALARM7 = """
name = "dualarm7"
title = "One arm of a dual-arm robot, 7R, harmonic drives"
notes = "Drive gains are not known: torques are in amperes of motor current."
gravity = [0, 0, "-g"]                # m/s^2

[symbols]
g = 9.81                              # m/s^2
R1 = 0.18                             # m
R3 = 0.27                             # m
D4 = 0.03857                          # m
R5 = 0.20                             # m
D7 = 0.065                            # m

[mdh]                                 # sigma: 0 revolute, 1 prismatic, 2 fixed
columns = ["j", "a", "alpha",  "d",  "theta",     "r"]
rows = [
          ["1", "0", "-pi/2",   0,   "q1 + pi/2", "R1"],
          ["2", "1", "-pi/2",   0,   "q2",         0],
          ["3", "2", "pi/2",    0,   "q3",        "R3"],
          ["4", "3", "-pi/2",  "D4", "q4",         0],
          ["5", "4", "pi/2",    0,   "q5",        "R5"],
          ["6", "5", "-pi/2",   0,   "q6 - pi/2",  0],
          ["7", "6", "pi/2",   "D7", "q7",         0],
]

[effects]
rotor_inertia = "all"
viscous = "all"
coulomb = "all"
offset = "all"

[drive_gains]
1 = 1.0
2 = 1.0
3 = 1.0
4 = 1.0
5 = 1.0
6 = 1.0
7 = 1.0
"""


def panda() -> str:
    """The built-in arm with friction; its sensors stand behind the gears and feel no rotor."""
    return builtin_text("panda") + (
        '\n[effects]\nviscous = "all"\ncoulomb = "all"\noffset = "all"\n'
    )
