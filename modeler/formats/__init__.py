"""Reads and writes robots in the formats of other programs: URDF, MJCF, SDF, SYMORO."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
