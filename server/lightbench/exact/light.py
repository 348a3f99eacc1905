"""Lights and what they meet, in float64: falloff, cones, spheres, surroundings."""

from __future__ import annotations

import numpy as np

from lightbench.exact.directions import Array, Material, column, dot, unit


def polynomial(distance: Array, light: Material) -> Array:
    """1 / (c0 + c1 d + c2 d^2), at most 1e4."""
    p = light["c0"] + light["c1"] * distance + light["c2"] * distance**2
    return 1.0 / np.maximum(p, 1e-4)


def as_strong(distance: Array, light: Material) -> Array:
    """1."""
    return np.ones(np.shape(distance))


def inverse_square(distance: Array, light: Material) -> Array:
    """1 / max(d, radius)^2, the radius at least 1e-4 m."""
    return np.maximum(np.maximum(distance, light["light_radius"]), 1e-4) ** -2.0


def spot(cos_angle: Array, cos_inner: Array, cos_outer: Array) -> Array:
    """The squared ramp between the cones; a step where they meet."""
    meet = cos_inner <= cos_outer
    ramp = (cos_angle - cos_outer) / np.where(meet, 1.0, cos_inner - cos_outer)
    step = np.where(cos_angle >= cos_outer, 1.0, 0.0)
    return np.where(meet, step, np.clip(ramp, 0.0, 1.0) ** 2)


def sphere_hit(origin: Array, direction: Array, centre: Array, radius: Array) -> Array:
    """The smaller root above 0 of |o + t d - c|^2 = r^2, d made unit; -1 for none."""
    d, f = unit(direction), origin - centre
    b = dot(f, d)
    nearest = f - b[..., None] * d
    discriminant = radius**2 - dot(nearest, nearest)
    root = np.sqrt(np.maximum(discriminant, 0.0))
    first = np.where(-b - root > 0.0, -b - root, -b + root)
    return np.where((discriminant >= 0.0) & (first >= 0.0), first, -1.0)


def projected(p: Material, corner: Array) -> Array:
    """The corner along three directions."""
    return np.stack([dot(p[name], corner) for name in ("across", "up", "along")], axis=-1)


def edge_side(a: Array, b: Array) -> Array:
    """Twice the area of the triangle from the origin to a and b, below 0 where it is clockwise."""
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def corners_hit(a: Array, b: Array, c: Array) -> Array:
    """Where the z axis meets a triangle above the origin, and the weights of b and c; else -1."""
    areas = np.stack([edge_side(b, c), edge_side(c, a), edge_side(a, b)], axis=-1)
    total = areas.sum(axis=-1, keepdims=True)
    weights = areas / np.where(total == 0.0, 1.0, total)
    height = dot(weights, np.stack([a[:, 2], b[:, 2], c[:, 2]], axis=-1))
    inside = (total[:, 0] != 0.0) & (weights.min(axis=-1) >= 0.0)
    found = np.where(inside & (height > 0.0), height, -1.0)
    return np.column_stack([found, np.where(inside[:, None], weights[:, 1:], 0.0)])


def constant_ambient(
    m: Material,
    ambient_color: tuple[float, float, float] = (1.0, 1.0, 1.0),
    ambient_level: float | Array = 0.05,
) -> Array:
    """rho / pi times the integral of L cos over the hemisphere."""
    tint = np.array(ambient_color) * column(np.asarray(ambient_level))
    return m["base_color"] * tint


def no_ambient(m: Material) -> Array:
    """0."""
    return np.zeros((1, 3))
