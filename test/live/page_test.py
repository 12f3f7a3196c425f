#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live page, in a browser, with real pointer events. What it shows is compared with what its module says, and
its logs are checked by kinetri-verify, which shares no code with it.

usage: page_test.py KINETRI KINETRI_VERIFY BROWSER

BROWSER is chromium or firefox. Ends with 77, which ctest takes for skipped, if the program has no module of live
pages, or the browser is not there.
"""
import math
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "viewer" / "test"))
from browser import BrowserError  # noqa: E402
from chromium import Chromium  # noqa: E402
from firefox import Firefox  # noqa: E402

SKIPPED = 77
BROWSERS = {"chromium": Chromium, "firefox": Firefox}
POINTS = "x,y,vx,vy\n" + "".join(f"{7 * i % 50 + 3},{11 * i % 53 + 2},{i % 5 - 2},{i % 7 - 3}\n" for i in range(40))
SCREEN = "(() => { const x = live.flatView.camera.screenX(%f), y = live.flatView.camera.screenY(%f);" \
         " const r = element('picture').getBoundingClientRect(); return [r.left + x, r.top + y]; })()"


def write_page(folder, *arguments):
    page = folder / "live.html"
    done = subprocess.run([PROGRAM, "live", *arguments, "-o", page], capture_output=True, text=True)
    if done.returncode == 2 and "without the module of live pages" in done.stderr:
        print(done.stderr, end="")
        sys.exit(SKIPPED)
    if done.returncode != 0 or done.stderr != f"kinetri: {page} is written; open it in a browser\n":
        raise AssertionError(done.stderr)
    return page


class LivePageTest(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self.id().rsplit(".", 1)[1]
        self.folder.mkdir()
        BROWSER.begin_page(1280, 800)

    def tearDown(self):
        self.assertEqual(BROWSER.problems, [])

    def open(self, *arguments, query="", plays=False):
        """The page, paused as soon as it can be."""
        page = write_page(self.folder, *arguments)
        BROWSER.url = page.resolve().as_uri() + query
        BROWSER.go_to(BROWSER.url)
        self.wait("window.live !== undefined || !document.getElementById('message').hidden")
        BROWSER.problems = [text for text in BROWSER.problems if not text.endswith(BROWSER.url.split("#")[0])]
        if not plays:
            self.evaluate("live.isPlaying() && live.togglePlaying(1)")
            BROWSER.settle()

    def evaluate(self, expression):
        return BROWSER.evaluate(expression)

    def wait(self, condition, seconds=60, is_loading=False):
        """A page that is loading may not answer."""
        end = time.monotonic() + seconds
        while True:
            try:
                if self.evaluate(condition):
                    return
            except BrowserError:
                if not is_loading:
                    raise
            self.assertLess(time.monotonic(), end, f"waiting for {condition}")
            time.sleep(0.05)

    def points_file(self, text=POINTS):
        path = self.folder / "points.csv"
        path.write_text(text)
        return path

    def place_of(self, point):
        """Where it is on the page."""
        x, y = self.evaluate(f"Array.from(live.points.positions().subarray({2 * point}, {2 * point + 2}))")
        return self.evaluate(SCREEN % (x, y))

    def drag(self, begin, end, steps=12):
        BROWSER.mouse("mouseMoved", *begin)
        BROWSER.mouse("mousePressed", *begin, button="left", buttons=1, clickCount=1)
        for i in range(1, steps + 1):
            place = [a + (b - a) * i / steps for a, b in zip(begin, end)]
            BROWSER.mouse("mouseMoved", *place, button="left", buttons=1)
            if i < steps:
                BROWSER.settle()
        BROWSER.mouse("mouseReleased", *end, button="left", clickCount=1)
        BROWSER.settle()

    def choose(self, tool):
        self.evaluate(f"document.querySelector('[data-tool={tool}]').click()")

    def check_present(self):
        """What is shown is what the module has, and an audit passes."""
        self.evaluate("live.goToEnd()")
        BROWSER.settle()
        shown = [number for edge in self.evaluate("kinetri.edges()") for number in edge]
        self.assertEqual(shown, self.evaluate("Array.from(live.points.edges())"))
        triangles = [number for triangle in self.evaluate("kinetri.triangles()") for number in triangle]
        self.assertEqual(triangles, self.evaluate("Array.from(live.points.triangles())"))
        self.assertEqual(self.evaluate("live.points.audit()"), [])

    def check_logs(self):
        """With the logs that the page saves, the commands that it shows are right: `kinetri simulate --replay`
        has the same log and ends with the edges that are shown, and `kinetri-verify` accepts it."""
        self.evaluate("live.change(() => {})")
        for name in ("motions", "events"):
            (self.folder / f"live.{name}.csv").write_text("".join(self.evaluate(f"live.logs.{name}")))
        programs = {"kinetri": [PROGRAM], "kinetri-verify": [VERIFY]}
        for command in self.evaluate("live.commands()").splitlines():
            name, *words = command.split()
            if name == "kinetri":
                words += ["--events", "again.csv", "--quiet"]
            done = subprocess.run([*programs.pop(name), *words], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        self.assertEqual(programs, {})
        events = (self.folder / "live.events.csv").read_text().splitlines()
        self.assertEqual((self.folder / "again.csv").read_text().splitlines(), events)
        edges = "".join(f"{a},{b}\n" for a, b in self.evaluate("kinetri.edges()"))
        self.assertEqual((self.folder / "edges.csv").read_text(), "a,b\n" + edges)
        return events

    # ---- tests ----

    def test_points_move_and_the_logs_are_verified(self):
        self.open(self.points_file(), "--box", "0,0,60,60", plays=True)
        self.wait("live.clock > 2")
        self.evaluate("live.togglePlaying(1)")
        self.evaluate("live.points.advanceTo(live.clock)")
        self.check_present()
        events = self.check_logs()
        self.assertGreater(len(events), 50)
        # The program has the same events.
        until = self.evaluate("live.clock")
        log = subprocess.run([PROGRAM, "simulate", self.folder / "points.csv", "--until", repr(until), "--box",
                              "0,0,60,60", "--events", "-", "--quiet"], capture_output=True, text=True, check=True)
        self.assertEqual(log.stdout.splitlines(), events)

    def test_every_beginning_passes_an_audit(self):
        for start in ("gas", "falling", "packing", "crowds", "flock", "mover", "lattice", "wave"):
            with self.subTest(start=start):
                BROWSER.begin_page(1280, 800)
                self.open(query=f"?start={start}&points=60", plays=True)
                self.assertEqual(self.evaluate("live.points.length"), 60)
                self.wait("live.clock > 0.4 || element('status').textContent.includes('expected')")
                self.evaluate("live.direction = 0")
                BROWSER.settle()
                self.assertGreater(self.evaluate("live.clock"), 0.4)
                self.check_present()

    def test_a_large_lattice(self):
        self.open(query="?start=lattice&points=9900")
        self.assertEqual(self.evaluate("live.points.length"), 9900)
        self.assertEqual(self.evaluate("live.points.audit()"), [])

    def test_a_beginning_is_changed(self):
        self.open(query="?start=flock&points=20&radius=1.5&collisions=elastic&gravity=10")
        self.assertEqual(self.evaluate("Array.from(new Set(live.points.radii()))"), [1.5])
        self.assertEqual(self.evaluate("Array.from(live.points.accelerations().subarray(0, 2))"), [0, -10])
        self.assertEqual(self.evaluate("live.options.collisions"), "elastic")
        shown = "['radius', 'growth', 'collisions', 'gravity'].map((name) => element(`live-${name}`).value)"
        self.assertEqual(self.evaluate(shown), ["1.5", "", "elastic", "10"])
        self.check_present()
        # The form asks for another one.
        self.evaluate("element('live-preset').value = 'mover'; element('live-preset').dispatchEvent(new Event('change'));"
                      " element('live-count').value = 30; element('live-growth').value = 0.25;"
                      " element('live-radius').value = element('live-gravity').value = element('live-collisions').value = '';"
                      " element('live-start').requestSubmit()")
        self.wait("window.live?.preset.id === 'mover'", is_loading=True)
        BROWSER.problems = []
        self.assertEqual(self.evaluate("window.location.search"), "?start=mover&points=30&growth=0.25")
        self.evaluate("live.direction = 0")
        before = self.evaluate("[live.clock, live.points.radii()[7]]")
        self.evaluate("live.togglePlaying(1)")
        self.wait(f"live.clock > {before[0]} + 0.5")
        self.evaluate("live.direction = 0")
        clock, radius = self.evaluate("[live.clock, live.points.radii()[7]]")
        self.assertAlmostEqual(radius - before[1], 0.25 * (clock - before[0]), delta=1e-9)
        self.check_present()

    def test_points_fall_and_are_pinned(self):
        self.open(query="?start=falling&points=12&radius=1&collisions=log")
        self.choose("pin")
        place = self.evaluate("Array.from(live.points.positions().subarray(0, 2))")
        velocity = self.evaluate("Array.from(live.points.velocities().subarray(0, 2))")
        BROWSER.click(*self.place_of(0))
        self.choose("add")
        BROWSER.click(*self.evaluate(SCREEN % (50.5, 97)))
        self.assertEqual(self.evaluate("live.points.length"), 13)
        begin = self.evaluate("live.clock")
        self.evaluate("live.togglePlaying(1)")
        self.wait(f"live.clock > {begin} + 0.25")
        self.evaluate("live.direction = 0")
        self.assertEqual(self.evaluate("Array.from(live.points.positions().subarray(0, 2))"), place)
        elapsed = self.evaluate("live.clock") - begin
        self.assertAlmostEqual(self.evaluate("live.points.velocities()[25]"), -30 * elapsed, delta=1e-9)
        self.choose("pin")
        BROWSER.click(*self.place_of(0))
        self.assertEqual(self.evaluate("Array.from(live.points.velocities().subarray(0, 2))"), velocity)
        self.assertEqual(self.evaluate("Array.from(live.points.accelerations().subarray(0, 2))"), [0, -30])
        self.check_present()
        # A point that is put to the floor does not rebound there without end.
        self.choose("take")
        self.drag(self.place_of(0), self.evaluate(SCREEN % (40, -30)))
        clock = self.evaluate("live.clock")
        self.evaluate("live.togglePlaying(1)")
        self.wait(f"live.clock > {clock} + 1")
        self.evaluate("live.direction = 0")
        self.check_present()
        self.check_logs()

    def test_a_point_is_thrown(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        self.evaluate("live.speedStep = -4")
        for _ in range(10):  # on a busy machine the pointer may seem to rest before it is released
            begin = self.place_of(0)
            self.evaluate("live.togglePlaying(1)")
            self.drag(begin, [begin[0] + 90, begin[1] - 60])
            self.evaluate("live.direction = 0")
            if self.evaluate("live.points.velocities()[0]") != 0:
                break
        kinds = self.evaluate("Array.from(live.recording.rowKind.subarray(0, live.recording.rows),"
                              " (kind) => live.recording.kinds[kind])")
        self.assertIn("trajectory", kinds)
        vx, vy = self.evaluate("Array.from(live.points.velocities().subarray(0, 2))")
        self.assertGreater(vx, 0)
        self.assertGreater(vy, 0)
        self.check_present()
        self.check_logs()

    def test_a_point_is_moved_while_time_stands_still(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        begin = self.place_of(3)
        end = [begin[0] + 40, begin[1] + 25]
        self.drag(begin, end)
        place = self.place_of(3)
        self.assertAlmostEqual(place[0], end[0], delta=1)
        self.assertAlmostEqual(place[1], end[1], delta=1)
        self.check_present()
        # Out of the box it stays at the wall.
        self.drag(place, [2, place[1]])
        self.assertEqual(self.evaluate("live.points.positions()[6]"), 0)
        self.check_present()
        self.check_logs()

    def test_points_are_added_erased_and_pinned(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        self.choose("add")
        BROWSER.click(*self.evaluate(SCREEN % (30.2, 0.8)))
        self.assertEqual(self.evaluate("live.points.length"), 41)
        self.choose("erase")
        BROWSER.click(*self.place_of(5))
        self.assertEqual(self.evaluate("live.points.length"), 40)
        self.choose("pin")
        BROWSER.click(*self.place_of(7))
        self.assertEqual(self.evaluate("Array.from(live.points.velocities().subarray(14, 16))"), [0, 0])
        self.check_present()
        BROWSER.click(*self.place_of(7))
        self.assertEqual(self.evaluate("Array.from(live.points.velocities().subarray(14, 16))"), [0, -3])
        self.check_present()
        self.check_logs()

    def test_a_pinned_disc_that_is_thrown_has_its_own_mass(self):
        points = "x,y,vx,vy,mass\n" + "".join(f"{10 * i + 5},{10 * k + 5},1,0,{i + 2}\n" for i in range(6) for k in range(6))
        self.open(self.points_file(points), "--box", "0,0,60,60", "--radius", "1.5", "--collisions", "elastic")
        masses = self.evaluate("Array.from(live.points.masses()).filter((mass) => mass > 0)")
        self.assertEqual(masses, [i + 2 for i in range(6) for _ in range(6)])
        mass = "live.points.masses()[14]"
        self.choose("pin")
        BROWSER.click(*self.place_of(14))
        self.assertEqual(self.evaluate(mass), 1e9)
        self.choose("take")
        self.evaluate("live.speedStep = -6")
        for plays in (False, True):  # while time stands still it is only moved, and remains pinned
            if plays:
                self.evaluate("live.togglePlaying(1)")
            x, y = self.place_of(14)
            self.drag([x, y], [x + 25, y + 20])
            self.evaluate("live.direction = 0")
            self.assertEqual(self.evaluate("[live.pinned.has(14), live.hold]"), [not plays, None])
            self.assertEqual(self.evaluate(mass), 4 if plays else 1e9)
        # A disc that is held.
        x, y = self.place_of(3)
        BROWSER.mouse("mouseMoved", x, y)
        BROWSER.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.assertEqual(self.evaluate("live.points.masses()[3]"), 1e9)
        BROWSER.mouse("mouseReleased", x, y, button="left", clickCount=1)
        self.assertEqual(self.evaluate("live.points.masses()[3]"), 2)
        self.check_present()
        self.check_logs()

    def test_a_disc_is_dropped_onto_another(self):
        self.open(query="?start=gas&points=40")
        self.drag(self.place_of(3), self.place_of(17))
        self.check_present()
        clock = self.evaluate("live.clock")
        self.evaluate("live.togglePlaying(1)")
        self.wait(f"live.clock > {clock} + 0.3 || live.direction === 0")
        # If it does not go on, it says why.
        stopped = self.evaluate("live.direction === 0")
        self.evaluate("live.direction = 0")
        if stopped:
            self.assertNotEqual(self.evaluate("element('status').textContent"), "")
        self.check_present()
        self.check_logs()

    def test_who_is_near_whom(self):
        for query, gap in (("?start=flock&points=60", 0), ("?start=gas&points=60", 2)):  # points; discs
            BROWSER.begin_page(1280, 800)
            self.open(query=query)
            reach = 14
            self.assertFalse(self.evaluate("live.switches.links"))
            self.evaluate("element('live-range').value = 14; element('live-range').dispatchEvent(new Event('change'))")
            self.assertTrue(self.evaluate("live.switches.links"))
            for _ in range(3):
                BROWSER.key("ArrowRight")
                BROWSER.settle()
                places, radii = self.evaluate("[kinetri.positions().slice(0, 60), kinetri.radii().slice(0, 60)]")
                pairs = [[a, b] for a in range(60) for b in range(a + 1, 60)
                         if math.dist(places[a], places[b]) <= reach + (radii[a] + radii[b]) * (gap > 0)]
                self.assertEqual(self.evaluate("kinetri.inRange()"), pairs)
                component = list(range(60))
                for _ in range(60):
                    for a, b in pairs:
                        component[a] = component[b] = min(component[a], component[b])
                self.assertEqual(self.evaluate("kinetri.components().slice(0, 60)"), component)
                nearest = [min((math.dist(places[a], places[b]), b) for b in range(60) if b != a)[1] for a in range(60)]
                self.assertEqual(self.evaluate("Array.from(live.nearest().subarray(0, 60))"), nearest)
            self.evaluate("element('live-nearest').click()")
            self.assertIn(f"{len(pairs)} pairs within range, {len(set(c for c in component if component.count(c) > 1))} "
                          "component", self.evaluate("element('live-says').textContent"))
            self.check_present()
            self.evaluate("live.measureRange(1e6)")  # all of them
            self.assertEqual(self.evaluate("kinetri.inRange().length"), 60 * 59 // 2)
            self.evaluate("live.measureRange(0)")
            self.assertEqual(self.evaluate("kinetri.inRange()"), [])
        BROWSER.begin_page(1280, 800)
        self.open(query="?start=flock&points=1000")
        self.evaluate("live.measureRange(1e6)")
        self.assertIn("more than 200,000 pairs", self.evaluate("element('live-says').textContent"))

    def test_panels_follow_the_run(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        a, b = self.evaluate("kinetri.edges().find(([a]) => a === 12)")
        (ax, ay), (bx, by) = self.place_of(a), self.place_of(b)
        BROWSER.click((ax + bx) / 2, (ay + by) / 2)
        self.assertEqual(self.evaluate("[live.recording.edgeA[live.selected], live.recording.edgeB[live.selected]]"), [a, b])
        self.assertFalse(self.evaluate("element('certificate').hidden"))
        self.assertGreater(self.evaluate("element('sturm').rows.length"), 2)
        BROWSER.click(*self.place_of(a))
        self.assertEqual(self.evaluate("live.selectedPoint.id"), a)
        for _ in range(40):
            BROWSER.key("ArrowRight")
        BROWSER.settle()
        concerned = self.evaluate("Array.from({length: live.recording.rows}, (_, row) => row).filter((row) =>"
                                  f" concerns(live.recording, row, {a})).length")
        self.assertGreater(concerned, 0)
        self.assertIn(f"{concerned}, {concerned} so far", self.evaluate("element('point-facts').textContent"))
        self.check_present()

    def test_a_certificate_follows_the_run(self):
        """It is that of the edge at the present, or, of an edge that is gone, says what has ended it."""
        self.open(self.points_file(), "--box", "0,0,60,60")
        is_there = "live.playback.where[live.selected] >= 0"
        self.evaluate("live.select(live.playback.live[0])")
        removed = ended = 0
        for step in range(200):
            BROWSER.key("ArrowRight")
            BROWSER.settle()
            shown = "[c.begin.row, c.end.row, c.until, c.removal, c.left, c.right]"
            if self.evaluate(is_there):
                same = self.evaluate(f"(() => {{ const of = (c) => JSON.stringify({shown});"
                                     " return of(live.certificate) === of(certificateOf(live.playback, live.selected)); })()")
                self.assertTrue(same, f"step {step}")
                self.assertNotIn("negative", self.evaluate("element('certificate-facts').textContent"))
                ended += self.evaluate("live.certificate.begin.row") >= 0
                continue
            removed += 1
            row = self.evaluate("live.certificate.removal")
            self.assertEqual(self.evaluate(f"live.recording.rowRemoved[{row}]"), self.evaluate("live.selected"))
            self.assertIn("removed by", self.evaluate("element('certificate-facts').textContent"))
            self.evaluate(f"live.select(live.playback.live[{step % 40}])")
        self.assertGreater(removed, 0)
        self.assertGreater(ended, 0)

    def test_what_is_exported_follows_the_run(self):
        self.open(query="?start=gas&points=30", plays=True)
        self.wait("live.clock > 0.3")
        self.evaluate("live.direction = 0; live.toggleSwitch('heat'); element('button-export').click()")
        self.assertEqual(self.evaluate("Number(element('film-until').value)"), self.evaluate("live.recording.until"))
        fragment = self.evaluate("element('link').value").split("#")[1]
        BROWSER.begin_page(1280, 800)
        self.open(query=f"?start=gas&points=30#{fragment}")
        self.assertTrue(self.evaluate("live.switches.heat"))
        self.assertEqual(self.evaluate("followAddress(live, window.location.hash)"), [])

    def test_the_past_cannot_be_changed(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        for key in ["ArrowRight"] * 5 + ["ArrowLeft"]:
            BROWSER.key(key)
        BROWSER.settle()
        BROWSER.click(*self.place_of(3))
        self.assertIn("This is the past", self.evaluate("element('status').textContent"))
        self.choose("erase")
        BROWSER.click(*self.place_of(3))
        self.assertIn("This is the past", self.evaluate("element('status').textContent"))
        self.assertEqual(self.evaluate("live.points.length"), 40)

    def test_a_point_is_thrown_at_a_wall(self):
        """The pointer leaves the box; the point gets its velocity all the same."""
        self.open(self.points_file(), "--box", "0,0,60,60", plays=True)
        self.evaluate("live.changeSpeed(-6)")
        place = self.place_of(5)
        BROWSER.mouse("mouseMoved", *place)
        place = self.place_of(5)
        BROWSER.mouse("mousePressed", *place, button="left", buttons=1, clickCount=1)
        self.assertEqual(self.evaluate("live.hold?.id"), 5)
        # In 20 ms from 15 to 30 beyond the side.
        velocity = self.evaluate(
            "(() => { const {hold, flatView: {camera}} = live, now = performance.now() + 1e6;"
            " const at = (x, timeStamp) => ({offsetX: camera.screenX(x), offsetY: camera.screenY(30), timeStamp});"
            " hold.move(at(75, now)); hold.move(at(90, now + 20));"
            " return hold.thrown(at(90, now + 20)).map((v) => v * live.speed()); })()")
        self.assertAlmostEqual(velocity[0], 750, delta=1e-6)
        self.assertAlmostEqual(velocity[1], 0, delta=1e-6)
        BROWSER.mouse("mouseReleased", *place, button="left", clickCount=1)
        self.evaluate("live.direction = 0")
        self.check_present()

    def test_two_fingers_zoom_where_there_are_points(self):
        BROWSER.touch(True)
        self.open(self.points_file(), "--box", "0,0,60,60")
        places = self.evaluate("Array.from(live.points.positions())")
        scale = self.evaluate("live.flatView.camera.scale")
        x, y = self.place_of(12)
        BROWSER.pinch(x + 40, y, 40, 80)  # one finger on the point
        BROWSER.touch(False)
        self.assertAlmostEqual(self.evaluate("live.flatView.camera.scale") / scale, 2, delta=0.1)
        self.assertIsNone(self.evaluate("live.hold"))
        self.assertEqual(self.evaluate("live.pointerInput.down.size"), 0)
        self.assertEqual(self.evaluate("Array.from(live.points.positions())"), places)
        self.check_present()

    def test_a_button_that_is_released_elsewhere(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        x, y = self.place_of(3)
        BROWSER.mouse("mouseMoved", x, y)
        BROWSER.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        self.assertEqual(self.evaluate("live.hold.id"), 3)
        self.evaluate("element('picture').dispatchEvent(new PointerEvent('pointermove',"
                      " {pointerId: live.hold.pointer, buttons: 0, bubbles: true}))")
        self.assertIsNone(self.evaluate("live.hold"))
        BROWSER.mouse("mouseReleased", x, y, button="left", clickCount=1)
        self.check_present()

    def test_an_hour_in_the_background(self):
        self.open(self.points_file(), "--box", "0,0,60,60", plays=True)
        # As frames are: none for an hour, then one.
        before, speed, after = self.evaluate(
            "(() => { live.lastFrame = performance.now(); const {clock} = live;"
            " live.advance(live.lastFrame + 3600e3); return [clock, live.speed(), live.clock]; })()")
        self.assertLess(after - before, 0.11 * speed)
        self.evaluate("live.direction = 0")
        self.check_present()

    def test_a_point_is_thrown_onto_another(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        # There, with the same velocity: it hides the other one.
        self.evaluate("live.change(() => live.points.setMotions([3], [Array.from(live.points.positions().subarray(34, 36))],"
                      " [[0, 0]]))")
        BROWSER.settle()
        self.assertEqual(self.evaluate("kinetri.hidden()"), [17])
        self.check_present()
        # There, with another one: both go on.
        self.evaluate("live.change(() => live.points.setMotions([3], [Array.from(live.points.positions().subarray(34, 36))],"
                      " [[1, 7]]))")
        clock = self.evaluate("live.clock")
        self.evaluate("live.togglePlaying(1)")
        self.wait(f"live.clock > {clock} + 0.3")
        self.evaluate("live.direction = 0")
        self.check_present()
        self.check_logs()

    def test_a_wall_is_drawn_and_stays(self):
        self.open(query="?start=gas&points=40")
        self.choose("wall")
        begin, end = (self.evaluate(SCREEN % place) for place in ((50, 12), (50, 88)))
        self.drag(begin, end)
        places = self.evaluate("live.openPlaces.length + live.pinned.size")
        self.assertGreater(places, 6)
        self.choose("take")
        self.evaluate("live.togglePlaying(1); live.changeSpeed(4)")
        # It closes where discs were in the way.
        self.wait("live.openPlaces.length === 0 && live.clock > 4")
        wall = self.evaluate("Array.from(live.pinned.keys())")
        self.assertEqual(len(wall), places)
        self.evaluate("live.direction = 0")
        self.check_present()
        places = self.evaluate("Array.from(live.points.positions())")
        for point in wall:
            self.assertAlmostEqual(places[2 * point], 50, delta=0.01)
        self.check_logs()

    def test_a_wall_without_discs(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        self.choose("wall")
        self.drag(self.evaluate(SCREEN % (10, 10)), self.evaluate(SCREEN % (50, 50)))
        self.assertIn("A wall needs discs", self.evaluate("element('status').textContent"))
        self.assertEqual(self.evaluate("live.points.length"), 40)

    def test_a_point_is_thrown_between_two_steps(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        for point in range(8):
            for _ in range(3):
                BROWSER.key("ArrowRight")
            place = self.place_of(point)
            self.drag(place, [place[0] + 12, place[1] - 9], steps=3)
        self.evaluate("live.togglePlaying(1)")
        clock = self.evaluate("live.clock")
        self.wait(f"live.clock > {clock} + 0.2")
        self.evaluate("live.direction = 0")
        self.check_present()
        self.check_logs()

    def test_saving_pauses_and_shows_the_commands(self):
        self.open(query="?start=flock&points=30", plays=True)
        self.wait("live.clock > 0.3")
        self.evaluate("document.createElement('a').constructor.prototype.click = function() { window.saved = this.download; };"
                      " element('live-motions').click()")
        self.assertEqual(self.evaluate("window.saved"), "live.motions.csv")
        self.assertFalse(self.evaluate("live.isPlaying()"))
        self.assertIn(f"--until {self.evaluate('String(live.clock)')} --box 0,0,100,100",
                      self.evaluate("element('live-commands').innerText"))
        self.check_logs()

    def test_the_next_event_is_the_one_that_comes(self):
        self.open(self.points_file(), "--box", "0,0,60,60")
        for _ in range(30):
            self.wait("live.next !== undefined")
            said = self.evaluate("({...live.next, rows: live.recording.rows})")
            BROWSER.key("ArrowRight")
            row = self.evaluate("(({recording}, row) => ({kind: recording.kinds[recording.rowKind[row]],"
                                " time: recording.rowTime[row], lower: recording.rowLow[row],"
                                " upper: recording.rowHigh[row]}))(live, %d)" % said["rows"])
            self.assertEqual({key: said[key] for key in row}, row)
        self.check_present()

    def test_time_goes_back_and_on(self):
        self.open(self.points_file(), "--box", "0,0,60,60", plays=True)
        first = self.evaluate("kinetri.span[0]")
        self.wait("live.clock > 1")
        self.evaluate("live.togglePlaying(1)")
        now = self.evaluate("[kinetri.event, kinetri.edges()]")
        self.evaluate("kinetri.goTo(%r)" % first)
        self.assertEqual(self.evaluate("kinetri.event"), 0)
        self.assertFalse(self.evaluate("live.isPresent()"))
        self.evaluate("live.togglePlaying(-1); live.togglePlaying(1); live.changeSpeed(6)")
        self.wait("live.recording.rows > %d" % now[0])
        self.evaluate("live.togglePlaying(1)")
        self.check_present()
        self.evaluate("live.playback.goToEvent(%d)" % now[0])
        self.assertEqual(self.evaluate("kinetri.edges()"), now[1])

    def test_a_recording_that_is_too_long_begins_anew(self):
        self.open(self.points_file(), "--box", "0,0,60,60", plays=True)
        self.wait("live.recording.rows > 40")
        self.evaluate("live.direction = 0; live.beginAnew(); live.playback.goToEvent(live.recording.rows)")
        self.assertEqual(self.evaluate("live.recording.rows"), 0)
        self.evaluate("live.togglePlaying(1)")
        self.wait("live.recording.rows > 40")
        self.evaluate("live.direction = 0")
        self.check_present()

    def test_an_error_is_shown_and_the_points_stay(self):
        self.open(self.points_file("x,y,vx,vy\n1,1,0,0\n3,1,0,0\n2,3,0,0\n"), "--box", "0,0,4,4")
        self.evaluate("live.change(() => live.points.insert([9, 9]))")
        self.assertIn("box", self.evaluate("element('status').textContent"))
        self.assertEqual(self.evaluate("live.points.length"), 3)
        self.check_present()

    def test_an_address_that_asks_for_nonsense(self):
        self.open(query="?start=gas&points=-3", plays=True)
        self.assertIn("whole number from 1", self.evaluate("element('message').innerText"))
        self.assertEqual(self.evaluate("document.querySelector('#message a').search"), "")
        BROWSER.begin_page(1280, 800)
        self.open(query="?start=%3Cb%3E", plays=True)
        self.assertIn("unknown", self.evaluate("element('message').innerText"))
        for query, expected in (("radius=-1", "expected a number from 0 to 100"), ("gravity=up", "from -1000 to 1000"),
                                ("collisions=bounce", "is unknown; expected none, log")):
            BROWSER.begin_page(1280, 800)
            self.open(query=f"?start=gas&points=9&{query}", plays=True)
            self.assertIn(expected, self.evaluate("element('message').innerText"))

    def test_a_browser_without_webassembly(self):
        page = write_page(self.folder)
        page.write_text(page.read_text().replace("<body>", "<body><script>delete window.WebAssembly</script>", 1))
        BROWSER.go_to(page.resolve().as_uri())
        self.wait("!element('message').hidden")
        BROWSER.problems = []
        self.assertIn("has no WebAssembly", self.evaluate("element('message').innerText"))

    def test_a_phone(self):
        for width, height, least in ((390, 844, 250), (844, 390, 130)):
            with self.subTest(width=width):
                BROWSER.begin_page(width, height)
                self.open(query="?start=gas&points=50", plays=True)
                self.assertLessEqual(self.evaluate("document.documentElement.scrollWidth"), width)
                self.assertGreater(self.evaluate("element('picture').clientHeight"), least)
                # What the run says is seen, wherever the tools are scrolled to.
                for scrolled in (0, 10000):
                    self.evaluate(f"document.getElementById('live').scrollLeft = {scrolled}")
                    left, right, top, bottom = self.evaluate(
                        "(() => { const r = element('live-says').getBoundingClientRect();"
                        " return [r.left, r.right, r.top, r.bottom]; })()")
                    self.assertTrue(0 <= left < right <= width and 0 <= top < bottom <= height,
                                    (left, right, top, bottom))


if __name__ == "__main__":
    PROGRAM, VERIFY, name = sys.argv[1:4]
    if BROWSERS[name].executable() is None:
        print(f"skipped: there is no {name}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="kinetri-live-") as place:
        FOLDER = pathlib.Path(place)
        write_page(FOLDER)
        with BROWSERS[name]() as BROWSER:
            result = unittest.main(argv=[sys.argv[0], *sys.argv[4:]], exit=False).result
    sys.exit(0 if result.wasSuccessful() else 1)
