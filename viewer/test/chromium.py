# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless chromium, driven over its DevTools protocol through a pipe."""
import base64
import json
import os
import select
import shutil
import subprocess
import time

from browser import SECONDS, Browser, BrowserError

FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--remote-debugging-pipe", "--hide-scrollbars", "about:blank",
]


class Chromium(Browser):
    def __init__(self, width=1280, height=800, media=(), without_webgl=False):
        self.flags = ["--disable-3d-apis"] if without_webgl else []
        super().__init__(width, height, media)

    @staticmethod
    def executable():
        """chromium-headless-shell if it is there: it has no window, and opens pages in half the time."""
        return os.environ.get("KINETRI_CHROMIUM") or shutil.which("chromium-headless-shell") or shutil.which("chromium")

    def start(self):
        ours_in, self.output = os.pipe()
        self.input, ours_out = os.pipe()
        self.log = open(os.path.join(self.folder.name, "log"), "w+b")
        self.process = subprocess.Popen(
            ["sh", "-c", 'exec "$0" "$@" 3<&' + str(ours_in) + " 4>&" + str(ours_out),
             self.executable(), f"--user-data-dir={self.folder.name}/profile", *self.flags, *FLAGS],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
            pass_fds=(ours_in, ours_out), start_new_session=True)
        os.close(ours_in)
        os.close(ours_out)
        self.buffer = b""
        self.number = 0
        self.session = self.context = None

    def begin_page(self, width, height, media=()):
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
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": name, "value": value} for name, value in features])

    def go_to(self, address):
        self.loaded = False
        self.call("Page.navigate", url=address)
        deadline = time.monotonic() + SECONDS
        while not self.loaded:
            self.receive(deadline)

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise BrowserError(f"{expression}: " + details.get("exception", {}).get(
                "description", details["text"]))
        return answer["result"].get("value")

    def press(self, key, code, text, modifiers):
        common = {"key": key, "code": code, "modifiers": modifiers,
                  "windowsVirtualKeyCode": {"Escape": 27}.get(key, 0)}
        down = {"text": text} if text is not None else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", **common, **down)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def mouse(self, kind, x, y, **parameters):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **parameters)

    def touch(self, is_touched):
        self.call("Emulation.setTouchEmulationEnabled", enabled=is_touched, maxTouchPoints=2)

    def tap(self, x, y):
        self.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y, "id": 1}])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.settle()

    def pinch(self, x, y, some, others):
        self.touch(True)
        touch = lambda kind, points: self.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        fingers = lambda apart: [{"x": x - apart, "y": y, "id": 1}, {"x": x + apart, "y": y, "id": 2}]
        touch("touchStart", fingers(some))
        for step in range(1, 11):
            touch("touchMove", fingers(some + (others - some) * step / 10))
        touch("touchEnd", [])

    def screenshot(self, box=None):
        part = {}
        if box is not None:
            left, top, right, bottom = box
            part["clip"] = {"x": left, "y": top, "width": right - left, "height": bottom - top,
                            "scale": 1}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **part)["data"])
