"""Logs as people have them: many formats, any names and units, as named columns in ours."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
