"""What the lab does to a linear picture before it is stored: over-saturation and 8 bits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lightbench.exact.directions import Array


def lab_white(linear: Array) -> Array:
    """White in every pixel of which a channel is above 1."""
    return np.where((linear > 1.0).any(axis=-1, keepdims=True), 1.0, linear)


def truncated(display: Array) -> NDArray[np.uint8]:
    """int(255 c) of (2.1) for c in [0, 1]."""
    return (display * 255.0).astype(np.uint8)
