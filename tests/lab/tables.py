"""The scenes of the ray-tracing lab as plain data, number for number as its tables 1.1-1.10 have
them. Positions are in scene units, colours linear RGB, fov in degrees and horizontal.

Two scenes come before there is light: every hit has one flat colour there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

Triple = tuple[float, float, float]
BLACK: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Camera:
    """Where the eye is, what it looks at, which way is up; the picture's size in pixels."""

    eye: Triple
    look_at: Triple = (0.0, 0.0, 0.0)
    up: Triple = (0.0, 1.0, 0.0)
    fov: float = 50.0
    width: int = 500
    height: int = 400


@dataclass(frozen=True)
class Light:
    """A point that shines alike in all directions, with no falloff."""

    position: Triple
    color: Triple


@dataclass(frozen=True)
class Material:
    """What a surface does with light. No table names a transmittance: it is 0."""

    ambient: Triple = BLACK
    diffuse: Triple = BLACK
    specular: Triple = BLACK
    shininess: float = 0.0
    reflectance: float = 0.0
    transmittance: float = 0.0
    textured: bool = False


@dataclass(frozen=True)
class Sphere:
    center: Triple
    radius: float
    material: Material = Material()


@dataclass(frozen=True)
class Triangle:
    """Its normal is that of (v1 - v0) x (v2 - v0)."""

    v0: Triple
    v1: Triple
    v2: Triple
    material: Material = Material()


Shape = Sphere | Triangle


@dataclass(frozen=True)
class Scene:
    """A camera's view; `flat` is the colour of every hit where nothing is lit."""

    camera: Camera
    objects: tuple[Shape, ...]
    lights: tuple[Light, ...] = ()
    background: Triple = BLACK
    flat: Triple | None = None


FRONT = Camera(eye=(0.0, 0.0, 10.0))
BELOW = Camera(eye=(0.0, -4.0, 10.0))
ASKEW = Camera(eye=(2.0, 5.0, 10.0), look_at=(-2.0, 1.0, 0.0))  # of the matrix (1.15) only
KEY = Light((-3.0, -2.0, 8.0), (0.6, 0.6, 0.6))
FILL = Light((5.0, -2.0, 8.0), (0.3, 0.3, 0.3))
FLAT: Triple = (0.0, 0.5, 0.0)
GLOSS: Triple = (0.7, 0.7, 0.7)

RED = Material(ambient=(0.1, 0, 0), diffuse=(0.6, 0, 0), specular=GLOSS, shininess=30)
GREEN = Material(ambient=(0, 0.1, 0), diffuse=(0, 0.6, 0), specular=GLOSS, shininess=30)
BLUE = Material(ambient=(0, 0, 0.1), diffuse=(0, 0, 0.6), specular=GLOSS, shininess=30)
GREY = Material(ambient=(0.1, 0.1, 0.1), diffuse=(0.4, 0.4, 0.4))
MIRROR = replace(GREY, reflectance=1)


def _ball(material: Material) -> Sphere:
    return Sphere((0, 0, 0), 1.6, material)


def _wall(material: Material) -> tuple[Shape, Shape]:
    """A square of side 10 at z = -5 that faces +z."""
    return (
        Triangle((5, 5, -5), (-5, 5, -5), (-5, -5, -5), material),
        Triangle((5, 5, -5), (-5, -5, -5), (5, -5, -5), material),
    )


def _lit(material: Material) -> Scene:
    return Scene(FRONT, (_ball(material),), (KEY,))


BALLS = (Sphere((-1, 0, 3), 0.4, GREEN), _ball(RED), Sphere((-3, -2, -2), 0.6, BLUE))

# By the name in the table's caption; the script names no scene for the other two shininesses.
SCENES: dict[str, Scene] = {
    "sphere-intersection": Scene(
        FRONT, (Sphere((-2.5, 1.3, -3), 1.0), Sphere((0, 0, 0), 1.6)), flat=FLAT
    ),
    "triangle-intersection": Scene(
        FRONT, (Triangle((3, 3, -5), (-3, 3, -10), (-3, -3, -8)),), flat=FLAT
    ),
    "illumination-ambient": _lit(Material(ambient=(0.5, 0, 0), shininess=30)),
    "illumination-diffuse": _lit(Material(diffuse=(0.7, 0, 0), shininess=0)),
    "illumination-specular": _lit(Material(specular=GLOSS, shininess=30)),
    "illumination": _lit(RED),
    "illumination-shininess10": _lit(replace(RED, shininess=10)),
    "illumination-shininess50": _lit(replace(RED, shininess=50)),
    "texture": _lit(replace(RED, textured=True)),
    "shadows": Scene(FRONT, (*BALLS, *_wall(GREY)), (KEY,)),
    "reflectance": Scene(BELOW, (_ball(RED), *_wall(MIRROR)), (KEY,)),
    "reflectance2": Scene(BELOW, (*BALLS, *_wall(MIRROR)), (KEY, FILL)),
}
