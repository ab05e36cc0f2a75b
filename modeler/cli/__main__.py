"""`python -m modeler.cli`."""

import sys

from modeler.cli import main

sys.exit(main())
