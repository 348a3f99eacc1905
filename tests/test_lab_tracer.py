"""The lab's float64 tracer against closed forms: the oracle is tested before it tests anything."""

import math
from dataclasses import replace

import numpy as np
import pytest

from lightbench.exact.directions import Array, column, dot, unit
from tests.lab.geometry import intersect, reflected
from tests.lab.tables import (
    BLUE,
    FRONT,
    KEY,
    MIRROR,
    RED,
    SCENES,
    Camera,
    Light,
    Material,
    Scene,
    Sphere,
    Triangle,
)
from tests.lab.tracer import AWAY, LIT, SCRIPT, SHADOWED, Bools, Reading, primary_rays, trace

WALL = SCENES["shadows"].objects[-2:]
WALL_Z = -5.0
WHITE = (1.0, 1.0, 1.0)
# One ray down the axis, and two more to each side.
PEEP = replace(FRONT, width=5, height=5, fov=1.0)


def directions(scene: Scene) -> Array:
    return primary_rays(scene).direction.reshape(scene.camera.height, scene.camera.width, 3)


def within_cone(from_point: Array, direction: Array, sphere: Sphere) -> Bools:
    """Rays less than asin(r / d) from a sphere's centre meet it."""
    towards = np.asarray(sphere.center) - from_point
    cos_angle = dot(unit(direction), unit(towards))
    distance = np.linalg.norm(towards, axis=-1)
    inside: Bools = cos_angle > np.sqrt(1.0 - (sphere.radius / distance) ** 2)
    return inside


def on_wall(scene: Scene) -> Array:
    """Where each pixel's ray meets the wall's plane, (H, W, 3)."""
    d, eye = directions(scene), np.asarray(scene.camera.eye)
    return np.asarray(eye + d * ((WALL_Z - eye[2]) / d[..., 2:]))


def centre(scene: Scene, reading: Reading = SCRIPT) -> Array:
    """The colour down the axis of PEEP."""
    color: Array = trace(replace(scene, camera=PEEP), reading).linear[2, 2]
    return color


# Every scene


@pytest.mark.parametrize("name", SCENES)
def test_light_is_finite_and_never_negative(name: str) -> None:
    linear = trace(SCENES[name]).linear
    assert linear.shape == (400, 500, 3)
    assert np.isfinite(linear).all()
    assert linear.min() == 0.0
    assert linear.max() > 0.2


# Outlines


def test_a_sphere_on_the_axis_is_a_disk() -> None:
    """Of radius f r / sqrt(d^2 - r^2) pixels."""
    scene = SCENES["illumination-ambient"]
    focal = 250.0 / math.tan(math.radians(25.0))
    radius = focal * 1.6 / math.sqrt(100.0 - 1.6**2)
    x, y = np.meshgrid(np.arange(500) - 249.5, np.arange(400) - 199.5)
    seen = trace(scene).ids.surface[0] == 0
    np.testing.assert_array_equal(seen, np.hypot(x, y) < radius)
    assert radius == pytest.approx(86.9, abs=0.05)


def test_spheres_hide_what_is_behind() -> None:
    scene = SCENES["shadows"]
    green, red, blue = (o for o in scene.objects if isinstance(o, Sphere))
    d, eye = directions(scene), np.asarray(scene.camera.eye)
    wall = (np.abs(on_wall(scene)[..., :2]) < 5.0).all(axis=-1)
    order = [within_cone(eye, d, ball) for ball in (green, red, blue)]
    expected = np.select([*order, wall], [0, 1, 2, 3], -1)
    np.testing.assert_array_equal(trace(scene).ids.surface[0], expected)


def test_a_triangle_is_its_projection() -> None:
    scene = SCENES["triangle-intersection"]
    (triangle,) = scene.objects
    assert isinstance(triangle, Triangle)
    eye = np.asarray(scene.camera.eye)
    corners = [np.subtract(v, eye) for v in (triangle.v0, triangle.v1, triangle.v2)]
    sides = [np.cross(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    signs = np.stack([directions(scene) @ side for side in sides])
    signs *= np.sign(np.linalg.det(corners))
    inside: Bools = np.all(signs > -1e-9, axis=0)
    assert (inside & (np.abs(signs) < 1e-9).any(axis=0)).sum() > 100  # right on its edge
    np.testing.assert_array_equal(trace(scene).linear, column(inside) * [0.0, 0.5, 0.0])


def test_two_triangles_leave_no_gap() -> None:
    """Pixel centres lie on the edge that the wall's halves share."""
    scene = replace(SCENES["shadows"], objects=WALL)
    x, y, _ = np.moveaxis(on_wall(scene), -1, 0)
    inside = (np.abs(x) < 5.0) & (np.abs(y) < 5.0)
    assert (np.abs(x - y)[inside] < 1e-12).sum() > 300
    np.testing.assert_array_equal(trace(scene).ids.surface[0] == 0, inside)


def test_edges_and_corners_are_inside() -> None:
    triangle = Triangle((0, 0, 0), (4, 0, 0), (0, 2, 0))
    on_it = np.array([[0, 0], [4, 0], [0, 2], [1, 0], [0, 1.5], [2, 1], [1, 0.5]])
    beside = np.array([[-0.001, 0], [4.001, 0], [0, 2.001], [1, -0.001], [2, 1.001]])
    for points, meets in ((on_it, True), (beside, False)):
        origin = np.column_stack([points, np.full(len(points), 3.0)])
        down = np.broadcast_to([0.0, 0.0, -1.0], origin.shape)
        for side in (1.0, -1.0):
            seen = intersect(origin * [1, 1, side], side * down, triangle)
            assert (np.isfinite(seen) == meets).all()
            assert not meets or np.allclose(seen, 3.0, rtol=1e-14)


def test_only_hits_in_front_count() -> None:
    ball = Sphere((0, 0, 0), 2.0)
    origin = np.array([[0.0, 0, 5], [0, 0, 1], [0, 0, -5], [0, 2.001, 5]])
    down = np.broadcast_to([0.0, 0.0, -1.0], origin.shape)
    assert intersect(origin, down, ball).tolist() == [3.0, 3.0, math.inf, math.inf]


# Light


def test_ambient_is_the_product_of_the_colours() -> None:
    scene = SCENES["illumination-ambient"]
    seen = trace(scene).ids.surface[0] == 0
    np.testing.assert_allclose(trace(scene).linear, column(seen) * [0.3, 0.0, 0.0], rtol=1e-15)


@pytest.mark.parametrize("shininess", [0.0, 10.0, 30.0])
def test_a_lamp_at_the_eye(shininess: float) -> None:
    """l = v = h: its cosine c is sqrt(1 - (d sin(angle at the eye) / r)^2), the light c and c^s."""
    ball = Sphere((0, 0, 0), 1.6, Material((0.1,) * 3, (0.6, 0, 0), (0.7,) * 3, shininess))
    lamp = Light((0.0, 0.0, 10.0), (0.5, 0.4, 0.3))
    scene = Scene(FRONT, (ball,), (lamp,))
    d = directions(scene)
    sine = 10.0 * np.hypot(d[..., 0], d[..., 1]) / 1.6
    seen = sine < 1.0
    c = np.sqrt(1.0 - np.where(seen, sine, 0.0) ** 2)
    lit = np.where(c > 1e-3, 1.0, 0.0)
    m = ball.material
    color = np.asarray(m.ambient) + column(lit * c) * np.asarray(m.diffuse)
    color = (color + column(lit * c**shininess) * np.asarray(m.specular)) * lamp.color
    np.testing.assert_allclose(trace(scene).linear, column(seen) * color, rtol=0, atol=1e-10)


def test_grazing_light_does_not_count() -> None:
    """Below a cosine of 0.001 a surface has its ambient part only."""
    for tilt, share in ((0.0009, 0.0), (0.0011, 1.0)):
        lamp = Light((math.sqrt(1e4 - (100 * tilt) ** 2), 0.0, WALL_Z + 100 * tilt), WHITE)
        color = centre(Scene(PEEP, WALL, (lamp,)))
        np.testing.assert_allclose(color, 0.1 + share * 0.4 * tilt, rtol=1e-9)


def test_lights_add_up() -> None:
    scene = SCENES["reflectance2"]
    key, fill = (trace(replace(scene, lights=(light,))).linear for light in scene.lights)
    np.testing.assert_allclose(trace(scene).linear, key + fill, rtol=0, atol=1e-15)


def test_a_triangle_lit_from_behind_has_ambient_light_only() -> None:
    """From either side: its normal is turned neither to the eye nor to the lamp."""
    back = replace(PEEP, eye=(0.0, 0.0, -20.0))
    lamp_behind, lamp_in_front = (Light((0.0, 0.0, z), WHITE) for z in (-15.0, 5.0))
    for camera in (PEEP, back):
        for lamp, color in ((lamp_behind, 0.1), (lamp_in_front, 0.5)):
            picture = trace(Scene(camera, WALL, (lamp,)))
            np.testing.assert_allclose(picture.linear[2, 2], color, rtol=1e-12)
    seen = Scene(back, WALL, (lamp_behind,))
    assert (trace(seen, Reading(two_sided=False)).linear == 0.0).all()
    turned = trace(seen, Reading(turn_normals=True)).linear[2, 2]
    np.testing.assert_allclose(turned, 0.5, rtol=1e-12)


@pytest.mark.parametrize("shininess", [0.0, 2.0])
def test_no_highlight_with_the_half_vector_below(shininess: float) -> None:
    """As on the back of a triangle whose front is lit."""
    shiny = Material(specular=WHITE, shininess=shininess)
    scene = Scene(PEEP, tuple(replace(o, material=shiny) for o in WALL), (Light((3, 0, 5), WHITE),))
    assert centre(scene).min() > 0.9
    back = replace(scene, camera=replace(PEEP, eye=(0.0, 0.0, -20.0)))
    assert (trace(back).linear == 0.0).all()


# Shadows


def test_a_shadow_ends_where_similar_triangles_say() -> None:
    """Of an edge x = e at height z = 2 below a lamp at height 8."""
    edge, lamp_x = 0.5, -3.0
    sheet = Triangle((edge, 90, 2), (edge, -90, 2), (-200, 0, 2), BLUE)
    scene = Scene(FRONT, (sheet, *WALL), (Light((lamp_x, 0.0, 8.0), WHITE),))
    end = lamp_x + (edge - lamp_x) * (8.0 - WALL_Z) / (8.0 - 2.0)
    picture = trace(scene)
    wall = picture.ids.surface[0] == 1
    standing = np.where(on_wall(scene)[..., 0] > end, LIT, SHADOWED)
    np.testing.assert_array_equal(picture.ids.lights[0][wall], standing[wall])
    assert 0.05 < (standing[wall] == LIT).mean() < 0.95
    np.testing.assert_allclose(picture.linear[wall & (standing == SHADOWED)], 0.1, rtol=1e-15)


def test_balls_throw_cones_of_shadow() -> None:
    scene = SCENES["shadows"]
    points, lamp = on_wall(scene), np.asarray(KEY.position)
    shaded = [within_cone(lamp, points - lamp, o) for o in scene.objects if isinstance(o, Sphere)]
    picture = trace(scene)
    wall = picture.ids.surface[0] == 3
    expected = np.where(np.logical_or.reduce(shaded), SHADOWED, LIT)
    np.testing.assert_array_equal(picture.ids.lights[0][wall], expected[wall])


def test_a_ball_behind_the_lamp_throws_no_shadow() -> None:
    lamp = Light((2.0, 0.0, 0.0), WHITE)
    ball = Sphere((4.0, 0.0, 5.0), 1.0, RED)
    alone, before = centre(Scene(PEEP, WALL, (lamp,))), Scene(PEEP, (*WALL, ball), (lamp,))
    np.testing.assert_array_equal(centre(before), alone)
    endless = centre(before, Reading(shadows_end_at_light=False))
    np.testing.assert_allclose(endless, 0.1, rtol=1e-15)


def test_a_ball_throws_no_shadow_on_its_lit_side() -> None:
    lights = trace(SCENES["illumination"]).ids.lights[0]
    assert not (lights == SHADOWED).any()
    assert (lights == LIT).any()
    assert (lights == AWAY).any()


# Mirrors


def test_a_mirror_shows_the_mirrored_world() -> None:
    """What the wall adds to its own colour is the picture of a ball and a lamp behind it."""
    scene = SCENES["reflectance"]
    behind = 2.0 * WALL_Z
    ball = Sphere((0.0, 0.0, behind), 1.6, RED)
    x, y, z = KEY.position
    mirrored = Scene(scene.camera, (ball,), (Light((x, y, behind - z), KEY.color),))
    whole, own = trace(scene), trace(scene, Reading(bounces=0))
    wall = whole.ids.surface[0] == 1
    difference = (whole.linear - own.linear)[wall]
    np.testing.assert_allclose(difference, trace(mirrored).linear[wall], rtol=0, atol=1e-12)
    assert (difference > 0.1).any()
    np.testing.assert_array_equal(whole.linear[~wall], own.linear[~wall])


@pytest.mark.parametrize("bounces", [0, 1, 3, 6, 20])
def test_facing_mirrors_are_a_geometric_series(bounces: int) -> None:
    """Ambient light a and reflectance 1/2: a (1 + 1/2 + ...), ended by the energy 2^-7 < 0.01."""
    half = replace(MIRROR, reflectance=0.5)
    front = [replace(o, material=half) for o in WALL]
    back = [Triangle((90, -90, 11), (-90, -90, 11), (0, 90, 11), half)]
    lamp = Light((0.0, 0.0, 50.0), WHITE)
    scene = Scene(PEEP, (*front, *back), (lamp,))
    color = centre(scene, Reading(bounces=bounces))
    terms = min(bounces, 7) + 1
    np.testing.assert_allclose(color, 0.1 * (2.0 - 2.0 ** (1 - terms)), rtol=1e-14)


def test_a_mirror_that_meets_nothing_adds_nothing() -> None:
    scene = Scene(PEEP, SCENES["reflectance"].objects[-2:], (KEY,), background=WHITE)
    np.testing.assert_array_equal(centre(scene), centre(scene, Reading(bounces=0)))
    empty = trace(replace(scene, objects=(Sphere((0, 0, 99), 1.0),)))
    np.testing.assert_array_equal(empty.linear, 1.0)


def test_reflections_keep_their_angle() -> None:
    rng = np.random.default_rng(5)
    d, n = unit(rng.normal(size=(99, 3))), unit(rng.normal(size=(99, 3)))
    r = reflected(d, n)
    np.testing.assert_allclose(dot(r, n), -dot(d, n), rtol=0, atol=1e-15)
    np.testing.assert_allclose(np.linalg.det(np.stack([d, n, r], axis=1)), 0.0, atol=1e-15)


def test_a_smaller_camera_sees_the_same() -> None:
    """The picture's size changes its pixels, not the view."""
    small: Camera = replace(FRONT, width=50, height=40)
    coarse = trace(replace(SCENES["shadows"], camera=small)).ids.surface[0]
    fine = trace(SCENES["shadows"]).ids.surface[0]
    blocks = fine.reshape(40, 10, 50, 10).transpose(0, 2, 1, 3).reshape(40, 50, 100)
    assert (blocks == coarse[..., None]).any(axis=-1).all()
