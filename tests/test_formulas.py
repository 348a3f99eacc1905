"""Every shader function against its float64 reference; a new file without one fails here."""
# ruff: noqa: E741  (l is the direction to the light)

import importlib
import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightbench.exact import reference, views
from lightbench.exact.facets import DISTRIBUTIONS, FRESNELS, MASKINGS
from lightbench.glsl import call
from tests import arguments as given
from tests import functions, samples
from tests.samples import Settings, evaluate, single
from tests.support import SHADERS, copy_of_shaders, library

# Gates: relative error in the interior, where an exp() or pow() falls to 1e-30 there, and at the
# extremes of a domain; what should be below 1e-30 may be anything as small.
INTERIOR, POWER, EXTREME, TINY = 1e-5, 3e-5, 1e-3, 1e-30
# Absolute error that a file's `about` owns up to: 0.0006 of a code of 255.
APPROXIMATE = {"transfers/srgb.glsl": 0.0006 / 255}
# Forms whose value is a difference: the size of what is subtracted, to which the error is relative.
DIFFERENCES: dict[tuple[str, str], Callable[..., Any]] = {
    **dict.fromkeys(
        ((f"biases/{name}.glsl", "compared") for name in library().choices("biases")),
        lambda distance, far, reach, NoL, **_: (distance / far) ** 2 + 0.02,
    ),
    **dict.fromkeys(
        (
            *((f"mappings/{name}.glsl", "mapping") for name in ("lab", "spherical")),
            *((f"views/dir_{axis}.glsl", "view") for axis in "xyz"),
        ),
        lambda vector: np.ones((1, 1)),
    ),
    ("views/depth.glsl", "view"): lambda radiance, depth_range=10.0: (
        1.0 + radiance[:, :1] / depth_range
    ),
    ("views/diffuse.glsl", "reflected"): views.whole,
    ("views/fresnel.glsl", "term"): lambda m, l, v, **_: np.ones((1, 1)),
    ("views/normal.glsl", "view"): lambda vector: np.ones((1, 1)),
    ("views/specular.glsl", "reflected"): views.whole,
    ("views/tangent.glsl", "view"): lambda vector: np.ones((1, 1)),
}
# Folders whose values may be below 0: nothing is stored that a biased distance is compared with.
SIGNED = ("biases",)

CHOICES, HOOKS, LIB = functions.choices(), functions.hooks(), functions.lib()


def test_every_function_has_a_test() -> None:
    """What cannot be called is named with the test of pictures that shows it; that test exists."""
    named, there = set(functions.ELSEWHERE), functions.uncalled()
    assert not there - named, "name the test that covers these in functions.ELSEWHERE"
    assert not named - there, "these can be called, or are gone"
    for test in set(functions.ELSEWHERE.values()):
        module, name = test.split(".")
        assert callable(getattr(importlib.import_module(f"tests.{module}"), name)), test


def variants(path: str) -> list[dict[str, Any]]:
    """The default settings, then each parameter of the file alone at each end of its range."""
    ends: dict[str, tuple[Any, ...]] = {
        name: (False, True) if p.kind == "bool" else p.range or ()
        for name, p in library().files[path].meta.parameters.items()
        if p.per == "frame"
    }
    return [{}, *({name: end} for name, values in ends.items() for end in values)]


# Where an exact form is listed: those that the microfacet model combines have tables of their own.
TABLES = {
    "distributions": "DISTRIBUTIONS of facets", "maskings": "MASKINGS of facets",
    "fresnels": "FRESNELS of facets", "tonemaps": "TONEMAPS of display",
    "transfers": "TRANSFERS of display", "quantisations": "QUANTISATIONS of display",
    "views": "VIEWS or HOOKS of views",
}  # fmt: skip


def exact(path: str, function: str) -> Any:
    """The float64 twin."""
    found = reference(library(), path, function)
    if found is None:
        table = TABLES.get(path.split("/")[0], "FUNCTIONS of __init__")
        pytest.fail(
            f"shaders/{path} has no exact form: write its {function}() in float64 and add it to "
            f"{table}.py in server/lightbench/exact/"
        )
    return found


def error(
    path: str, function: str, arguments: samples.Arguments, settings: Settings, **where: Any
) -> Any:
    """Relative error of every number, once each is seen to be finite and not negative."""
    got = evaluate(path, function, arguments, settings, **where)
    with np.errstate(over="ignore", under="ignore"):
        want = np.asarray(exact(path, function)(*samples.doubled(arguments), **settings))
        want = np.broadcast_to(want, got.shape)
        assert np.isfinite(got).all(), f"{path}: {function} is not finite"
        if path.split("/")[0] not in SIGNED:
            assert (got >= 0.0).all(), f"{path}: {function} is negative"
        # Infinite in truth: the file's floor bites there, and finite is all that is asked.
        known = np.abs(want) < 1e40
        known &= (np.abs(want) > TINY) | (got > 2.0 * TINY)
        off = np.maximum(np.abs(got - want) - allowed(path, function), 0.0)
        size = np.maximum(np.abs(want), subtracted(path, function, arguments, settings))
        return np.where(known, off / np.maximum(size, TINY), 0.0)


def subtracted(path: str, function: str, arguments: samples.Arguments, settings: Settings) -> Any:
    """The size of what a form subtracts, (N, 1) or as its value; 0 for one that does not."""
    form = DIFFERENCES.get((path, function))
    return 0.0 if form is None else form(*samples.doubled(arguments), **settings)


def allowed(path: str, function: str) -> float:
    """Absolute error that the files in use own up to."""
    files = functions.source(path, function).files
    return max((APPROXIMATE.get(file, 0.0) for file in files), default=0.0)


def assert_within(
    path: str, function: str, arguments: samples.Arguments, settings: Settings, gate: float
) -> None:
    """Fail with the worst row: its arguments, both values, and their distance in ULP."""
    off = error(path, function, arguments, settings)
    if off.max() <= gate:
        return
    row = np.unravel_index(np.argmax(off), off.shape)[0]
    got = evaluate(path, function, arguments, settings)[row]
    wanted = np.asarray(exact(path, function)(*samples.doubled(arguments), **settings))
    want = np.broadcast_to(wanted, off.shape)[row]
    ulp = np.abs(got - want) / np.spacing(np.abs(want).astype(np.float32))
    given = [
        {k: v[row % len(v)].tolist() for k, v in a.items()}
        if isinstance(a, dict)
        else a[row % len(a)].tolist()
        for a in arguments
    ]
    pytest.fail(
        f"{path}: {function}{tuple(given)} under {settings} is {got}, exactly {want}: "
        f"{ulp} ULP off; the gate is {gate:g} relative"
    )


@pytest.mark.parametrize(("path", "function"), CHOICES)
def test_interior(path: str, function: str) -> None:
    arguments = samples.interior(path.split("/")[0], library().files[path].meta)
    for settings in variants(path):
        assert_within(path, function, arguments, settings, INTERIOR)


@pytest.mark.parametrize(("path", "function"), CHOICES)
def test_extremes(path: str, function: str) -> None:
    arguments = samples.extremes(path.split("/")[0], library().files[path].meta)
    for settings in variants(path):
        assert_within(path, function, arguments, settings, EXTREME)


def alternatives(path: str, function: str) -> list[dict[str, Any]]:
    """Every choice, one at a time, of each folder that the function's file includes."""
    menu = library()
    own = menu.folders[path.split("/")[0]].setting
    found = [s for s in functions.source(path, function).settings if s != own]
    every = [(s, choice) for s in found for choice in menu.stable(menu.folder_of(s))]
    return [
        {s: choice}
        for s, choice in every
        if not functions.of_scenes(functions.source(path, function, {s: choice}))
    ]


@pytest.mark.parametrize(("path", "function"), HOOKS)
def test_other_functions(path: str, function: str) -> None:
    assert function in given.OTHERS, f"add arguments for {function} to arguments.OTHERS"
    for settings in [*variants(path), *alternatives(path, function)]:
        assert_within(path, function, given.OTHERS[function](), settings, POWER)


MICROFACETS = list(itertools.product(DISTRIBUTIONS, MASKINGS, FRESNELS))


@pytest.mark.parametrize(("distribution", "masking", "fresnel"), MICROFACETS)
def test_microfacet_model(distribution: str, masking: str, fresnel: str) -> None:
    settings = {"distribution": distribution, "masking": masking, "fresnel": fresnel}
    meta = library().files["models/cook_torrance.glsl"].meta
    for arguments, gate in (
        (samples.interior("models", meta), POWER),
        (samples.extremes("models", meta), EXTREME),
    ):
        assert_within("models/cook_torrance.glsl", "brdfCos", arguments, settings, gate)


@pytest.mark.parametrize("name", library().stable("distributions"))
def test_narrow_lobes_keep_their_shape(name: str) -> None:
    """From 1e-4 rad of the normal to the horizon, wherever D is no less than 1e-30."""
    for alpha in (1e-4, 1e-3, 0.002025, 0.01, 0.045):
        theta = np.concatenate([np.geomspace(1e-4, 1.5707, 800), alpha * np.linspace(0.1, 12, 800)])
        theta = theta[theta < 1.5707]
        h = single(np.stack([np.sin(theta), np.zeros(len(theta)), np.cos(theta)], axis=-1))
        arguments = (h, single(np.full(len(h), alpha)))
        off = error(f"distributions/{name}.glsl", "distribution", arguments, {})
        assert off.max() <= (1e-3 if alpha < 1e-3 else 1e-4), alpha


# Vectors, whose components are judged by a length of 1, and distances of points about it; as Lambda
# is by the 1 that it is added to.
OF_LENGTH = (
    "lib/cone.glsl",
    "lib/cube.glsl",
    "lib/disk.glsl",
    "lib/frame.glsl",
    "lib/heat.glsl",
    "lib/longitude.glsl",
    "lib/ray.glsl",
    "lib/shapes.glsl",
    "lib/strokes.glsl",
    "lib/tangent.glsl",
    "lib/triangle.glsl",
    "lib/watertight.glsl",
)
# An angle of 63 turns of the disk is rounded by 8e-6, and so is 63 times the golden angle.
GATES = {"specularPower": POWER, "diskPoint": 3e-5}


@pytest.mark.parametrize(("path", "function"), LIB)
def test_lib(path: str, function: str) -> None:
    name = Path(path).stem, function
    assert name in given.LIB, f"add arguments for {function} of shaders/{path} to arguments.LIB"
    arguments = given.LIB[name]()
    got = evaluate(path, function, arguments, {})
    with np.errstate(under="ignore"):
        want = exact(path, function)(*samples.doubled(arguments))
    floor = 1.0 if path in OF_LENGTH or "lambda" in path else TINY
    with np.errstate(invalid="ignore"):
        off = np.abs(got - want) / np.maximum(np.abs(want), floor)
    same = (got == want) | (np.isnan(got) & np.isnan(want))
    gate = GATES.get(function, INTERIOR)
    assert np.where(same, 0.0, off).max() <= gate


def test_basis_is_orthonormal_everywhere(tmp_path: Path) -> None:
    columns = [f"vec3 column{i}(vec3 n) {{ return basis(n)[{i}]; }}" for i in range(3)]
    text = "\n".join(['#include "lib/frame.glsl"', *columns, ""])
    shaders = copy_of_shaders(tmp_path, {"lib/column.glsl": text})
    n = given.FACING
    found = [call("lib/column.glsl", f"column{i}", n, shaders=shaders) for i in range(3)]
    t, b, z = (column.astype(np.float64) for column in found)
    assert np.array_equal(z, n)
    assert np.abs(np.cross(t, b) - z).max() < 5e-7
    for a, c, product in ((t, t, 1.0), (b, b, 1.0), (t, b, 0.0), (t, z, 0.0), (b, z, 0.0)):
        assert np.abs(np.sum(a * c, axis=1) - product).max() < 5e-7


# The checks themselves

MUTATIONS = [
    ("distributions/ggx.glsl", "PI * d * d", "d * d"),
    ("distributions/ggx.glsl", "a2 * h.z * h.z", "a2 * h.z"),
    ("distributions/beckmann.glsl", "PI * a2 * c2 * c2", "PI * a2 * c2"),
    ("distributions/blinn_phong.glsl", "2.0 * (1.0 - a) * (1.0 + a) / a2", "2.0 / a2"),
    ("maskings/cook_torrance.glsl", "min(l.z, v.z)", "l.z"),
    ("maskings/smith_ggx.glsl", "lambdaGgx(v, alpha)", "lambdaGgx(l, alpha)"),
    ("maskings/smith_ggx_fast.glsl", "2.0 * l.z * v.z", "l.z * v.z"),
    ("maskings/smith_beckmann_exact.glsl", "lambdaBeckmannExact(v", "lambdaBeckmannExact(l"),
    ("fresnels/dielectric.glsl", "- r * r)", "+ r * r)"),
    ("fresnels/schlick.glsl", "pow5(max(1.0 - VoH, 0.0))", "1.0 - pow5(VoH)"),
    ("models/lambert.glsl", " * INV_PI", ""),
    ("models/phong.glsl", "m.kd * l.z", "m.kd"),
    ("models/blinn_phong.glsl", "m.kd * l.z + m.ks * lobe", "m.kd * l.z + m.ks * lobe * l.z"),
    ("models/cook_torrance.glsl", "facetsSeen(l, v, h, alpha));", "0.25);"),
    ("models/cook_torrance.glsl", "overBase(m, F, facets)", "overBase(m, vec3(0.0), facets)"),
    ("models/toon.glsl", "cosine * float(TONES)", "cosine * 2.5"),
    ("models/toon.glsl", "mix(u_toon_dark, u_toon_lit", "mix(u_toon_lit, u_toon_dark"),
    ("attenuations/inverse_square.glsl", "1.0 / (d * d)", "1.0 / d"),
    ("attenuations/polynomial.glsl", "distance * light.c2", "light.c2"),
    ("ambients/constant.glsl", " * u_ambient_level", ""),
    ("tonemaps/reinhard.glsl", "1.0 + Y", "1.0 + radiance"),
    ("tonemaps/reinhard_extended.glsl", "u_L_white * u_L_white", "u_L_white"),
    ("transfers/gamma.glsl", "1.0 / u_gamma", "u_gamma"),
    ("transfers/srgb.glsl", "12.92", "12.29"),
    ("transfers/srgb_pow.glsl", "1.0 / 2.4", "1.0 / 2.2"),
    ("quantisations/ordered.glsl", "(b & 2) << 1", "(a & 2) << 1"),
    ("quantisations/round.glsl", "return code", "return 0.5 * code"),
    ("quantisations/truncate.glsl", "255.0 * code", "255.0 * code + 0.5"),
    ("biases/constant.glsl", "share * share", "share"),
    ("biases/normal_offset.glsl", "share * share", "share"),
    ("biases/slope.glsl", "distance - slopeBias", "distance + slopeBias"),
    ("views/depth.glsl", "1.0 - d / u", "d / u"),
    ("views/final.glsl", "exp2(u_exposure)", "(1.0 + u_exposure)"),
    ("views/normal.glsl", "0.5 + 0.5", "1.0 + 0.5"),
]


@pytest.mark.parametrize(("path", "old", "new"), MUTATIONS)
def test_a_broken_shader_is_noticed(path: str, old: str, new: str, tmp_path: Path) -> None:
    text = (SHADERS / path).read_text()
    assert text.count(old) >= 1
    shaders = copy_of_shaders(tmp_path, {path: text.replace(old, new)})
    meta, function = library().files[path].meta, library().promised(path) or ""
    arguments = samples.interior(path.split("/")[0], meta)
    worst = max(error(path, function, arguments, s, shaders=shaders).max() for s in variants(path))
    assert worst > 10.0 * INTERIOR
