"""One door for work that comes in many like pieces: here, in processes, or on other machines."""

from modeler.jobs.run import Done as Done
from modeler.jobs.run import Workers as Workers
from modeler.jobs.run import open_workers as open_workers
