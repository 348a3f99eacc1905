"""A binary hierarchy of boxes by the surface area heuristic, built level by level.

A set of boxes is cut, between two of the equal bins that their middles fall in, where the chance
that a ray meets a half, which its surface is, times the boxes in that half is least in all (Wald
2007, On Fast Construction of SAH-based Bounding Volume Hierarchies).
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["DEEPEST", "LEAF", "Hierarchy", "build"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Boxes in a leaf at most, levels at most, and bins along an axis.
LEAF, DEEPEST, BINS = 4, 64, 16
# What a box of a leaf costs a ray, where a node costs 1. From here to 2.5 all are as fast on
# llvmpipe, and the larger leaves of this one make the smaller table.
CONTENT = 0.7
# Nodes that are cut at a time: their bins take 50 MB.
PART = 1 << 15


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Nodes level by level, the root first; none where there are no boxes.

    `low` and `high` (N, 3) are a node's box; `child` (N,) is its first child, which the second
    comes after, or 0 for a leaf; the first is the lower one along `axis` (N,). A leaf holds `count`
    (N,) boxes of `order`, a permutation of all, from `start` (N,) on. `levels` has the first node
    of each level and, last, N.
    """

    low: Floats
    high: Floats
    axis: Ints
    child: Ints
    start: Ints
    count: Ints
    order: Ints
    levels: tuple[int, ...]


class _Boxes(NamedTuple):
    low: Floats
    high: Floats
    middle: Floats


class _Cut(NamedTuple):
    """Of each node: its box, the axis that it is cut across, and how many boxes go to the first
    child, 0 for a leaf."""

    low: Floats
    high: Floats
    axis: Ints
    first: Ints


def build(low: Floats, high: Floats) -> Hierarchy:
    """The hierarchy of boxes (B, 3)."""
    boxes = _Boxes(low, high, (low + high) / 2)
    order = np.arange(len(low))
    # A level without a node, so that there is one to join where there are no boxes.
    start = count = none = np.zeros(0, np.int64)
    nodes = [(low[:0], high[:0], none, none, none, none)]
    if len(low):
        start, count = np.array([0]), np.array([len(low)])
    levels = [0]
    while len(start):
        cut = _cut_level(boxes, order, start, count, DEEPEST - len(levels))
        inner = cut.first > 0
        levels.append(levels[-1] + len(start))
        child = np.where(inner, levels[-1] + 2 * (np.cumsum(inner) - 1), 0)
        nodes.append((cut.low, cut.high, cut.axis, child, start, np.where(inner, 0, count)))
        start = np.column_stack([start, start + cut.first])[inner].ravel()
        count = np.column_stack([cut.first, count - cut.first])[inner].ravel()
    columns: list[Any] = [np.concatenate(arrays) for arrays in zip(*nodes, strict=True)]
    bottom, top, axis, child, start, count = columns
    return Hierarchy(bottom, top, axis, child, start, count, order, tuple(levels))


def _cut_level(boxes: _Boxes, order: Ints, start: Ints, count: Ints, below: int) -> _Cut:
    """The cuts of a level's nodes, which hold `count` boxes of `order` from `start` on.

    What goes to the first child comes first in `order` afterwards. `below`: levels still to come.
    """
    parts = [
        _cut_part(boxes, order, start[i : i + PART], count[i : i + PART], below)
        for i in range(0, len(start), PART)
    ]
    return _Cut(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _cut_part(boxes: _Boxes, order: Ints, start: Ints, count: Ints, below: int) -> _Cut:
    begin = np.cumsum(count) - count
    node = np.repeat(np.arange(len(count)), count)
    place = np.arange(len(node)) + (start - begin)[node]
    own = _Boxes(*(array[order[place]] for array in boxes))
    low, high = np.minimum.reduceat(own.low, begin), np.maximum.reduceat(own.high, begin)
    nearest = np.minimum.reduceat(own.middle, begin)
    extent = np.maximum.reduceat(own.middle, begin) - nearest
    cost, axis, later = _best_cut(own, node, nearest, extent, count)
    surface = _surface(low, high)
    worth = CONTENT * cost + 2 * surface < CONTENT * count * surface
    leaf = (count == 1) | ((count <= LEAF) & ~worth)
    # Where no plane parts the boxes, or too few levels are left but for halves, each gets half.
    halved = ~np.isfinite(cost) | (np.ceil(np.log2(count / LEAF)) >= below)
    leaf |= halved & (count <= LEAF)
    axis = np.where(halved, extent.argmax(axis=1), axis)
    along = own.middle[np.arange(len(node)), axis[node]]
    rank = np.empty(len(node), np.int64)
    rank[np.lexsort((along, node))] = np.arange(len(node)) - begin[node]
    later = np.where(halved[node], rank >= ((count + 1) // 2)[node], later)
    order[place] = order[place][np.lexsort((later & ~leaf[node], node))]
    first = count - np.bincount(node, weights=later, minlength=len(count)).astype(np.int64)
    return _Cut(low, high, axis, np.where(leaf, 0, first))


def _best_cut(
    own: _Boxes, node: Ints, nearest: Floats, extent: Floats, count: Ints
) -> tuple[Floats, Ints, NDArray[np.bool_]]:
    """The least cost of each node, infinite where all middles coincide, its axis, and which boxes
    lie beyond that cut."""
    every = [_axis_cuts(own, node, nearest, extent, count, axis) for axis in range(3)]
    cost = np.stack([each[0] for each in every])
    axis = cost.argmin(axis=0)
    beyond = np.stack([each[1] for each in every])
    return cost.min(axis=0), axis, beyond[axis[node], np.arange(len(node))]


def _axis_cuts(
    own: _Boxes, node: Ints, nearest: Floats, extent: Floats, count: Ints, axis: int
) -> tuple[Floats, NDArray[np.bool_]]:
    """The least cost of a cut across an axis of each node, and which boxes lie beyond it."""
    nodes = np.arange(len(count))
    width = np.where(extent[:, axis] > 0, extent[:, axis], 1.0)
    share = (own.middle[:, axis] - nearest[node, axis]) / width[node]
    bins = np.minimum((share * BINS).astype(np.int64), BINS - 1)
    key = node * BINS + bins
    held = np.bincount(key, minlength=len(count) * BINS).reshape(-1, BINS)
    low, high = np.full((2, len(count) * BINS, 3), [[[np.inf]], [[-np.inf]]])
    for k in range(3):
        np.minimum.at(low[:, k], key, own.low[:, k])
        np.maximum.at(high[:, k], key, own.high[:, k])
    low, high = low.reshape(-1, BINS, 3), high.reshape(-1, BINS, 3)
    before = np.cumsum(held, axis=1)[:, :-1]
    after = count[:, None] - before
    cost = before * _grown(low, high) + after * _grown(low[:, ::-1], high[:, ::-1])[:, ::-1]
    cost = np.where((before > 0) & (after > 0), cost, np.inf)
    best = cost.argmin(axis=1)
    return cost[nodes, best], bins > best[node]


def _grown(low: Floats, high: Floats) -> Floats:
    """Surfaces (N, BINS - 1) of what holds the bins up to each, but the last; 0 for nothing."""
    low = np.minimum.accumulate(low, axis=1)[:, :-1]
    high = np.maximum.accumulate(high, axis=1)[:, :-1]
    empty = low[..., 0] > high[..., 0]
    return np.where(empty, 0.0, _surface(*np.where(empty[..., None], 0.0, (low, high))))


def _surface(low: Floats, high: Floats) -> Floats:
    """Half of a box's surface."""
    x, y, z = np.moveaxis(high - low, -1, 0)
    surface: Floats = x * y + y * z + z * x
    return surface
