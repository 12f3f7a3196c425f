# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless firefox, driven over its Marionette protocol through a socket. Sizes, features, and what went
wrong are not part of that protocol: scripts with the rights of firefox itself see to them."""
import base64
import json
import os
import pathlib
import shutil
import socket
import subprocess
import time

from browser import SECONDS, Browser, BrowserError

PREFERENCES = {
    "app.normandy.enabled": False, "app.update.auto": False, "browser.startup.page": 0,
    "browser.shell.checkDefaultBrowser": False, "datareporting.policy.dataSubmissionEnabled": False,
    "marionette.port": 0, "messaging-system.rsexperimentloader.enabled": False,
    "services.settings.server": "data:,", "toolkit.telemetry.reportingpolicy.firstRun": False,
}
KEYS = {"Enter": "\ue007", "Shift": "\ue008", "Escape": "\ue00c", "PageUp": "\ue00e", "PageDown": "\ue00f",
        "End": "\ue010", "Home": "\ue011", "ArrowLeft": "\ue012", "ArrowUp": "\ue013",
        "ArrowRight": "\ue014", "ArrowDown": "\ue015", "Tab": "\ue004", "Delete": "\ue017"}
SHIFT = 8

# Collects errors of scripts and requests to servers, of all pages.
WATCH = """
  const problems = window.kinetriProblems = [];
  Services.console.registerListener({observe(message) {
    if (!(message instanceof Ci.nsIScriptError) || message.flags & Ci.nsIScriptError.warningFlag) return;
    if (message.sourceName.startsWith('file:')) problems.push(`exception: ${message.errorMessage}`);
  }});
  Services.obs.addObserver((channel) => {
    const browsingContextID = channel.QueryInterface(Ci.nsIChannel).loadInfo?.browsingContextID;
    if (browsingContextID === gBrowser.selectedBrowser.browsingContext.id) {
      problems.push(`request: ${channel.URI.spec.slice(0, 200)}`);
    }
  }, 'http-on-opening-request');
"""
RESIZE = """
  const [width, height, ratio] = arguments;
  for (const [side, size] of [['width', width], ['height', height]]) {
    for (const which of ['', 'min-', 'max-']) {
      gBrowser.selectedBrowser.style.setProperty(which + side, `${size}px`, 'important');
    }
  }
  gBrowser.selectedBrowser.browsingContext.overrideDPPX = ratio;
"""
MEDIA = """
  const features = new Map(arguments[0]);
  gBrowser.selectedBrowser.browsingContext.prefersColorSchemeOverride = features.get('prefers-color-scheme') ?? 'light';
  Services.prefs.setIntPref('ui.prefersReducedMotion', features.get('prefers-reduced-motion') === 'reduce' ? 1 : 0);
"""
# The bits of what points: 1 for a finger, 2 and 4 for a mouse.
TOUCH = """
  for (const which of ['primary', 'all']) {
    Services.prefs.setIntPref(`ui.${which}PointerCapabilities`, arguments[0] ? 1 : 6);
  }
"""
SCREENSHOT = """
  const [left, top, width, height, done] = arguments;
  (async () => {
    const context = gBrowser.selectedBrowser.browsingContext;
    const picture = await context.currentWindowGlobal.drawSnapshot(
        new DOMRect(left, top, width, height), context.overrideDPPX || 1, 'white');
    const canvas = document.createElementNS('http://www.w3.org/1999/xhtml', 'canvas');
    [canvas.width, canvas.height] = [picture.width, picture.height];
    canvas.getContext('2d').drawImage(picture, 0, 0);
    return canvas.toDataURL();
  })().then(done, (error) => done(`${error}`));
"""
EVALUATE = """
  const done = arguments[1];
  (async () => JSON.stringify(await window.eval(arguments[0])))().then(
      (value) => done([value ?? 'null', null]), (error) => done([null, `${error}\\n${error.stack}`]));
"""


class Firefox(Browser):
    needs_card = True

    def __init__(self, width=1280, height=800, media=(), without_webgl=False):
        self.preferences = PREFERENCES | ({"webgl.disabled": True} if without_webgl else {})
        super().__init__(width, height, media)

    @staticmethod
    def executable():
        return os.environ.get("KINETRI_FIREFOX") or shutil.which("firefox-esr") or shutil.which("firefox")

    def start(self):
        profile = pathlib.Path(self.folder.name, "profile")
        profile.mkdir()
        (profile / "user.js").write_text("".join(
            f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
            for name, value in self.preferences.items()))
        self.log = open(os.path.join(self.folder.name, "log"), "w+b")
        self.process = subprocess.Popen(
            [self.executable(), "--headless", "--no-remote", "--profile", profile, "--marionette",
             "--remote-allow-system-access"],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, start_new_session=True,
            env=os.environ | {"HOME": self.folder.name, "MOZ_HEADLESS_WIDTH": "2400",
                              "MOZ_HEADLESS_HEIGHT": "1600"})
        self.socket = self.stream = None
        self.number = 0
        try:
            self.connect(profile / "MarionetteActivePort")
        except Exception:
            self.close()
            raise

    def connect(self, port_file):
        deadline = time.monotonic() + SECONDS
        while not (port_file.exists() and port_file.read_text().strip()):
            if self.process.poll() is not None or time.monotonic() > deadline:
                raise BrowserError(f"firefox did not start:\n{self.log_text()}")
            time.sleep(0.05)
        self.socket = socket.create_connection(("127.0.0.1", int(port_file.read_text())), SECONDS)
        self.stream = self.socket.makefile("rb")
        self.receive()  # what it speaks
        self.call("WebDriver:NewSession", capabilities={})
        self.call("WebDriver:SetTimeouts", script=1000 * SECONDS, pageLoad=1000 * SECONDS)
        self.call("WebDriver:SetWindowRect", width=2300, height=1500)
        self.in_firefox(WATCH)

    def close(self):
        try:
            if self.stream is not None:
                self.call("Marionette:Quit", flags=["eForceQuit"])
            self.process.wait(20)
        except (BrowserError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        if self.stream is not None:
            self.stream.close()
            self.socket.close()
        self.log.close()
        self.folder.cleanup()

    # ---- the protocol: JSON arrays, each after its length and a colon ----

    def call(self, method, **parameters):
        self.number += 1
        message = json.dumps([0, self.number, method, parameters]).encode()
        try:
            self.socket.sendall(b"%d:%s" % (len(message), message))
            _, number, error, result = self.receive()
        except OSError as error:
            raise BrowserError(f"firefox has ended, or did not answer in {SECONDS} s: {error}\n"
                               f"{self.log_text()}") from None
        if number != self.number:
            raise BrowserError(f"{method}: the answer is that of call {number}")
        if error is not None:
            raise BrowserError(f"{method}: {error['error']}: {error['message']}")
        return result

    def receive(self):
        length = b""
        while not length.endswith(b":"):
            byte = self.stream.read(1)
            if not byte:
                raise OSError("the socket is closed")
            length += byte
        return json.loads(self.stream.read(int(length[:-1])))

    def in_firefox(self, script, *arguments, kind="Script"):
        self.call("Marionette:SetContext", value="chrome")
        try:
            return self.call(f"WebDriver:Execute{kind}", script=script, args=arguments)["value"]
        finally:
            self.call("Marionette:SetContext", value="content")

    def log_text(self):
        self.log.flush()
        with open(self.log.name, encoding="utf-8", errors="replace") as log:
            return log.read()[-4000:]

    # ---- a page ----

    @property
    def problems(self):
        return self.in_firefox("return window.kinetriProblems")

    @problems.setter
    def problems(self, problems):
        self.in_firefox("window.kinetriProblems.splice(0, Infinity, ...arguments[0])", problems)

    def begin_page(self, width, height, media=()):
        old = self.call("WebDriver:GetWindowHandle")["value"]
        handle = self.call("WebDriver:NewWindow", type="tab", focus=True)["handle"]
        self.call("WebDriver:SwitchToWindow", handle=old)
        self.call("WebDriver:CloseWindow")
        self.call("WebDriver:SwitchToWindow", handle=handle)
        self.problems = []
        self.url = None
        self.resize(width, height)
        self.media(*media)
        self.touch(False)

    def resize(self, width, height, ratio=1):
        self.in_firefox(RESIZE, width, height, ratio)
        deadline = time.monotonic() + SECONDS
        while self.evaluate("[innerWidth, innerHeight, devicePixelRatio]") != [width, height, ratio]:
            if time.monotonic() > deadline:
                raise BrowserError(f"firefox does not take the size {width} x {height}, ratio {ratio}")

    def media(self, *features):
        self.in_firefox(MEDIA, features)

    def go_to(self, address):
        self.call("WebDriver:Navigate", url=address)

    def evaluate(self, expression):
        answer = self.call("WebDriver:ExecuteAsyncScript", script=EVALUATE, args=[expression])["value"]
        if answer is None:
            raise BrowserError(f"{expression}: the page has gone before it answered")
        value, error = answer
        if error is not None:
            raise BrowserError(f"{expression}: {error}")
        return json.loads(value)

    def act(self, device, *actions, **more):
        self.call("WebDriver:PerformActions",
                  actions=[{"type": device, "id": device, "actions": list(actions), **more}])

    def press(self, key, code, text, modifiers):
        held = [KEYS["Shift"]] if modifiers == SHIFT else []
        value = KEYS.get(key, key)
        self.act("key", *({"type": "keyDown", "value": one} for one in held),
                 {"type": "keyDown", "value": value}, {"type": "keyUp", "value": value},
                 *({"type": "keyUp", "value": one} for one in held))

    def mouse(self, kind, x, y, **parameters):
        if kind == "mouseWheel":
            self.act("wheel", {"type": "scroll", "x": round(x), "y": round(y), "deltaX": parameters["deltaX"],
                               "deltaY": parameters["deltaY"]})
            return
        move = {"type": "pointerMove", "x": x, "y": y, "duration": 0}
        press = {"mousePressed": [{"type": "pointerDown", "button": 0}], "mouseMoved": [],
                 "mouseReleased": [{"type": "pointerUp", "button": 0}]}[kind]
        self.act("pointer", move, *press, parameters={"pointerType": "mouse"})

    def touch(self, is_touched):
        self.in_firefox(TOUCH, is_touched)

    def tap(self, x, y):
        self.act("pointer", {"type": "pointerMove", "x": x, "y": y, "duration": 0}, {"type": "pointerDown", "button": 0},
                 {"type": "pointerUp", "button": 0}, parameters={"pointerType": "touch"})
        self.settle()

    def pinch(self, x, y, some, others):
        finger = lambda sign: [
            {"type": "pointerMove", "x": x + sign * some, "y": y, "duration": 0},
            {"type": "pointerDown", "button": 0},
            *({"type": "pointerMove", "x": x + sign * (some + (others - some) * step / 10), "y": y,
               "duration": 20} for step in range(1, 11)),
            {"type": "pointerUp", "button": 0}]
        self.call("WebDriver:PerformActions", actions=[
            {"type": "pointer", "id": f"finger {sign}", "parameters": {"pointerType": "touch"},
             "actions": finger(sign)} for sign in (-1, 1)])

    def screenshot(self, box=None):
        left, top, right, bottom = box or (0, 0, *self.evaluate("[innerWidth, innerHeight]"))
        url = self.in_firefox(SCREENSHOT, left, top, right - left, bottom - top, kind="AsyncScript")
        if not url.startswith("data:"):
            raise BrowserError(f"no screenshot: {url}")
        return base64.b64decode(url.partition(",")[2])
