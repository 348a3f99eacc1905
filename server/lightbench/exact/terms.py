"""Terms of lib/ that the formulas share, in float64."""

from __future__ import annotations

import math

import numpy as np

from lightbench.exact.directions import Array


def pow5(x: Array) -> Array:
    """x^5."""
    return x**5


def fresnel0(n1: Array, n2: Array) -> Array:
    """((n1 - n2) / (n1 + n2))^2."""
    return ((n1 - n2) / (n1 + n2)) ** 2


def specular_power(c: Array, sin2: Array, n: Array) -> Array:
    """max(0, cos)^n of an angle known by its cosine and its squared sine; 1 for n = 0."""
    cosine = np.where(sin2 < 0.5, np.sqrt(np.maximum(1.0 - sin2, 0.0)), c)
    return np.where(n == 0.0, 1.0, np.where(c > 0.0, np.maximum(cosine, 0.0) ** n, 0.0))


def smith_correlated(NoL: Array, NoV: Array, cosL: Array, cosV: Array) -> Array:
    """1 / (4 NoL NoV (1 + Lambda(l) + Lambda(v))), from the products cosine times Lambda."""
    return 1.0 / (4.0 * NoL * NoV * (1.0 + cosL / NoL + cosV / NoV))


def smith_separable(NoL: Array, NoV: Array, cosL: Array, cosV: Array) -> Array:
    """1 / (4 NoL NoV (1 + Lambda(l)) (1 + Lambda(v)))."""
    return 1.0 / (4.0 * NoL * NoV * (1.0 + cosL / NoL) * (1.0 + cosV / NoV))


def erfc(x: Array) -> Array:
    """2 / sqrt(pi) times the integral of exp(-t^2) from x on."""
    return np.asarray(np.vectorize(math.erfc, otypes=[np.float64])(x))
