"""Physical laws, by quadrature over the shaders' own values; a file that breaks one says so."""
# ruff: noqa: E741  (l is the direction to the light)

import itertools
import math
from typing import Any

import numpy as np
import pytest

from lightbench.exact import Array
from lightbench.exact.facets import DISTRIBUTIONS, MASKINGS
from lightbench.exact.models import cook_torrance_cos
from tests import samples
from tests.samples import direction, evaluate, single
from tests.support import library

CONSERVED = 1.0 + 1e-3
FURNACE = {"fresnel": "none"}


def lobe_grid(alpha: float, rings: int, sectors: int) -> tuple[Array, Array]:
    """Half vectors (N, 3) and solid angles (N,): Gauss-Legendre in tan(theta) = alpha u / (1 - u),
    which every width of lobe fills alike, and even steps of azimuth."""
    x, weight = np.polynomial.legendre.leggauss(rings)
    u = (x + 1.0) / 2.0
    tangent = alpha * u / (1.0 - u)
    theta = np.arctan(tangent)
    d_theta = 0.5 * weight * alpha / (1.0 - u) ** 2 / (1.0 + tangent**2)
    phi = (np.arange(sectors) + 0.5) * 2.0 * math.pi / sectors
    sin, cos = np.repeat(np.sin(theta), sectors), np.repeat(np.cos(theta), sectors)
    azimuth = np.tile(phi, rings)
    h = np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), cos], axis=-1)
    return h, sin * np.repeat(d_theta, sectors) * 2.0 * math.pi / sectors


def view_direction(cosine: float) -> Array:
    """A direction in the plane y = 0."""
    return np.array([math.sqrt(1.0 - cosine**2), 0.0, cosine])


def even(count: int) -> tuple[Array, Array]:
    """Directions (N, 3) over the hemisphere and their solid angles (N,)."""
    x, weight = np.polynomial.legendre.leggauss(count)
    cosine = np.repeat((x + 1.0) / 2.0, count)
    azimuth = np.tile((np.arange(count) + 0.5) * 2.0 * math.pi / count, count)
    solid = np.repeat(weight / 2.0, count) * 2.0 * math.pi / count
    return direction(cosine, azimuth).astype(np.float64), solid


def breaks(folder: str, name: str, law: str) -> bool:
    """Whether the file owns up to breaking the law."""
    return law in library().files[f"{folder}/{name}.glsl"].meta.breaks


@pytest.mark.parametrize("name", library().stable("distributions"))
@pytest.mark.parametrize("alpha", [1e-4, 1e-3, 0.03, 0.3, 0.7, 1.0])
def test_projected_facets_cover_the_surface(name: str, alpha: float) -> None:
    """The integral of D(h) cos over the hemisphere is 1: even steps of log tan(theta), which see
    a lobe of any width."""
    log_tangent, step = np.linspace(math.log(1e-9), math.log(1e9), 800, retstep=True)
    theta = np.arctan(np.exp(log_tangent))
    h = np.stack([np.sin(theta), np.zeros(len(theta)), np.cos(theta)], axis=-1)
    solid = 2.0 * math.pi * h[:, 0] ** 2 * h[:, 2] * step
    arguments = (single(h), single(np.full(len(h), alpha)))
    D = evaluate(f"distributions/{name}.glsl", "distribution", arguments, {})
    assert np.sum(D * h[:, 2] * solid) == pytest.approx(1.0, abs=1e-4)


# G1 as fitted is within 0.31 % of the one that keeps the law.
OWN = [
    ("ggx", "smith_ggx", 1e-4),
    ("ggx", "smith_ggx_uncorrelated", 1e-4),
    ("beckmann", "smith_beckmann", 3.2e-3),
    ("beckmann", "smith_beckmann_uncorrelated", 3.2e-3),
    ("beckmann", "smith_beckmann_exact", 1e-4),
]


@pytest.mark.parametrize(("distribution", "masking", "gate"), OWN)
def test_weak_white_furnace(distribution: str, masking: str, gate: float) -> None:
    """The facets seen from v cover what the surface covers: the integral of G1 D <v, h> is v.z."""
    n = single([[0.0, 0.0, 1.0]])
    for alpha, cosine in itertools.product((0.1, 0.4, 1.0), (0.05, 0.4, 1.0)):
        h, solid = lobe_grid(alpha, 300, 300)
        v, width = view_direction(cosine), single([alpha])
        D = evaluate(f"distributions/{distribution}.glsl", "distribution", (single(h), width), {})
        path, arguments = f"maskings/{masking}.glsl", (n, single([v]), n, width)
        G1 = evaluate(path, "masking", arguments, {})
        covered = G1[0] * np.sum(D * np.maximum(h @ v, 0.0) * solid) / cosine
        assert covered == pytest.approx(1.0, abs=gate), (alpha, cosine)


def test_correlation_only_brightens() -> None:
    for name in ("ggx", "beckmann"):
        meta = library().files[f"maskings/smith_{name}.glsl"].meta
        arguments = samples.interior("maskings", meta)
        high, low = (
            evaluate(f"maskings/smith_{name}{suffix}.glsl", "masking", arguments, {})
            for suffix in ("", "_uncorrelated")
        )
        assert (high >= low * (1.0 - 1e-6)).all()


# Reciprocity


def exchanged(name: str, settings: dict[str, Any]) -> tuple[Array, Array]:
    """f(l, v) and f(v, l) of a model for random directions."""
    path = f"models/{name}.glsl"
    m, l, v = samples.interior("models", library().files[path].meta)
    m = {**m, "kd": single([[0.0, 0.0, 0.0]])} if isinstance(m, dict) else m
    return evaluate(path, "brdf", (m, l, v), settings), evaluate(path, "brdf", (m, v, l), settings)


@pytest.mark.parametrize("name", library().choices("models"))
def test_reciprocity(name: str) -> None:
    """f(l, v) = f(v, l), and not so where the front matter says that it breaks."""
    maskings = library().stable("maskings") if name == "cook_torrance" else ["smith_ggx"]
    for masking in maskings:
        there, back = exchanged(name, {"masking": masking})
        off = np.abs(there - back) / np.maximum(there, 1e-30)
        assert (off.max() > 1e-2) if breaks("models", name, "reciprocity") else (off.max() <= 1e-5)


@pytest.mark.parametrize("name", ["phong", "blinn_phong"])
def test_by_how_much_the_old_models_are_not_reciprocal(name: str) -> None:
    """The highlights of f(l, v) and f(v, l) are as n.v to n.l."""
    _, l, v = samples.interior("models", library().files[f"models/{name}.glsl"].meta)
    there, back = exchanged(name, {})
    assert isinstance(l, np.ndarray)
    assert isinstance(v, np.ndarray)
    seen = back > 1e-12
    ratio = np.broadcast_to(v[:, 2:] / l[:, 2:], there.shape)
    assert there[seen] / back[seen] == pytest.approx(ratio[seen], rel=2e-5)


# Energy


def albedo(settings: dict[str, Any], alpha: float, cosine: float) -> tuple[float, float]:
    """Light sent back by facets that mirror everything: the shader's and the reference's."""
    h, solid = lobe_grid(alpha, 128, 96)
    v = np.broadcast_to(view_direction(cosine), h.shape)
    VoH = np.sum(v * h, axis=1)
    l = 2.0 * VoH[:, None] * h - v
    seen = (VoH > 0.0) & (l[:, 2] > 0.0)
    lv = single(l[seen]), single(v[seen])
    m = samples.material([math.sqrt(alpha)], [1.0]) | {"metalness": single([1.0])}
    got = evaluate("models/cook_torrance.glsl", "brdfCos", (m, *lv), settings)
    want = cook_torrance_cos(*samples.doubled((m, *lv)), **settings)
    solid_l = 4.0 * VoH[seen] * solid[seen]
    return float(got[:, 0] @ solid_l), float(want[:, 0] @ solid_l)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
@pytest.mark.parametrize("masking", MASKINGS)
def test_facets_conserve_energy(distribution: str, masking: str) -> None:
    """No D gains energy with a masking made for it, or for any; a file that says so does."""
    settings = {"distribution": distribution, "masking": masking, **FURNACE}
    highest = 0.0
    for alpha, cosine in itertools.product((0.1, 0.5, 1.0), (0.02, 0.3, 1.0)):
        got, want = albedo(settings, alpha, cosine)
        assert got == pytest.approx(want, abs=1e-3)
        highest = max(highest, got)
    if breaks("maskings", masking, "energy"):
        assert highest > CONSERVED
    elif f"smith_{distribution}" in masking or masking == "cook_torrance":
        assert highest <= CONSERVED
    elif breaks("distributions", distribution, "energy") and "beckmann" in masking:
        assert highest > CONSERVED


SPOTS = [
    ("ggx", "smith_ggx", 1.0, 1.0, 1.0 - math.log(2.0)),
    ("ggx", "cook_torrance", 1.0, 1.0, 3.0 / 8.0),
    ("blinn_phong", "smith_beckmann", 0.5, 0.02, 1.09),
    ("blinn_phong", "smith_beckmann", 1.0, 0.02, 1.62),
    ("blinn_phong", "smith_beckmann_uncorrelated", 1.0, 0.02, 1.30),
]


@pytest.mark.parametrize(("distribution", "masking", "alpha", "cosine", "expected"), SPOTS)
def test_white_furnace_spots(
    distribution: str, masking: str, alpha: float, cosine: float, expected: float
) -> None:
    settings = {"distribution": distribution, "masking": masking, **FURNACE}
    exact = expected in (1.0 - math.log(2.0), 3.0 / 8.0)
    got, _ = albedo(settings, alpha, cosine)
    assert got == pytest.approx(expected, abs=5e-4 if exact else 6e-3)


@pytest.mark.parametrize("name", library().choices("models"))
def test_white_model_conserves_energy(name: str) -> None:
    """A white surface sends back at most what comes, unless its front matter says otherwise."""
    l, solid = even(64)
    white = {field: single([[1.0, 1.0, 1.0]]) for field in ("base_color", "ks")}
    m = samples.material([math.sqrt(0.1)], [4.0]) | white | {"metalness": single([0.0])}
    m |= {"kd": single([[0.2, 0.2, 0.2]]), "f0": single([[0.04, 0.04, 0.04]])}
    sent = []
    for cosine in (0.1, 0.5, 1.0):
        v = single(np.broadcast_to(view_direction(cosine), l.shape))
        f = evaluate(f"models/{name}.glsl", "brdf", (m, single(l), v), {})
        sent.append(float(np.sum(f[:, 0] * l[:, 2] * solid)))
    assert (max(sent) > CONSERVED) == breaks("models", name, "energy"), sent
