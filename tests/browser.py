"""A served playground and headless Chromium on both ANGLE backends, for the browser tests."""

import base64
import contextlib
import shutil
import socket
import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import uvicorn
from fastapi import FastAPI
from numpy.typing import NDArray
from playwright.sync_api import Browser, Page, Playwright, sync_playwright

from lightbench.api import create_app
from lightbench.paths import web_folder

# How long a test waits for what a page is to show.
PATIENCE_MS = 20_000
COMMON = [
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
]
BACKENDS = {
    "llvmpipe": ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"],
    "swiftshader": ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
}


def chromium() -> str:
    """The system's Chromium; skips the test where there is none."""
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            return path
    pytest.skip("no Chromium on this machine")


@contextlib.contextmanager
def serving(app: FastAPI | None = None) -> Iterator[str]:
    """The address of the app (the service itself), served by a thread of this process."""
    if not (web_folder() / "index.html").is_file():
        pytest.skip("the playground is not built")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    config = uvicorn.Config(app or create_app(), host="127.0.0.1", port=port, log_level="warning")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    while not server.started:
        time.sleep(0.02)
    yield f"http://127.0.0.1:{port}"
    server.should_exit = True
    thread.join()


@contextlib.contextmanager
def browsing(backend: str) -> Iterator[Browser]:
    """Headless Chromium whose WebGL2 runs on `backend`."""
    with sync_playwright() as playwright, launched(playwright, backend) as browser:
        yield browser


@contextlib.contextmanager
def launched(playwright: Playwright, backend: str) -> Iterator[Browser]:
    """One of several browsers at a time."""
    arguments = [*COMMON, *BACKENDS[backend]]
    browser = playwright.chromium.launch(executable_path=chromium(), args=arguments)
    yield browser
    browser.close()


RENDER = """async ([scene, settings, size, attachment]) => {
  const image = await window.lightbench.render(scene, settings, size, attachment);
  const text = (array) => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    let binary = '';
    for (let at = 0; at < bytes.length; at += 32768)
      binary += String.fromCharCode(...bytes.subarray(at, at + 32768));
    return btoa(binary);
  };
  const { size: own, renderer } = image;
  return { linear: text(image.linear), display: text(image.display), size: own, renderer };
}"""


def render_in(
    page: Page,
    scene: str,
    settings: dict[str, Any],
    size: tuple[int, int],
    attachment: str = "linear",
) -> tuple[NDArray[np.float32], NDArray[np.uint8], str]:
    """(linear, display, renderer) of a picture rendered by the page, as `lb.render` gives them."""
    answer = page.evaluate(RENDER, [scene, settings, list(size), attachment])
    width, height = answer["size"]
    linear = np.frombuffer(base64.b64decode(answer["linear"]), np.float32)
    linear = linear.reshape(height, width, 4)
    display = np.frombuffer(base64.b64decode(answer["display"]), np.uint8)
    display = display.reshape(size[1], size[0], 4)
    return linear[..., :3], display[..., :3], answer["renderer"]
