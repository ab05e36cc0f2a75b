"""From a table to the model linear in its parameters, and to base parameters with their proof."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
