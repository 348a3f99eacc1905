"""Golden pictures: compare a picture with the stored one, or store it anew."""

import hashlib
import io
import re
import shlex
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image as Pillow

from lightbench.compare import Difference, Picture, check, code_difference, compare
from lightbench.errors import LightbenchError
from lightbench.golden_report import Record, pictures
from lightbench.image import Image, write_whole
from lightbench.render import on_gl_thread, renderer

__all__ = ["Golden", "safe_name"]

LONGEST_NAME = 120
# The limit of linear pictures where none is given: off by a thousandth, root mean square.
LINEAR_RELMSE = 1e-6
SAME = Difference(0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass
class Golden:
    """The golden pictures of one test, in `folder`; call it with a picture to compare.

    `update` stores instead of comparing. `show_all` keeps the pictures of comparisons that pass
    too. `from_gl` says that arrays come from this process's renderer, so that the report names it.
    What was compared is appended to `records`.
    """

    folder: Path
    test: str
    default_name: str
    update: bool = False
    show_all: bool = False
    from_gl: bool = False
    records: list[Record] = field(default_factory=list, repr=False)

    def __call__(
        self,
        picture: Image | Picture,
        name: str | None = None,
        *,
        tolerance: int = 1,
        max_share: float = 0.0,
        relmse: float | None = None,
        flip_mean: float | None = None,
        flip_p99: float | None = None,
    ) -> None:
        """Fail unless `picture` is the golden one within the limits.

        `picture` is an Image (its display codes count), uint8 codes (H, W, 3), kept as PNG, or
        linear floats (H, W, 3), kept as float32 NPY. `name` is the file's, without its ending;
        by default it is the test's.

        A pixel may differ by `tolerance` 8-bit codes, and a share `max_share` (0 to 1) of all
        pixels by more. `relmse` limits mean((I-R)^2 / (R^2 + 1e-3)) of the linear values, by
        default to 1e-6 for linear floats and not at all for codes. `flip_mean` and `flip_p99`
        limit FLIP.

        Raises AssertionError where the golden is missing or differs, LightbenchError for a
        picture that cannot be compared and for a name that this test has used.
        """
        __tracebackhide__ = True
        actual = _array(picture)
        if relmse is None and actual.dtype != np.uint8:
            relmse = LINEAR_RELMSE
        limits = {
            over(tolerance): max_share,
            "relMSE": relmse,
            "FLIP mean": flip_mean,
            "FLIP p99": flip_p99,
        }
        record = self._record(name, actual)
        if isinstance(picture, Image):
            record["renderer"] = picture.renderer
        elif self.from_gl:
            record["renderer"] = on_gl_thread(lambda: renderer().name)
        if self.update:
            _store(actual, record)
        else:
            self._compare(actual, record, tolerance, limits)
        if record["status"] in ("failed", "missing"):
            raise AssertionError(record["message"])

    def _record(self, name: str | None, actual: Picture) -> Record:
        if name is not None and name != safe_name(name):
            raise LightbenchError(f"golden name {name!r}: letters, digits and . _ - only")
        ending = ".png" if actual.dtype == np.uint8 else ".npy"
        path = self.folder / f"{name or self.default_name}{ending}"
        if str(path) in {record["path"] for record in self.records}:
            raise LightbenchError(f"this test has compared {path.name} before: name each picture")
        record: Record = {
            "test": self.test, "path": str(path), "status": "passed", "message": "",
            "renderer": "", "metrics": {}, "limits": {}, "pictures": {},
        }  # fmt: skip
        self.records.append(record)
        return record

    def _compare(
        self, actual: Picture, record: Record, tolerance: int, limits: dict[str, float | None]
    ) -> None:
        """Fill in the record; `status` says whether all limits hold."""
        path = Path(record["path"])
        accept = f"pytest --update-goldens {shlex.quote(self.test)}"
        if not path.is_file():
            record["status"] = "missing"
            record["message"] = (
                f"no golden {path}; look at the picture, then keep it with: {accept}"
            )
            record["pictures"] = pictures(actual, None)
            return
        expected = _read(path)
        problems = [_size_problem(actual, expected)]
        if actual.shape == expected.shape:
            record["metrics"] = _metrics(actual, expected, tolerance)
            record["limits"] = {name: x for name, x in limits.items() if x is not None}
            problems = _excesses(record["metrics"], record["limits"])
        if problems:
            record["status"] = "failed"
            record["message"] = (
                f"{path.name}: {'; '.join(problems)}\n"
                f"Look at both pictures in the golden report; to keep the new one: {accept}"
            )
        if problems or self.show_all:
            record["pictures"] = pictures(actual, expected)


def _array(picture: Image | Picture) -> Picture:
    array = np.asarray(picture.display if isinstance(picture, Image) else picture)
    if array.dtype.kind == "f":
        array = array.astype(np.float32)
    check(array)
    return array


def _size_problem(actual: Picture, expected: Picture) -> str:
    sizes = [f"{p.shape[1]}x{p.shape[0]}" for p in (actual, expected)]
    return f"the picture is {sizes[0]} pixels, the golden {sizes[1]}"


def over(tolerance: int) -> str:
    """The metric's name: share of pixels that differ by more than `tolerance` codes."""
    return f"share of pixels over {tolerance} code{'s' * (tolerance != 1)}"


def _metrics(actual: Picture, expected: Picture, tolerance: int) -> dict[str, float]:
    if np.array_equal(actual, expected):
        difference, share = SAME, 0.0
    else:
        difference = compare(actual, expected)
        share = float((code_difference(actual, expected) > tolerance).mean())
    return {
        "largest difference in 8-bit codes": difference.largest,
        over(1): difference.share_above_one,
        over(tolerance): share,
        "RMSE": difference.rmse,
        "relMSE": difference.relmse,
        "largest linear difference": difference.largest_linear,
        "FLIP mean": difference.flip_mean,
        "FLIP p99": difference.flip_p99,
        "FLIP max": difference.flip_max,
    }


def _excesses(metrics: dict[str, float], limits: dict[str, float]) -> list[str]:
    """What is beyond its limit, led by the largest difference."""
    found = [f"{n} is {metrics[n]:.3g}, limit {x:g}" for n, x in limits.items() if metrics[n] > x]
    name, largest = next(iter(metrics.items()))
    return [f"{name} is {largest:g}", *found] if found else []


def _read(path: Path) -> Picture:
    try:
        if path.suffix == ".npy":
            array: Picture = np.load(path, allow_pickle=False)
            check(array)
            return array
        with Pillow.open(path) as file:
            return np.asarray(file.convert("RGB"))
    except (OSError, ValueError, LightbenchError) as error:
        raise LightbenchError(f"golden {path} cannot be read: {error}") from None


def _store(actual: Picture, record: Record) -> None:
    """Write the golden whole, unless it holds these very values already."""
    path = Path(record["path"])
    if path.is_file() and np.array_equal(_read(path), actual):
        return
    buffer = io.BytesIO()
    if path.suffix == ".npy":
        np.save(buffer, actual)
    else:
        Pillow.fromarray(actual).save(buffer, "PNG", optimize=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, buffer.getvalue())
    record["status"] = "written"


def safe_name(text: str) -> str:
    """`text` as a file's name on any system: letters, digits, `.`, `_` and `-`.

    A text that loses something on the way ends in a hash of what it was.
    """
    plain = text.replace("[", ".").removesuffix("]")
    safe = re.sub(r"[^A-Za-z0-9._-]+", "-", plain).strip(".-")[:LONGEST_NAME]
    if safe == plain:
        return safe
    return f"{safe}-{hashlib.sha256(text.encode()).hexdigest()[:8]}"
