"""Simulated measurements, by physics that share nothing with the regressor.

Rigid links in the world frame, effects as torques on shafts, a controller that sees a quantised
encoder: `simulate` gives a log as a machine would, and the truth beside it. Robots with loops carry
out the commanded motion exactly, or are driven by the controller too; they are closed by equations
that the modeling stages do not share.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
