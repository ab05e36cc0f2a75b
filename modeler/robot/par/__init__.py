"""SYMORO's `.par` files as robot files: from their bytes to the text of ours, and what is lost."""

from modeler.robot.par.convert import Converted as Converted
from modeler.robot.par.convert import par_to_toml as par_to_toml
