"""Two sliding blocks and a wall, whose collisions count the digits of pi.

>>> from piblocks import Scene
>>> Scene(digits=3).count
314
"""

from __future__ import annotations

from . import _errors  # the extension raises what is defined there
from . import _piblocks
from ._compare import Comparison, compare
from ._errors import (
    DrawError,
    Error,
    IoError,
    MediaError,
    SceneError,
    SimulationError,
    UsageError,
)
from ._film import Frames
from ._golden import GoldenResult
from ._keys import keys
from ._notebook import Player
from ._render import Rendered, join
from ._run import BodiesState, State
from ._scene import Scene, scenes

__version__: str = _piblocks.VERSION

__all__ = [
    "BodiesState",
    "Comparison",
    "DrawError",
    "Error",
    "Frames",
    "GoldenResult",
    "IoError",
    "MediaError",
    "Player",
    "Rendered",
    "Scene",
    "SceneError",
    "SimulationError",
    "State",
    "UsageError",
    "compare",
    "join",
    "keys",
    "scenes",
]
