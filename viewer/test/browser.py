# SPDX-License-Identifier: GPL-3.0-or-later
"""What a test asks of a browser without a window, chromium (chromium.py) or firefox (firefox.py); and pictures
from it."""
import base64
import json
import struct
import tempfile
import zlib

SECONDS = 60  # that an answer may take, on a machine that is busy


class BrowserError(Exception):
    pass


class Browser:
    """One page at a time. `problems` collects its errors and its requests that are not for the file itself.
    Use it as a context manager.

    A browser of a kind has `executable()`, the path of its program or None, and in place of the methods
    that raise NotImplementedError here its own."""

    needs_card = False  # for WebGL

    def __init__(self, width, height, media):
        self.folder = tempfile.TemporaryDirectory(prefix="kinetri-viewer-", ignore_cleanup_errors=True)
        self.start()
        try:
            self.begin_page(width, height, media)
        except Exception:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self):
        raise NotImplementedError

    def close(self):
        raise NotImplementedError

    def begin_page(self, width, height, media=()):
        """An empty page that knows nothing of the one before, which is closed: sizes and features are of
        its own."""
        raise NotImplementedError

    def resize(self, width, height, ratio=1):
        raise NotImplementedError

    def media(self, *features):
        """Such as ("prefers-color-scheme", "dark")."""
        raise NotImplementedError

    def go_to(self, address):
        """Loads it, and waits for it."""
        raise NotImplementedError

    def evaluate(self, expression):
        """The JSON value of the expression; a promise is waited for."""
        raise NotImplementedError

    def press(self, key, code, text, modifiers):
        raise NotImplementedError

    def mouse(self, kind, x, y, **parameters):
        """`kind` and `parameters` have the names of chromium's Input.dispatchMouseEvent."""
        raise NotImplementedError

    def touch(self, is_touched):
        """Whether fingers touch the screen, of pages that are opened from now on; else there is a mouse."""
        raise NotImplementedError

    def tap(self, x, y):
        """With one finger."""
        raise NotImplementedError

    def pinch(self, x, y, some, others):
        """Two fingers beside (x, y), that many pixels from it first and last."""
        raise NotImplementedError

    def screenshot(self, box=None):
        """The page, or its part (left, top, right, bottom), as the bytes of a PNG file."""
        raise NotImplementedError

    # ---- in all browsers alike ----

    def open(self, path, fragment=""):
        """Loads the file, with a fragment of the address, and waits for it."""
        is_first = self.url is None
        self.url = path.resolve().as_uri()
        # The page may be there with another fragment, and would not be loaded anew.
        for address in (self.url + fragment,) if is_first else ("about:blank", self.url + fragment):
            self.go_to(address)
        self.settle()

    def settle(self):
        """Waits until what was asked for is drawn."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() =>"
                      " setTimeout(done, 0)))).then(() => null)")

    def key(self, key, code=None, text=None, modifiers=0):
        """`modifiers` is 8 for Shift."""
        self.press(key, code or key, key if text is None and len(key) == 1 else text, modifiers)
        self.settle()

    def move(self, x, y):
        self.mouse("mouseMoved", x, y)
        self.settle()

    def click(self, x, y):
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, button="left", clickCount=1)
        self.mouse("mouseReleased", x, y, button="left", clickCount=1)
        self.settle()

    def click_element(self, identifier):
        x, y = self.evaluate(
            f"(() => {{ const r = document.getElementById({json.dumps(identifier)})"
            ".getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")
        self.click(x, y)


# The pixels of PNG files in base64, as numbers of 32 bits: alpha, blue, green, red.
PIXELS = """const pixelsOf = async (text) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes]), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  return new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
};"""
COUNTS = """(async () => {
  PIXELS
  const counts = new Map();
  for (const pixel of await pixelsOf(PICTURE)) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
  return [...counts].map(([pixel, count]) => [pixel & 255, pixel >> 8 & 255, pixel >> 16 & 255, count]);
})()"""
DIFFERENCE = """(async () => {
  PIXELS
  const some = await pixelsOf(PICTURE), others = await pixelsOf(OTHER);
  const isFar = (p, q, shift) => Math.abs((p >> shift & 255) - (q >> shift & 255)) > LEAST;
  let count = 0;
  for (let i = 0; i < some.length; ++i) {
    const p = some[i], q = others[i];
    if (p !== q && (isFar(p, q, 0) || isFar(p, q, 8) || isFar(p, q, 16))) ++count;
  }
  return count / some.length;
})()"""


class Picture:
    """A PNG file, to be compared with others: the same pixels make the same bytes. The browser reads its
    pixels, since that takes Python a hundred times as long."""

    def __init__(self, window, png):
        self.window = window
        self.png = png

    def __eq__(self, other):
        return self.png == other.png

    def __repr__(self):
        return f"<picture of {len(self.counts())} colors, checksum {zlib.crc32(self.png):x}>"

    def size(self):
        """(width, height)."""
        if self.png[:8] != b"\x89PNG\r\n\x1a\n":
            raise ValueError("not a PNG file")
        return struct.unpack(">II", self.png[16:24])

    def text(self):
        return json.dumps(base64.b64encode(self.png).decode())

    def counts(self):
        """How often each color (r, g, b) occurs."""
        script = COUNTS.replace("PIXELS", PIXELS).replace("PICTURE", self.text())
        return {bytes(color): count for *color, count in self.window.evaluate(script)}

    def difference(self, other, least=64):
        """The share of the pixels in which a color differs by more than a little, as it does where two
        ways of drawing smooth edges otherwise. The pictures are of the same size."""
        if self.size() != other.size():
            raise ValueError("the pictures have different sizes")
        script = DIFFERENCE.replace("PIXELS", PIXELS).replace("LEAST", str(least))
        return self.window.evaluate(script.replace("PICTURE", self.text()).replace("OTHER", other.text()))

    def most_frequent(self):
        counts = self.counts()
        return max(counts, key=counts.get)
