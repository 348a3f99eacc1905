"""Every shader function against its float64 reference; a new file without one fails here."""
# ruff: noqa: E741  (l is the direction to the light)

import itertools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightbench.exact import display, reference
from lightbench.exact.facets import DISTRIBUTIONS, FRESNELS, MASKINGS, lambda_beckmann_exact
from lightbench.glsl import call
from tests import samples
from tests.samples import Settings, direction, evaluate, single
from tests.support import SHADERS, copy_of_shaders, library

# Gates: relative error in the interior, where an exp() or pow() falls to 1e-30 there, and at the
# extremes of a domain; what should be below 1e-30 may be anything as small.
INTERIOR, POWER, EXTREME, TINY = 1e-5, 3e-5, 1e-3, 1e-30
# Absolute error that a file's `about` owns up to: 0.0006 of a code of 255.
APPROXIMATE = {"transfers/srgb.glsl": 0.0006 / 255, "views/final.glsl": 0.0006 / 255}
# What cannot be called from a test: no value comes back.
UNCALLED = ("void", "mat3")


def contract(path: str) -> list[str]:
    """Names of the functions of a file that its folder promises, or all of a lib file."""
    file, folder = library().files[path], library().folders.get(path.split("/")[0])
    if folder is None:
        lines = file.code.split("\n")
        return [f for f, n in file.functions.items() if lines[n - 1].split()[0] not in UNCALLED]
    # A function of nothing is a mark for #if and has no value to check.
    signatures = [s for s in (folder.function, *folder.optional) if "()" not in s]
    promised = [s.split("(")[0].split()[-1] for s in signatures]
    return [f for f in promised if f in file.functions]


def pure(folder_is_choice: bool) -> list[tuple[str, str]]:
    """(file, function) of the choices, or of lib/, that read no texture."""
    menu = library()
    return [
        (path, function)
        for path, file in menu.files.items()
        if (path.split("/")[0] in menu.folders if folder_is_choice else path.startswith("lib/"))
        and not file.meta.reads
        and not file.meta.textbook_of  # those are in test_textbook.py
        for function in contract(path)
    ]


CHOICES, LIB = pure(True), pure(False)


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
    "transfers": "TRANSFERS of display",
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
        assert (got >= 0.0).all(), f"{path}: {function} is negative"
        # Infinite in truth: the file's floor bites there, and finite is all that is asked.
        known = np.abs(want) < 1e40
        known &= (np.abs(want) > TINY) | (got > 2.0 * TINY)
        off = np.maximum(np.abs(got - want) - APPROXIMATE.get(path, 0.0), 0.0)
        return np.where(known, off / np.maximum(np.abs(want), TINY), 0.0)


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


@pytest.mark.parametrize(("path", "function"), LIB)
def test_lib(path: str, function: str) -> None:
    name = Path(path).stem, function
    assert name in samples.LIB, f"add arguments for {function} of shaders/{path} to samples.LIB"
    arguments = samples.LIB[name]()
    got = evaluate(path, function, arguments, {})
    with np.errstate(under="ignore"):
        want = exact(path, function)(*samples.doubled(arguments))
    # A vector's components are judged by its length, Lambda by the 1 that it is added to.
    floor = 1.0 if path == "lib/frame.glsl" or "lambda" in path else TINY
    with np.errstate(invalid="ignore"):
        off = np.abs(got - want) / np.maximum(np.abs(want), floor)
    same = (got == want) | (np.isnan(got) & np.isnan(want))
    gate = POWER if function == "specularPower" else INTERIOR
    assert np.where(same, 0.0, off).max() <= gate


def test_basis_is_orthonormal_everywhere(tmp_path: Path) -> None:
    columns = [f"vec3 column{i}(vec3 n) {{ return basis(n)[{i}]; }}" for i in range(3)]
    text = "\n".join(['#include "lib/frame.glsl"', *columns, ""])
    shaders = copy_of_shaders(tmp_path, {"lib/column.glsl": text})
    n = samples.FACING
    found = [call("lib/column.glsl", f"column{i}", n, shaders=shaders) for i in range(3)]
    t, b, z = (column.astype(np.float64) for column in found)
    assert np.array_equal(z, n)
    assert np.abs(np.cross(t, b) - z).max() < 5e-7
    for a, c, product in ((t, t, 1.0), (b, b, 1.0), (t, b, 0.0), (t, z, 0.0), (b, z, 0.0)):
        assert np.abs(np.sum(a * c, axis=1) - product).max() < 5e-7


# Limits


def test_nothing_below_the_horizon() -> None:
    down, up = single([[0.6, 0.0, -0.8]]), single([[0.0, 0.0, 1.0]])
    m, alpha = samples.material([0.5], [10.0]), single([0.3])
    for name in library().stable("distributions"):
        for h in (down, single([[1.0, 0.0, 0.0]])):
            assert evaluate(f"distributions/{name}.glsl", "distribution", (h, alpha), {}) == 0.0
    for name in library().choices("models"):
        for l, v in ((down, up), (up, down), (down, down), (single([[1.0, 0.0, 0.0]]), up)):
            assert not evaluate(f"models/{name}.glsl", "brdf", (m, l, v), {}).any(), name


def masked(name: str, cosine_l: float, cosine_v: float, alpha: float) -> float:
    """G of a masking at two cosines, with l and v a right angle apart in azimuth."""
    l, v = (direction(np.array([c]), np.array([a])) for c, a in ((cosine_l, 0.0), (cosine_v, 1.6)))
    arguments = (l, v, samples.halves(l, v), single([alpha]))
    return float(evaluate(f"maskings/{name}.glsl", "masking", arguments, {})[0])


@pytest.mark.parametrize(
    ("name", "slope"),
    [
        ("smith_ggx", 2.0), ("smith_ggx_fast", 2.0),
        ("smith_beckmann", 3.535), ("smith_beckmann_exact", 2.0 * math.sqrt(math.pi)),
        ("smith_ggx_uncorrelated", 2.0), ("smith_beckmann_uncorrelated", 3.535),
    ],
)  # fmt: skip
def test_smith_falls_linearly_to_the_horizon(name: str, slope: float) -> None:
    """G / n.l goes to slope / alpha, whatever v for the correlated form; to half of that where
    n.v = n.l, of which the separable form keeps nothing."""
    near = 1e-6
    for alpha in (0.05, 0.5, 1.0):
        assert masked(name, near, 1.0, alpha) / near == pytest.approx(slope / alpha, rel=2e-4)
        both = masked(name, near, near, alpha) / near
        expected = near * (slope / alpha) ** 2 if "un" in name else slope / alpha / 2.0
        assert both == pytest.approx(expected, rel=2e-4)


def test_fitted_beckmann_masking_is_near_the_exact_one() -> None:
    """G1 within 0.31 % of the one with erf()."""
    cosine = np.linspace(0.001, 1.0, 1000)
    v, alpha = direction(cosine, np.zeros(1000)), single(np.full(1000, 0.5))
    n = single([[0.0, 0.0, 1.0]])
    got = evaluate("maskings/smith_beckmann.glsl", "masking", (n, v, n, alpha), {})
    exact = 1.0 / (1.0 + lambda_beckmann_exact(v.astype(np.float64), alpha.astype(np.float64)))
    off = np.abs(got / exact - 1.0)
    assert 0.0025 < off.max() < 0.0032


# Display


@pytest.mark.parametrize("name", library().choices("transfers"))
def test_transfer_ends(name: str) -> None:
    """Black, white and beyond; rising between; a NaN is loud."""
    ramp = np.repeat(np.linspace(0.0, 1.0, 4096)[:, None], 3, axis=1)
    code = evaluate(f"transfers/{name}.glsl", "transfer", (single(ramp),), {})
    assert not code[0].any()
    assert (code[-1] == 1.0).all()
    assert (np.diff(code, axis=0) > 0.0).all()
    odd = single([[-2.0, 1e30, math.inf], [math.nan, 0.5, 0.5]])
    got = evaluate(f"transfers/{name}.glsl", "transfer", (odd,), {})
    assert got.tolist() == [[0.0, 1.0, 1.0], [1.0, 0.0, 1.0]]


@pytest.mark.parametrize("name", library().stable("tonemaps"))
def test_tonemap_hides_nothing(name: str) -> None:
    """What is NaN, infinite or negative is so after the curve."""
    odd = single(samples.ODD)
    for settings in variants(f"tonemaps/{name}.glsl"):
        got = evaluate(f"tonemaps/{name}.glsl", "tonemap", (odd,), settings)
        for test in (np.isnan, np.isinf, lambda x: x < 0.0):
            assert (test(got) == test(odd)).all()


def test_reinhard_reaches_white_at_l_white() -> None:
    path = "tonemaps/reinhard_extended.glsl"
    for white in (0.5, 1.0, 4.0):
        grey = single([[white] * 3])
        got = evaluate(path, "tonemap", (grey,), {"L_white": white})
        assert got == pytest.approx(1.0, rel=1e-6)
    same = evaluate(path, "tonemap", (single([[0.2, 3.0, 9.0]]),), {"L_white": 1.0})
    assert same == pytest.approx(np.array([[0.2, 3.0, 9.0]]), rel=1e-6)


def test_invalid_view_is_loud() -> None:
    odd = single(samples.ODD)
    want = display.invalid_view(odd.astype(np.float64))
    got = evaluate("views/invalid.glsl", "view", (odd,), {})
    assert np.abs(got - want).max() < 1e-6
    for tonemap, transfer in itertools.product(*map(library().stable, ("tonemaps", "transfers"))):
        settings = {"tonemap": tonemap, "transfer": transfer}
        got = evaluate("views/final.glsl", "view", (odd,), settings)
        assert (got[np.isnan(odd).any(axis=1)] == [1.0, 0.0, 1.0]).all()


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
    ("attenuations/inverse_square.glsl", "1.0 / (d * d)", "1.0 / d"),
    ("attenuations/polynomial.glsl", "distance * light.c2", "light.c2"),
    ("ambients/constant.glsl", " * u_ambient_level", ""),
    ("tonemaps/reinhard.glsl", "1.0 + Y", "1.0 + radiance"),
    ("tonemaps/reinhard_extended.glsl", "u_L_white * u_L_white", "u_L_white"),
    ("transfers/gamma.glsl", "1.0 / u_gamma", "u_gamma"),
    ("transfers/srgb.glsl", "12.92", "12.29"),
    ("transfers/srgb_pow.glsl", "1.0 / 2.4", "1.0 / 2.2"),
    ("views/final.glsl", "exp2(u_exposure)", "(1.0 + u_exposure)"),
]


@pytest.mark.parametrize(("path", "old", "new"), MUTATIONS)
def test_a_broken_shader_is_noticed(path: str, old: str, new: str, tmp_path: Path) -> None:
    text = (SHADERS / path).read_text()
    assert text.count(old) >= 1
    shaders = copy_of_shaders(tmp_path, {path: text.replace(old, new)})
    meta, function = library().files[path].meta, contract(path)[0]
    arguments = samples.interior(path.split("/")[0], meta)
    worst = max(error(path, function, arguments, s, shaders=shaders).max() for s in variants(path))
    assert worst > 10.0 * INTERIOR
