"""What was identified, written for other programs: URDF, MJCF, SDF."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
