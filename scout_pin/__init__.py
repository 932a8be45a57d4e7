"""Scout: an 18-DoF biped with closed-form kinematics and floor contacts, on Pinocchio.

Public names stand in ``__init__.pyi``, in the same order for both robots.
"""

import lazy_loader

from thesis_pin.version import __version__ as __version__

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
