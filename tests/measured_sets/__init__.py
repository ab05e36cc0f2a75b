"""The diagnosis and `add auto` on logs of eight real machines, which are not part of the project.

Nobody knows the truth there. What can be asked is whether an answer stays when the look changes,
whether its values can be those of a machine, and whether the error on other motion falls.
"""
