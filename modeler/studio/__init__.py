"""The workbench in the browser: a second skin of the API, beside the command line.

What computes is a command line, run as a process in the folder of the project; what draws asks a
process that holds logs and predictions.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
