"""C99 that needs no allocation and no library but <math.h>."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
