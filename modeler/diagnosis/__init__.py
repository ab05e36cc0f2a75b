"""Which physical effect a model lacks, what it would gain, and the model with it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
