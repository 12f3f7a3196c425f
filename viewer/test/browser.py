# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless chromium, driven over its DevTools protocol through a pipe; and pictures from it."""
import base64
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--remote-debugging-pipe", "--hide-scrollbars", "about:blank",
]
SECONDS = 60  # that an answer may take, on a machine that is busy


class BrowserError(Exception):
    pass


def executable():
    """The path of chromium, or None."""
    return os.environ.get("KINETRI_CHROMIUM") or shutil.which("chromium")


class Browser:
    """One page at a time. `problems` collects its console errors, exceptions, and requests that are not
    for the file itself. Use it as a context manager."""

    def __init__(self, width=1280, height=800, media=(), flags=()):
        self.folder = tempfile.TemporaryDirectory(prefix="kinetri-viewer-", ignore_cleanup_errors=True)
        ours_in, self.output = os.pipe()
        self.input, ours_out = os.pipe()
        self.log = open(os.path.join(self.folder.name, "log"), "w+b")
        self.process = subprocess.Popen(
            ["sh", "-c", 'exec "$0" "$@" 3<&' + str(ours_in) + " 4>&" + str(ours_out),
             executable(), f"--user-data-dir={self.folder.name}/profile", *flags, *FLAGS],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
            pass_fds=(ours_in, ours_out), start_new_session=True)
        os.close(ours_in)
        os.close(ours_out)
        self.buffer = b""
        self.number = 0
        self.session = self.context = None
        try:
            self.begin_page(width, height, media)
        except Exception:
            self.close()
            raise

    def begin_page(self, width, height, media=()):
        """An empty page that knows nothing of the one before, which is closed: what browsers keep is of
        its own, and so are sizes and features."""
        self.session = None
        if self.context is not None:
            self.call("Target.disposeBrowserContext", browserContextId=self.context)
        self.problems = []
        self.url = None
        self.loaded = False
        self.context = self.call("Target.createBrowserContext")["browserContextId"]
        target = self.call("Target.createTarget", url="about:blank",
                           browserContextId=self.context)["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height)
        self.media(*media)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except (BrowserError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        for descriptor in (self.input, self.output):
            os.close(descriptor)
        self.log.close()
        self.folder.cleanup()

    # ---- the protocol: JSON objects, each ended by a zero byte ----

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session is not None:
            message["sessionId"] = self.session
        try:
            os.write(self.output, json.dumps(message).encode() + b"\0")
        except BrokenPipeError:
            raise BrowserError(f"chromium has ended:\n{self.log_text()}") from None
        deadline = time.monotonic() + SECONDS
        while True:
            answer = self.receive(deadline)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def receive(self, deadline):
        while b"\0" not in self.buffer:
            if not select.select([self.input], [], [], max(0, deadline - time.monotonic()))[0]:
                raise BrowserError(f"chromium did not answer in {SECONDS} s:\n{self.log_text()}")
            data = os.read(self.input, 1 << 20)
            if not data:
                raise BrowserError(f"chromium has ended:\n{self.log_text()}")
            self.buffer += data
        text, _, self.buffer = self.buffer.partition(b"\0")
        message = json.loads(text)
        if message.get("sessionId") == self.session:
            self.note(message.get("method"), message.get("params", {}))
        return message

    def note(self, method, parameters):
        if method == "Page.loadEventFired":
            self.loaded = True
        elif method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.problems.append("exception: " + details.get("exception", {}).get(
                "description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning"):
            self.problems.append(f"console: {parameters['args']}")
        elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            # A screenshot of what WebGL has drawn waits for it, which chromium reports.
            if "GPU stall due to ReadPixels" not in parameters["entry"]["text"]:
                self.problems.append("log: " + parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            if url.partition("?")[0] != self.url:
                self.problems.append(f"request: {url[:200]}")

    def log_text(self):
        self.log.flush()
        with open(self.log.name, encoding="utf-8", errors="replace") as log:
            return log.read()[-4000:]

    # ---- a page ----

    def resize(self, width, height, ratio=1):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=ratio, mobile=False)

    def media(self, *features):
        """Such as ("prefers-color-scheme", "dark")."""
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": name, "value": value} for name, value in features])

    def open(self, path, fragment=""):
        """Loads the file, with a fragment of the address, and waits for it."""
        is_first = self.url is None
        self.url = path.resolve().as_uri()
        # The page may be there with another fragment, and would not be loaded anew.
        for address in (self.url + fragment,) if is_first else ("about:blank", self.url + fragment):
            self.loaded = False
            self.call("Page.navigate", url=address)
            deadline = time.monotonic() + SECONDS
            while not self.loaded:
                self.receive(deadline)
        self.settle()

    def evaluate(self, expression):
        """The JSON value of the expression; a promise is waited for."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise BrowserError(f"{expression}: " + details.get("exception", {}).get(
                "description", details["text"]))
        return answer["result"].get("value")

    def settle(self):
        """Waits until what was asked for is drawn."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() =>"
                      " setTimeout(done, 0)))).then(() => null)")

    def key(self, key, code=None, text=None, modifiers=0):
        if text is None and len(key) == 1:
            text = key
        common = {"key": key, "code": code or key, "modifiers": modifiers,
                  "windowsVirtualKeyCode": {"Escape": 27}.get(key, 0)}
        down = {"text": text} if text is not None else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", **common, **down)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)
        self.settle()

    def mouse(self, kind, x, y, **parameters):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **parameters)

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

    def screenshot(self, box=None):
        """The page, or its part (left, top, right, bottom), as the bytes of a PNG file."""
        part = {}
        if box is not None:
            left, top, right, bottom = box
            part["clip"] = {"x": left, "y": top, "width": right - left, "height": bottom - top,
                            "scale": 1}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **part)["data"])


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
