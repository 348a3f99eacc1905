"""The one exception tree: what a caller can cause, saying what was wrong and what is allowed."""

__all__ = [
    "GraphicsError",
    "LightbenchError",
    "ModelError",
    "NotFoundError",
    "SceneError",
    "SettingError",
    "ShaderError",
    "shown",
]


class LightbenchError(Exception):
    """Anything that Lightbench refuses; the message is one sentence for a person."""


class ShaderError(LightbenchError):
    """A shader file that cannot be used; the message begins with `file:line`."""


class SceneError(LightbenchError):
    """A scene that cannot be used; the message names the offending field."""


class ModelError(LightbenchError):
    """A model file that cannot be used; the message names the file and the place in it."""


class SettingError(LightbenchError):
    """A setting with an unknown name or a value outside what is allowed."""


class NotFoundError(LightbenchError):
    """A name that no scene, file or function has."""


class GraphicsError(LightbenchError):
    """No OpenGL context, or one that cannot do what a plan asks for."""


def shown(value: object) -> str:
    """`value` as a message shows it: a whole float without its ".0", as a person types it."""
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(shown, value))}]"
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e16:
        return str(int(value))
    return repr(value)
