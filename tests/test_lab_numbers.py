"""The numbers that the lab's script works out, as printed, in float64."""

import math

import numpy as np
import pytest

from lightbench.exact.directions import Array, dot, unit
from lightbench.exact.display import gamma_code
from tests.lab.display import lab_white, truncated
from tests.lab.geometry import intersect, matrix, normals, pixels, reflected, through
from tests.lab.tables import ASKEW, FRONT, SCENES, Camera, Sphere, Triangle

# The script turned degrees into radians with this value for the matrices that it prints.
PRINTED_PI = 3.14
GAMMA = 2.2
PATCHES = np.array([0.0, 0.25, 0.5, 0.75, 1.0])


def row(*values: float) -> Array:
    return np.array([values], float)


def degrees(a: Array, b: Array) -> float:
    return math.degrees(math.acos(float(np.clip(dot(unit(a), unit(b)), -1.0, 1.0)[0])))


# The camera


def test_matrix_of_the_first_camera() -> None:
    expected = np.array([[-1, 0, 250], [0, -1, 200], [0, 0, -536.436]])
    np.testing.assert_allclose(matrix(FRONT, pi=PRINTED_PI), expected, rtol=0, atol=5e-4)
    assert matrix(FRONT)[2, 2] == pytest.approx(-536.127, abs=5e-4)


def test_matrix_of_the_second_camera() -> None:
    """o is a difference of lengths near 190, which the script took in float32."""
    u_v = [[-0.928477, 0.129302], [0, -0.937437], [0.371391, 0.323254]]
    printed, exact = matrix(ASKEW, pi=PRINTED_PI), matrix(ASKEW)
    for projection in (printed, exact):
        np.testing.assert_allclose(projection[:, :2], u_v, rtol=0, atol=5.1e-7)
    for o, expected in (
        (printed[:, 2], [19.4956, 0.724167, -624.406]),
        (exact[:, 2], [19.6035, 0.832004, -624.137]),
    ):
        np.testing.assert_allclose(o, expected, rtol=1e-6, atol=3e-5)


@pytest.mark.parametrize(
    ("at", "expected"),
    [
        ((249.5, 199.5), (0.0, 0.0, -1.0)),
        ((0.5, 0.5), (0.40, 0.32, -0.86)),
        ((249.5, 0.5), (0.0, 0.35, -0.94)),
        ((0.5, 199.5), (0.42, 0.0, -0.91)),
        ((499.5, 399.5), (-0.40, -0.32, -0.86)),
    ],
)
def test_directions(at: tuple[float, float], expected: tuple[float, float, float]) -> None:
    direction = through(matrix(FRONT), *at)
    np.testing.assert_allclose(direction, expected, rtol=0, atol=5.1e-3)
    assert np.linalg.norm(direction) == pytest.approx(1.0, rel=1e-15)


def test_the_middle_pixel_is_half_a_pixel_off_the_axis() -> None:
    """The two zeros that the script prints are rounded."""
    x, y, z = through(matrix(FRONT), 249.5, 199.5)
    assert x == y == pytest.approx(0.5 / 536.127, rel=1e-5)
    assert z == pytest.approx(-1.0, abs=1e-6)
    np.testing.assert_array_equal(through(matrix(FRONT), 250.0, 200.0), [0.0, 0.0, -1.0])


def test_the_three_gradients() -> None:
    """x falls to the right, y downwards, z is not the same everywhere."""
    direction = pixels(FRONT, matrix(FRONT)).reshape(FRONT.height, FRONT.width, 3)
    assert (np.diff(direction[..., 0], axis=1) < 0.0).all()
    assert (np.diff(direction[..., 1], axis=0) < 0.0).all()
    assert direction[..., 2].min() == pytest.approx(-1.0, abs=1e-6)
    assert direction[..., 2].max() == pytest.approx(-0.859, abs=5e-4)


@pytest.mark.parametrize("camera", [FRONT, ASKEW])
def test_fov_is_that_of_the_width(camera: Camera) -> None:
    projection = matrix(camera)
    across = [through(projection, x, camera.height / 2)[None] for x in (0.0, camera.width)]
    assert degrees(*across) == pytest.approx(camera.fov, rel=1e-12)
    down = [through(projection, camera.width / 2, y)[None] for y in (0.0, camera.height)]
    assert degrees(*down) == pytest.approx(
        math.degrees(2 * math.atan(0.8 * math.tan(math.radians(25.0)))), rel=1e-12
    )


# Hits


def test_hit_of_the_sphere() -> None:
    """The printed distance counts in lengths of a direction that is not unit."""
    sphere, eye, direction = Sphere((0, 0, 0), 5.0), row(0, 0, 10), row(0.3, 0.3, -1)
    (printed,) = intersect(eye, direction, sphere)
    (exact,) = intersect(eye, unit(direction), sphere)
    assert printed == pytest.approx((20.0 - math.sqrt(46.0)) / 2.36, rel=1e-14)
    assert printed == pytest.approx(5.6007, abs=5e-5)
    assert exact == pytest.approx(6.0839, abs=5e-5)
    assert exact == pytest.approx(printed * math.sqrt(1.18), rel=1e-14)


def test_reflected_ray() -> None:
    incoming, n = row(0.5, 0.5, 0.0), row(0.0, 1.0, 0.0)
    outgoing = reflected(incoming, n)
    np.testing.assert_allclose(outgoing, row(0.71, -0.71, 0.0), rtol=0, atol=5e-3)
    np.testing.assert_allclose(outgoing, row(math.sqrt(0.5), -math.sqrt(0.5), 0.0), rtol=1e-15)
    assert degrees(outgoing, n) == pytest.approx(180.0 - degrees(incoming, n))


# Normals


def test_the_wall_is_one_plane_that_faces_the_camera() -> None:
    halves = [o for o in SCENES["shadows"].objects if isinstance(o, Triangle)]
    first, second = (normals(half, row(*half.v0)) for half in halves)
    np.testing.assert_array_equal(first, row(0.0, 0.0, 1.0))
    assert degrees(first, second) == 0.0


def test_normal_of_the_slanting_triangle() -> None:
    (triangle,) = SCENES["triangle-intersection"].objects
    n = normals(triangle, row(0, 0, 0))
    np.testing.assert_allclose(n, row(-5, 2, 6) / math.sqrt(65.0), rtol=1e-15)
    assert degrees(n, row(0, 0, 1)) == pytest.approx(41.909, abs=5e-4)


def test_normals_of_a_sphere_open_like_its_points() -> None:
    """Their angle is that of an arc of the same length: chord = 2 r sin(angle / 2)."""
    sphere = Sphere((-2.5, 1.3, -3.0), 2.0)
    a = row(*sphere.center) + row(2.0, 0.0, 0.0)
    b = row(*sphere.center) + 2.0 * row(math.cos(1.0), math.sin(1.0), 0.0)
    assert degrees(normals(sphere, a), normals(sphere, b)) == pytest.approx(math.degrees(1.0))
    assert np.linalg.norm(a - b) == pytest.approx(4.0 * math.sin(0.5))


# Display


def test_codes_of_the_patches() -> None:
    assert truncated(PATCHES).tolist() == [0, 63, 127, 191, 255]
    assert truncated(gamma_code(PATCHES, GAMMA)).tolist() == [0, 135, 186, 223, 255]


def test_truncation_loses_half_a_code() -> None:
    ramp = (np.arange(1 << 16) + 0.5) / (1 << 16)
    assert float(np.mean(truncated(ramp) - 255.0 * ramp)) == pytest.approx(-0.5, abs=1e-3)


def test_gamma_belongs_before_the_8_bits() -> None:
    ramp = np.linspace(0.0, 1.0, 1 << 20)
    assert len(np.unique(truncated(gamma_code(ramp, GAMMA)))) == 256
    after = truncated(gamma_code(truncated(ramp) / 255.0, GAMMA))
    assert len(np.unique(after)) == 184


def test_a_display_undoes_the_gamma() -> None:
    """Its measured curve y = x^g gives g back, and encoded patches come out as they were."""
    measured = PATCHES**GAMMA
    lit = PATCHES > 0.0
    g = np.polynomial.Polynomial.fit(np.log(PATCHES[lit]), np.log(measured[lit]), 1).convert()
    assert g.coef[1] == pytest.approx(GAMMA, rel=1e-12)
    np.testing.assert_allclose(gamma_code(PATCHES, GAMMA) ** GAMMA, PATCHES, rtol=1e-14)


def test_one_channel_above_1_turns_the_pixel_white() -> None:
    pixels_in = np.array([[1.0, 0.0, 0.5], [1.0 + 1e-12, 0.0, 0.5], [0.0, 0.0, 2.0]])
    np.testing.assert_array_equal(lab_white(pixels_in), [[1.0, 0.0, 0.5], [1] * 3, [1] * 3])
