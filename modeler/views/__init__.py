"""Results for people: pages without network, figures, notebook tables, the robot as it looks."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
