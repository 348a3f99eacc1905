"""Textbook forms: right where they say that they are, and broken where it is known that they are.

The figures of the failures are those of numerical folklore, measured; each is met within a factor
of 2. See also the atlas, which draws them.
"""
# ruff: noqa: E741  (l is the direction to the light)

import math
from pathlib import Path

import numpy as np
import pytest

from lightbench.atlas import FINITE, chart
from lightbench.exact import Array, reference
from lightbench.exact.directions import unit
from lightbench.exact.facets import DISTRIBUTIONS
from lightbench.glsl import call
from lightbench.options import listing
from lightbench.sweep import Sweep, points, sweeps
from tests import samples
from tests.samples import evaluate, single
from tests.support import copy_of_shaders, library

# Relative error of a textbook form in its domain.
SAFE = 1e-3
PAIRS = [sweep for sweep in sweeps(library()) if sweep.textbook]
TEXTBOOKS = [path for path, file in library().files.items() if file.meta.textbook_of]


def named(sweep: Sweep) -> str:
    return f"{sweep.textbook}:{sweep.function}({sweep.x},{sweep.y})"


def in_domain(
    sweep: Sweep, values: dict[str, Array]
) -> "np.ndarray[tuple[int], np.dtype[np.bool]]":
    """Which points lie in the domain that the textbook form states."""
    domain = library().files[sweep.textbook].meta.domain
    inside = np.ones(len(values[sweep.x]), bool)
    for name, (low, high) in domain.items():
        value = values.get({"radiance": "level"}.get(name, name))
        assert value is not None, f"{sweep.textbook}: nothing sweeps '{name}'"
        inside &= (value >= low) & (value <= high)
    return inside


def test_each_is_seen() -> None:
    """A textbook form that no sweep reaches would be neither drawn nor tested."""
    assert {sweep.textbook for sweep in PAIRS} == set(TEXTBOOKS)


@pytest.mark.parametrize("sweep", PAIRS, ids=named)
def test_right_in_its_domain(sweep: Sweep) -> None:
    size = 48
    panel = chart(library(), sweep, size).panel(sweep.textbook, "float32")
    inside = in_domain(sweep, points(sweep, size)).reshape(size, size)
    assert inside.sum() > size
    assert (panel.kind[inside] == FINITE).all()
    assert panel.ulp[inside].max() * 2.0**-23 <= SAFE


@pytest.mark.parametrize("path", TEXTBOOKS)
def test_labelled_and_never_a_default(path: str) -> None:
    folder, name = path.removesuffix(".glsl").split("/")
    meta = library().files[path].meta
    assert meta.title.endswith(", textbook form")
    if folder in library().folders:
        assert meta.about.startswith("For comparison only: ")
        assert library().folders[folder].default != name
        assert name not in library().stable(folder)
        assert meta.title in listing(library())


# Where they fail


def in_random_frames(folder: Path, name: str, alpha: float, angle: Array) -> tuple[Array, Array]:
    """D of a file at angles from a normal of any direction, as a pixel has it: n and h rounded in
    world space and turned into the shading frame; and the truth."""
    code = f'#include "lib/frame.glsl"\n#include "distributions/{name}.glsl"\n'
    code += "float pixel(vec3 n, vec3 h, float a) { return distribution(h * basis(n), a); }\n"
    shaders = copy_of_shaders(folder, {"lib/pixel.glsl": code})
    random = np.random.default_rng(0)
    n = unit(random.normal(size=(len(angle), 3)))
    across = unit(np.cross(n, random.normal(size=n.shape)))
    h = n * np.cos(angle)[:, None] + across * np.sin(angle)[:, None]
    got = call("lib/pixel.glsl", "pixel", single(n), single(h), single([alpha]), shaders=shaders)
    flat = np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=-1)
    want = DISTRIBUTIONS[name.removesuffix("_textbook")](flat, np.full(len(angle), alpha))
    return got.astype(np.float64), want


@pytest.mark.parametrize(("alpha", "printed", "ours"), [(0.002025, 0.12, 2e-5), (1e-3, 0.6, 4e-5)])
def test_ggx_loses_its_peak(alpha: float, printed: float, ours: float, tmp_path: Path) -> None:
    angle = alpha * np.random.default_rng(1).uniform(0.0, 3.0, 50_000)
    got, want = in_random_frames(tmp_path / "a", "ggx_textbook", alpha, angle)
    assert printed / 2.0 < np.abs(got / want - 1.0).max() < printed * 2.0
    got, want = in_random_frames(tmp_path / "b", "ggx", alpha, angle)
    assert ours / 2.0 < np.abs(got / want - 1.0).mean() < ours * 2.0


def test_ggx_is_infinite_at_its_narrowest(tmp_path: Path) -> None:
    angle = 1e-4 * np.random.default_rng(1).uniform(0.0, 3.0, 50_000)
    got, _ = in_random_frames(tmp_path / "a", "ggx_textbook", 1e-4, angle)
    assert np.isinf(got).mean() > 0.3
    got, want = in_random_frames(tmp_path / "b", "ggx", 1e-4, angle)
    assert 2e-4 < np.abs(got / want - 1.0).mean() < 8e-4


@pytest.mark.parametrize("name", ["beckmann", "blinn_phong"])
def test_a_narrow_peak_is_noise(name: str, tmp_path: Path) -> None:
    """h = n: in a fifth of all frames the highlight is lost or 1e10 times too bright; ours is not
    off by 1e-5."""
    got, want = in_random_frames(tmp_path / "a", f"{name}_textbook", 1e-4, np.zeros(20_000))
    assert 0.1 < (np.abs(got / want - 1.0) > 0.5).mean() < 0.4
    assert (got < 1e-6 * want).any()
    assert (got > 1e6 * want).any()
    got, want = in_random_frames(tmp_path / "b", name, 1e-4, np.zeros(20_000))
    assert np.abs(got / want - 1.0).max() < 1e-5


def test_beckmann_is_undefined_at_its_ends() -> None:
    horizon, peak = single([[1.0, 0.0, 0.0]]), single([[0.0, 0.0, 1.0]])
    for h, alpha in ((horizon, 0.3), (peak, 0.0)):
        arguments = (h, single([alpha]))
        got = evaluate("distributions/beckmann_textbook.glsl", "distribution", arguments, {})
        assert np.isnan(got)
        ours = evaluate("distributions/beckmann.glsl", "distribution", arguments, {})
        assert np.isfinite(ours)


def test_smith_is_undefined_on_the_horizon() -> None:
    v, alpha = samples.direction(np.array([0.5]), np.array([1.0])), single([0.3])
    l, h = single([[1.0, 0.0, 0.0]]), single([[0.6, 0.0, 0.8]])
    for given in ((l, v, h, alpha), (v, l, h, alpha)):
        got = evaluate("maskings/smith_ggx_textbook.glsl", "visibility", given, {})
        assert np.isnan(got)
        ours = evaluate("maskings/smith_ggx.glsl", "visibility", given, {})
        assert np.isfinite(ours)


def test_smith_is_undefined_for_a_cosine_that_rounds_up() -> None:
    v, alpha = samples.direction(np.array([0.5]), np.array([1.0])), single([0.3])
    given = (single([[0.0, 0.0, np.nextafter(np.float32(1.0), np.float32(2.0))]]), v, v, alpha)
    assert np.isnan(evaluate("maskings/smith_ggx_textbook.glsl", "masking", given, {}))
    ours = evaluate("maskings/smith_ggx.glsl", "masking", given, {})
    assert ours == pytest.approx(
        evaluate("maskings/smith_ggx.glsl", "masking", (v, given[0], v, alpha), {})
    )


@pytest.mark.parametrize(
    ("light", "white", "kind"),
    [
        (0.0, 4.0, np.isnan), (math.inf, 4.0, np.isnan), (-1.0, 4.0, np.isneginf),
        (1.0, 0.0, np.isposinf), (1e20, 4.0, np.isposinf),
    ],
)  # fmt: skip
def test_reinhard_has_no_value(light: float, white: float, kind: np.ufunc) -> None:
    grey, settings = single([[light] * 3]), {"L_white": white}
    path = "tonemaps/reinhard_extended"
    assert kind(evaluate(f"{path}_textbook.glsl", "tonemap", (grey,), settings)).all()
    ours = evaluate(f"{path}.glsl", "tonemap", (grey,), settings)
    # What is no light to begin with is handed on to be seen.
    assert np.isfinite(ours).all() if math.isfinite(light) else (ours == light).all()


def test_spot_with_equal_cones_is_dark_on_their_border() -> None:
    """0/0, of which clamp() may make anything; the border belongs to the light."""
    given = (single([0.5]), single([0.5]), single([0.5]))
    assert evaluate("lib/spot.glsl", "spot", given, {}) == 1.0
    assert evaluate("lib/spot_textbook.glsl", "spot", given, {}) != 1.0


@pytest.mark.parametrize(("distance", "printed", "ours"), [(1e3, 0.033, 1e-5), (1e4, 0.41, 9e-5)])
def test_far_spheres_are_missed(distance: float, printed: float, ours: float) -> None:
    """Share of rays that are wrong about whether they hit, of those that pass within 1.5 radii."""
    count = 100_000
    offset = 1.5 * np.sqrt(np.random.default_rng(2).uniform(0.0, 1.0, count))
    rays = samples.rays(np.full(count, distance), offset)
    exact = reference(library(), "lib/sphere.glsl", "sphereHit")
    assert exact is not None
    hit = exact(*samples.doubled(rays)) > 0.0
    wrong = [
        ((evaluate(f"lib/{name}.glsl", "sphereHit", rays, {}) > 0.0) != hit).mean()
        for name in ("sphere_textbook", "sphere")
    ]
    assert printed / 2.0 < wrong[0] < printed * 2.0
    assert wrong[1] <= 2.0 * ours
