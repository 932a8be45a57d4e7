"""What any robot needs, and what both robots' packages share; knows neither robot.

Public names stand in ``__init__.pyi`` and are imported on first use, so that
``--help`` and readers of a specification don't wait for Pinocchio.
"""

import lazy_loader

from thesis_pin.version import __version__ as __version__

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
