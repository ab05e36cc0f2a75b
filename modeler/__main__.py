"""`python -m modeler`."""

import sys

from modeler.cli import main

sys.exit(main())
