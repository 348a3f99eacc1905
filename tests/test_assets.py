"""The asset store: one key a content, a budget for what need not be kept, safe in threads."""

import dataclasses
import struct
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from lightbench import assets
from lightbench.errors import NotFoundError
from lightbench.mesh import pack
from lightbench.shapes import mesh


@pytest.fixture
def budget(monkeypatch: pytest.MonkeyPatch) -> int:
    """An empty store that has room for 100 bytes of uploads."""
    monkeypatch.setattr(assets, "_assets", type(assets._assets)())
    monkeypatch.setattr(assets, "BUDGET", 100)
    return 100


def png(content: bytes, width: int = 3, height: int = 2) -> bytes:
    """24 bytes as a PNG's first, and the content."""
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", width, height) + content


def held(key: str) -> bool:
    try:
        assets.image(key)
    except NotFoundError:
        return False
    return True


def test_a_key_is_of_the_content(budget: int) -> None:
    first, again = (assets.add_image(png(b"one"), keep=True) for _ in range(2))
    assert first == again
    assert first.startswith("image-3x2-")
    assert len(first) == len("image-3x2-") + 32
    assert assets.add_image(png(b"two"), keep=True) != first
    assert assets.add_image(png(b"one", 640, 480), keep=True).startswith("image-640x480-")
    assert assets.image(first) == png(b"one")


def test_a_mesh_is_given_back(budget: int) -> None:
    made = mesh("cube")
    key = assets.add_mesh(made, keep=True)
    assert key.startswith("mesh-")
    assert assets.mesh(key) is made
    colored = dataclasses.replace(made, colors=np.ones((24, 4), np.float32))
    assert assets.add_mesh(colored, keep=True) != key
    assert pack(assets.mesh(key)) == pack(made)


@pytest.mark.parametrize("key", ["image-0", "", "mesh-0", "cube"])
def test_an_unknown_key_is_refused(key: str, budget: int) -> None:
    with pytest.raises(NotFoundError, match=repr(key)):
        assets.image(key)
    with pytest.raises(NotFoundError, match=repr(key)):
        assets.mesh(key)


def test_a_key_of_one_kind_is_none_of_the_other(budget: int) -> None:
    with pytest.raises(NotFoundError):
        assets.image(assets.add_mesh(mesh("plane"), keep=True))
    with pytest.raises(NotFoundError):
        assets.mesh(assets.add_image(png(b""), keep=True))


def test_the_oldest_upload_gives_way(budget: int) -> None:
    kept = assets.add_image(png(b"k" * 500), keep=True)
    first, second = (assets.add_image(png(bytes([i]) * 26), keep=False) for i in range(2))
    assert held(first)
    third = assets.add_image(png(b"3"), keep=False)
    assert [held(key) for key in (kept, first, second, third)] == [True, False, True, True]


def test_an_upload_seen_again_is_the_newest(budget: int) -> None:
    first, second = (assets.add_image(png(bytes([i]) * 26), keep=False) for i in range(2))
    assets.add_image(png(bytes([0]) * 26), keep=False)
    assets.add_image(png(b"3"), keep=False)
    assert [held(first), held(second)] == [True, False]


def test_what_is_kept_once_stays(budget: int) -> None:
    key = assets.add_image(png(b"a" * 36), keep=True)
    assets.add_image(png(b"a" * 36), keep=False)
    other = assets.add_image(png(b"b" * 36), keep=False)
    assert assets.add_image(png(b"b" * 36), keep=True) == other
    for i in range(10):
        assets.add_image(png(bytes([i]) * 36), keep=False)
    assert held(key)
    assert held(other)


def test_an_upload_above_the_budget_stands_alone(budget: int) -> None:
    small = assets.add_image(png(b"small"), keep=False)
    large = assets.add_image(png(b"l" * 200), keep=False)
    assert [held(small), held(large)] == [False, True]


def test_threads_do_not_disturb_each_other(budget: int) -> None:
    def work(number: int) -> bool:
        key = assets.add_image(png(b"%d" % (number % 7)), keep=bool(number % 2))
        return key.startswith("image-")

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(2000)))
    assert all(held(assets.add_image(png(b"%d" % i), keep=True)) for i in range(7))
