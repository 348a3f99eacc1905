"""What a picture or a light's map is seen from: the camera, or the faces of a light.

A light's map is square, of one face for a directional or a spot light, of the six faces of a cube
for a point light (and for a spot too wide for one). Nothing of it depends on the camera.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from lightbench import matrix
from lightbench.bounds import bounding_sphere, distance, farthest, fit
from lightbench.scene import Camera, Object, Scene
from lightbench.scene_lights import DirectionalLight, Light, SpotLight

__all__ = [
    "LightMap", "Viewpoint", "camera_viewpoint", "casters", "in_sight", "light_camera", "light_map",
    "primary_rays",
]  # fmt: skip

Vector = Sequence[float]

# Nearest depth kept, as a share of the farthest: 24 bits then resolve 6e-5 of the far distance.
NEAREST = 1e-3
# Room around what is fitted, so that nothing lies on the border.
MARGIN = 1.01
# Half angle in degrees from which a spot light's map is a cube.
WIDEST_SPOT = 75.0
# Where the faces of a cube look and which way is up on them: +x -x +y -y +z -z.
FACES: list[tuple[Vector, Vector]] = [
    ((1, 0, 0), (0, 1, 0)),
    ((-1, 0, 0), (0, 1, 0)),
    ((0, 1, 0), (0, 0, -1)),
    ((0, -1, 0), (0, 0, 1)),
    ((0, 0, 1), (0, 1, 0)),
    ((0, 0, -1), (0, 1, 0)),
]


@dataclass(frozen=True)
class Viewpoint:
    """`matrix`: from the world about `origin` to clip space. `tile`: x, y and side in pixels.

    `focal` is in pixels: of a thing's size over its distance, or (orthographic) of a metre.
    """

    origin: Vector
    matrix: list[float]
    focal: float
    orthographic: bool = False
    tile: list[int] | None = None
    look: Vector = (0, 0, 0)
    tangent: float = 0.0


@dataclass(frozen=True)
class LightMap:
    """The map of a light: `tiles` across and down, and what its users need to read it.

    `texel` is the size of one, in metres at 1 m distance (directional: at any). `to_clip` takes the
    world about `origin` to the map's clip space; a cube has none. `axis` is where the map looks.
    """

    tiles: tuple[int, int]
    origin: Vector
    far: float
    texel: float
    axis: Vector
    to_clip: list[float] | None
    faces: list[Viewpoint]


def casters(scene: Scene) -> list[Object]:
    """The objects that can throw a shadow: a blended one lets light through."""
    return [o for o in scene.objects.values() if scene.materials[o.material].alpha_mode != "blend"]


def camera_viewpoint(scene: Scene, size: Sequence[int]) -> Viewpoint:
    """World directions about the eye to clip space; depth spans what there is to see."""
    camera, aspect = scene.camera, size[0] / size[1]
    things = scene.objects.values()
    spans = [(distance(scene, o, camera.eye), bounding_sphere(scene, o)[1]) for o in things]
    far = max((d + r for d, r in spans), default=1.0) * MARGIN
    view = matrix.look_at(matrix.subtract(camera.target, camera.eye), camera.up)
    if camera.projection == "orthographic":
        projection = matrix.orthographic(camera.height, aspect, 0.0, far)
        focal = size[1] / camera.height
        return Viewpoint(camera.eye, matrix.multiply(projection, view), focal, orthographic=True)
    tangent = _tangent(camera, aspect)
    corner = math.sqrt(1 + tangent * tangent * (1 + aspect * aspect))
    near = max(min((d - r for d, r in spans), default=0.0) / corner * 0.99, far * NEAREST)
    projection = matrix.square_perspective(tangent, near, far)
    projection[0] = projection[0] / aspect
    if camera.mirrored:
        projection[0] = -projection[0]
    return Viewpoint(camera.eye, matrix.multiply(projection, view), size[1] / (2 * tangent))


def _tangent(camera: Camera, aspect: float) -> float:
    """Of half the angle that the picture's height takes."""
    tangent = math.tan(camera.fov * math.pi / 180 / 2)
    return tangent / aspect if camera.fov_of == "width" else tangent


def primary_rays(camera: Camera, size: Sequence[int]) -> dict[str, Vector]:
    """What the rays of a picture are made of: right and up to its border, forward."""
    aspect = size[0] / size[1]
    z = matrix.normalize(matrix.subtract(camera.eye, camera.target))
    x = matrix.normalize(matrix.cross(camera.up, z))
    y = matrix.cross(z, x)
    orthographic = camera.projection == "orthographic"
    half = camera.height / 2 if orthographic else _tangent(camera, aspect)
    across = -half * aspect if camera.mirrored else half * aspect
    return {
        "ray_right": [c * across for c in x],
        "ray_up": [c * half for c in y],
        "ray_forward": [-c for c in z],
    }


def light_map(scene: Scene, light: Light, side: int) -> LightMap:
    """The map of a light, each face of it `side` pixels wide."""
    if isinstance(light, DirectionalLight):
        return _parallel_map(scene, light, side)
    far = light.far or farthest(scene, casters(scene), light.position) * MARGIN
    if isinstance(light, SpotLight) and light.outer <= WIDEST_SPOT:
        return _cone_map(light, far, side)
    faces = [
        _face(light.position, look, up, 1.0, far, (index % 3 * side, index // 3 * side, side))
        for index, (look, up) in enumerate(FACES)
    ]
    return LightMap((3, 2), light.position, far, 2 / side, (0, 0, 0), None, faces)


def _face(
    origin: Vector, look: Vector, up: Vector, tangent: float, far: float, tile: tuple[int, int, int]
) -> Viewpoint:
    projection = matrix.square_perspective(tangent, far * NEAREST, far * MARGIN)
    whole = matrix.multiply(projection, matrix.look_at(look, up))
    focal = tile[2] / (2 * tangent)
    return Viewpoint(origin, whole, focal, tile=list(tile), look=look, tangent=tangent)


def _any_up(axis: Vector) -> Vector:
    return (0, 0, 1) if abs(axis[1]) > 0.9 else (0, 1, 0)


def _cone_map(light: SpotLight, far: float, side: int) -> LightMap:
    axis = matrix.normalize(light.direction)
    # The cone of light inside a square, with a texel of room.
    tangent = math.tan(max(light.outer, 0.1) * math.pi / 180) * side / (side - 2)
    face = _face(light.position, axis, _any_up(axis), tangent, far, (0, 0, side))
    return LightMap((1, 1), light.position, far, 2 * tangent / side, axis, face.matrix, [face])


def _parallel_frame(scene: Scene, light: DirectionalLight) -> tuple[Vector, Vector, float, float]:
    """(axis, middle of the near side, width, depth) of a box along the light about all casters."""
    axis = matrix.normalize(light.direction)
    right = matrix.normalize(matrix.cross(axis, _any_up(axis)))
    up = matrix.cross(right, axis)
    things = casters(scene)
    spans = [fit(scene, things, a) for a in (right, up, axis)]
    (x0, x1), (y0, y1), (z0, z1) = spans
    width = max(x1 - x0, y1 - y0, 1e-6) * MARGIN
    depth = max(z1 - z0, 1e-6)
    room = depth * (MARGIN - 1)
    x, y, z = (x0 + x1) / 2, (y0 + y1) / 2, z0 - room
    middle = [right[i] * x + up[i] * y + axis[i] * z for i in range(3)]
    return axis, middle, width, light.far or depth + 2 * room


def _parallel_map(scene: Scene, light: DirectionalLight, side: int) -> LightMap:
    axis, origin, width, depth = _parallel_frame(scene, light)
    width = width * side / (side - 2)
    projection = matrix.orthographic(width, 1.0, 0.0, depth)
    whole = matrix.multiply(projection, matrix.look_at(axis, _any_up(axis)))
    face = Viewpoint(origin, whole, side / width, orthographic=True, tile=[0, 0, side], look=axis)
    return LightMap((1, 1), origin, depth, width / side, axis, whole, [face])


def in_sight(scene: Scene, viewpoint: Viewpoint, thing: Object) -> bool:
    """Whether a face of a light's map may show an object."""
    if viewpoint.tangent == 0:
        return True
    center, radius = bounding_sphere(scene, thing)
    offset = matrix.subtract(center, viewpoint.origin)
    depth = matrix.dot(offset, viewpoint.look)
    across = math.sqrt(max(matrix.dot(offset, offset) - depth * depth, 0.0))
    # The cone about the square face; its corner is sqrt(2) from the middle.
    corner = viewpoint.tangent * math.sqrt(2)
    return across - corner * depth <= radius * math.sqrt(1 + corner * corner)


def light_camera(scene: Scene, light: Light) -> Camera:
    """The camera that stands where a light is and has all of its map in sight.

    A point light has no one direction: it looks at what the scene's camera looks at.
    """
    if isinstance(light, DirectionalLight):
        axis, origin, width, _ = _parallel_frame(scene, light)
        return _toward(origin, axis).model_copy(
            update={"projection": "orthographic", "height": width}
        )
    if isinstance(light, SpotLight):
        fov = min(max(2 * light.outer, 1.0), 170.0)
        return _toward(light.position, matrix.normalize(light.direction), fov)
    look = matrix.subtract(scene.camera.target, light.position)
    if matrix.dot(look, look) == 0:
        look = (0, -1, 0)
    return _toward(light.position, matrix.normalize(look), 90.0)


def _toward(eye: Vector, axis: Vector, fov: float = 45.0) -> Camera:
    target = [e + a for e, a in zip(eye, axis, strict=True)]
    return Camera(eye=tuple(eye), target=tuple(target), up=tuple(_any_up(axis)), fov=fov)
