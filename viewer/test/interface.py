# SPDX-License-Identifier: GPL-3.0-or-later
"""Switches, keys, addresses, light and dark, narrow screens."""
import base64
import re
import subprocess
import time

import browser
import runs
from page import Page, edges


class Interface(Page):
    """Of one page: switches, keys, light and dark, narrow."""

    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("discs")
        self.open(self.run_.page)
        self.go_to(3.0)

    def test_each_switch_changes_the_picture_and_back(self):
        left, top, right, bottom = self.picture_box()
        for key, identifier in (("d", "delaunay"), ("h", "hull"), ("v", "voronoi"), ("o", "discs"),
                                ("c", "circle"), ("t", "trails"), ("a", "arrows"), ("m", "heat"),
                                ("u", "scale"), ("i", "ids")):
            with self.subTest(switch=identifier):
                # The pointer stays, since it has a circumcircle of its own.
                middle = ((left + right) / 2, (top + bottom) / 2)
                self.browser.move(*middle)
                pressed = f"document.getElementById('switch-{identifier}').ariaPressed"
                was = self.evaluate(pressed)
                # The button itself looks other when it is on: look below it.
                before = self.look()
                self.browser.key(key)
                self.assertNotEqual(self.evaluate(pressed), was)
                self.assertNotEqual(self.look(), before)
                self.browser.click_element(f"switch-{identifier}")
                self.browser.move(*middle)
                self.assertEqual(self.evaluate(pressed), was)
                self.assertEqual(self.look(), before)

    def test_voronoi_diagram_is_drawn(self):
        self.browser.key("v")
        self.assertGreater(self.look().counts().get(bytes.fromhex("009e73"), 0), 500)

    def test_keys(self):
        state = "[kinetri.time, kinetri.event]"
        instants = self.run_.instants()
        at = [i for i, instant in enumerate(instants) if instant[0][2] <= 3.0][-1]
        self.browser.key("ArrowRight")
        self.assertEqual(self.evaluate(state), [instants[at + 1][0][2], instants[at + 1][1]])
        self.browser.key("ArrowLeft")
        self.assertEqual(self.evaluate(state), [instants[at][0][2], instants[at][1]])
        self.play(" ", 1)
        self.play("b", -1)
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.key("+")
        larger = self.evaluate(scale)
        self.assertGreater(larger, was)
        self.browser.key("-")
        self.browser.key("-")
        self.assertLess(self.evaluate(scale), was)
        self.browser.key("f")
        self.assertEqual(self.evaluate(scale), was)
        speed = "parseFloat(document.getElementById('speed').textContent)"
        slow = self.evaluate(speed)
        self.browser.key("ArrowUp")
        self.assertGreater(self.evaluate(speed), slow)
        self.browser.key("ArrowDown")
        self.assertEqual(self.evaluate(speed), slow)
        self.browser.key("?")
        self.assertTrue(self.evaluate("document.getElementById('help').open"))
        self.browser.key("Escape")
        self.assertFalse(self.evaluate("document.getElementById('help').open"))

    def play(self, key, direction):
        before = self.evaluate("kinetri.time")
        self.browser.key(key, code="Space" if key == " " else None)
        deadline = time.monotonic() + browser.SECONDS
        while (self.evaluate("kinetri.time") - before) * direction <= 0:
            self.assertLess(time.monotonic(), deadline, f"'{key}' does not play")
        self.browser.key(key)
        self.assertTrue((self.evaluate("kinetri.time") - before) * direction > 0)
        now = self.evaluate("kinetri.time")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.time"), now, f"'{key}' does not pause")
        self.assertEqual(edges(self.evaluate("kinetri.edges()")),
                         [e for t, _, e in self.run_.instants() if t[2] <= now][-1])

    def test_wheel_and_drag(self):
        left, top, right, bottom = self.picture_box()
        x, y = (left + right) // 2, (top + bottom) // 2
        place = "kinetri.screen(0, 0)"
        before = self.evaluate(place)
        self.drag(80, 40)
        after = self.evaluate(place)
        self.assertAlmostEqual(after[0] - before[0], 80, 6)
        self.assertAlmostEqual(after[1] - before[1], 40, 6)
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-120)
        deadline = time.monotonic() + browser.SECONDS
        while self.evaluate(scale) <= was:
            self.assertLess(time.monotonic(), deadline, "the wheel does not zoom")

    def test_pinch(self):
        left, top, right, bottom = self.picture_box()
        x, y = (left + right) / 2, (top + bottom) / 2
        scale = "kinetri.screen(1, 0)[0] - kinetri.screen(0, 0)[0]"
        was = self.evaluate(scale)
        self.browser.pinch(x, y, 50, 100)
        self.browser.settle()
        # Twice as far apart, but for the first pixels, in which it might be a click.
        self.assertGreater(self.evaluate(scale), 1.5 * was)
        self.assertLess(self.evaluate(scale), 2.1 * was)

    def test_scrub_bar_and_list(self):
        self.evaluate("(() => { const bar = document.getElementById('scrub'); bar.value = 0.5;"
                      " bar.dispatchEvent(new Event('input')); })()")
        self.browser.settle()
        self.assertEqual(self.evaluate("kinetri.time"), self.run_.until / 2)
        here = self.evaluate("kinetri.event")
        row = self.evaluate("document.querySelector('.row.future:not([hidden])').dataset.row")
        self.assertEqual(int(row), here)
        self.evaluate("document.querySelector('.row.future:not([hidden])').click()")
        self.browser.settle()
        instant = next(instant for instant in self.run_.instants() if instant[1] > here)
        self.assertEqual(self.evaluate("[kinetri.time, kinetri.event]"), [instant[0][2], instant[1]])
        self.assertEqual(self.evaluate("document.querySelectorAll('.row.present:not([hidden])').length > 0"), True)

    def test_hover_says_where_a_point_is(self):
        place = self.evaluate("kinetri.positions()")[7]
        self.browser.move(*self.evaluate(f"kinetri.screen({place[0]!r}, {place[1]!r})"))
        text = self.evaluate("document.getElementById('tip').textContent")
        self.assertFalse(self.evaluate("document.getElementById('tip').hidden"))
        self.assertIn("Point 7", text)
        numbers = text.replace("\u2212", "-").split("position")[1].split("(")[1].split(")")[0].split(",")
        for found, wanted in zip(numbers, place):
            self.assertEqual(float(found), float(f"{wanted:.7g}"))

    def test_dark_and_light(self):
        light = self.look()
        self.browser.media(("prefers-color-scheme", "dark"), ("prefers-reduced-motion", "reduce"))
        self.browser.settle()
        dark = self.look()
        self.assertLess(max(dark.most_frequent()), 80)
        self.assertGreater(min(light.most_frequent()), 200)
        self.browser.click_element("button-theme")
        self.browser.move(5, 5)
        self.assertEqual(self.look(), light)

    def test_a_kind_has_one_color(self):
        """On all pages that of its table: of the switches of kinds, the signs in the list, the timeline, the legend."""
        colors = {}
        for name in ("discs", "uniform", "vanishing", "sizes", "lattice"):
            page = self.run_of(name).page
            events = runs.recording_of(page)["events"]
            self.browser.open(page, "#t=0")
            seen = self.evaluate(r"""(() => {
              const rgb = (text) => text.startsWith('#') ? text :
                '#' + text.match(/\d+/g).slice(0, 3).map((c) => Number(c).toString(16).padStart(2, '0')).join('');
              const kindOf = (text) => text.replace(/ \d+$/, '').replace(/ /g, '_');
              const found = [];
              for (const chip of document.querySelectorAll('#kinds button')) {
                found.push(['chip', kindOf(chip.textContent), rgb(getComputedStyle(chip, '::before').backgroundColor)]);
              }
              for (const row of document.querySelectorAll('.row:not([hidden])')) {
                found.push(['sign', kindOf(row.querySelector('.what span').textContent),
                            rgb(getComputedStyle(row.querySelector('.glyph')).color)]);
              }
              return found;
            })()""")
            self.assertGreater(len(seen), 2)
            for what, kind, color in seen:
                self.assertEqual(color, events["colors"][events["kinds"].index(kind)], (name, what))
                self.assertEqual(colors.setdefault(kind, color), color, (name, what))
            # The timeline has columns of one kind each in the colors of the kinds that the run has, and of no other.
            pixels = {f"#{r:02x}{g:02x}{b:02x}" for r, g, b in self.evaluate("""(() => {
              const canvas = document.getElementById('histogram');
              const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
              const seen = new Map();
              for (let i = 0; i < data.length; i += 4) {
                if (data[i + 3] === 255) seen.set(data.slice(i, i + 3).join(), [...data.slice(i, i + 3)]);
              }
              return [...seen.values()];
            })()""")}
            numbers = set(base64.b64decode(events["kind"]))
            self.assertLessEqual(pixels, {events["colors"][number] for number in numbers})
            self.assertIn(events["colors"][max(numbers, key=list(base64.b64decode(events["kind"])).count)], pixels)
            # Where the list is not seen, the legend says what the colors of the timeline are.
            self.browser.open(page, "#t=0&list=off&legend=on")
            marks = self.evaluate("""[...document.querySelectorAll('#legend-lines li')].filter((item) =>
              item.textContent.endsWith(' on the timeline')).map((item) => item.querySelector('i').style.background)""")
            self.assertEqual({"#" + "".join(f"{int(c):02x}" for c in re.findall(r"\d+", mark)) for mark in marks},
                             {events["colors"][number] for number in numbers})
        self.assertGreater(len(colors), 5)

    def test_buttons_have_plain_names(self):
        titles = self.evaluate("[...document.querySelectorAll('#viewer > header button')].map((e) => e.title)")
        self.assertEqual(titles, ["Find a point by id or name (/)", "Export a picture, a film or a link (S)",
                                  "Switch between light and dark (L)", "Help: keys and pointer (?)",
                                  "Show or hide the list of events (E)"])

    def test_address(self):
        """A fragment of the address does what clicks and keys do, and reports what is not possible."""
        note = "document.getElementById('address-note')"

        def follow(fragment):
            self.evaluate(f"void (location.hash = '{fragment}')")
            self.browser.settle()
            return self.evaluate(f"{note}.hidden ? '' : {note}.textContent")

        self.browser.move(5, 5)
        start = self.look()
        a, b = self.evaluate("kinetri.edges()")[7]
        self.assertEqual(follow(f"t=3&show=voronoi,trails&hide=hull&edge={b}-{a}&theme=dark"), "")
        self.assertEqual(self.evaluate("kinetri.time"), 3)
        switch = "document.getElementById('switch-%s').ariaPressed"
        self.assertEqual([self.evaluate(switch % name) for name in ("voronoi", "trails", "hull")],
                         ["true", "true", "false"])
        self.assertEqual(self.evaluate("document.getElementById('certificate-title').textContent"),
                         f"Edge {a}\u2013{b}")
        self.assertLess(max(self.look().most_frequent()), 80)
        self.browser.click_element("button-close")
        self.assertEqual(follow("show=hull&hide=voronoi,trails&theme=light"), "")
        self.browser.move(5, 5)
        self.assertEqual(self.look(), start)
        for state in ("off", "on"):
            self.assertEqual(follow(f"list={state}"), "")
            self.assertEqual(self.evaluate("document.getElementById('events').hidden"),
                             state == "off")
        for number in (5, 0, len(self.run_.events)):
            self.assertEqual(follow(f"event={number}"), "")
            self.assertGreaterEqual(self.evaluate("kinetri.event"), number)
        count = self.evaluate("kinetri.counts.rows")
        switches = "of delaunay, hull, voronoi, circle, discs, trails, arrows, heat, scale, axes, ids"
        edge = "the ids of two points that an edge joins at that time, as in 4-17"
        problems = {
            "t=x": "t: 'x' is not possible; expected a number",
            "t=": "t: '' is not possible; expected a number",
            "event=1000000":
                f"event: '1000000' is not possible; expected a whole number from 0 to {count}",
            "event=-1": f"event: '-1' is not possible; expected a whole number from 0 to {count}",
            "show=wave": f"show: 'wave' is not possible; expected {switches}",
            "hide=wave": f"hide: 'wave' is not possible; expected {switches}",
            "edge=0-0": f"edge: '0-0' is not possible; expected {edge}",
            "edge=x": f"edge: 'x' is not possible; expected {edge}",
            "draw=ink": "draw: 'ink' is not possible; expected webgl, where the browser has it, or canvas",
            "point=1000": "point: '1000' is not possible; expected the id or the name of a point",
            "color=blue": "color: 'blue' is not possible; expected none or one of area, density, "
                          "speed, degree, changes",
            "at=1,2": "at: '1,2' is not possible; expected two coordinates and a width, as in 10,20,5",
            "theme=blue&list=maybe": "theme: 'blue' is not possible; expected light or dark, and "
                                     "list: 'maybe' is not possible; expected on or off",
            "speed=1": "'speed' is unknown; expected t, event, show, hide, edge, point, follow, color, at, "
                       "kinds, unit, legend, play, theme, list, draw"}
        for wrong, problem in problems.items():
            self.assertEqual(follow(wrong),
                             "The address of this page asks for something that is not possible: "
                             f"{problem}.")
        self.assertEqual(follow("t=1"), "")

    def test_address_of_a_page_that_is_opened(self):
        self.browser.open(self.run_.page, "#t=2.25&show=trails")
        self.assertEqual(self.evaluate("kinetri.time"), 2.25)
        self.assertEqual(self.evaluate("document.getElementById('switch-trails').ariaPressed"), "true")

    def test_a_view_that_the_program_was_asked_for(self):
        """--html-view is followed, unless the address asks for something; the program and the page know the
        same words."""
        source = self.folder / "discs.csv"
        page = self.folder / "view.html"
        runs.execute(self.program, "simulate", source, "--until", 2, "--html", page, "--quiet",
                     "--html-view", "t=1.25&color=speed&theme=dark&point=4")
        self.open(page)
        state = "[kinetri.time, kinetri.point, kinetri.colored()?.id ?? null]"
        self.assertEqual(self.evaluate(state), [1.25, 4, "speed"])
        self.browser.open(page, "#t=0.5")
        self.assertEqual(self.evaluate(state), [0.5, None, None])
        self.evaluate("void (location.hash = 'x=1')")
        self.browser.settle()
        known = self.evaluate("document.getElementById('address-note').textContent").split("expected ")[1]
        done = subprocess.run([self.program, "simulate", source, "--until", "1", "--html", page, "--html-view",
                               "x=1"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        wanted = known.rstrip(".").split(", ")
        found = done.stderr.split("expected ")[1].splitlines()[0].split(", ")
        self.assertEqual(sorted(found), sorted(wanted))

    def test_narrow_screens_have_room_for_everything(self):
        self.browser.resize(360, 640, 2)
        self.browser.settle()
        self.assertEqual(self.evaluate("[document.documentElement.scrollWidth, "
                                       "document.documentElement.scrollHeight]"), [360, 640])
        for button in ("play", "next", "previous", "faster", "help", "list", "fit"):
            box = self.evaluate(f"document.getElementById('button-{button}').getBoundingClientRect()"
                                ".toJSON()")
            self.assertTrue(0 <= box["left"] and box["right"] <= 360 and 0 <= box["top"] and
                            box["bottom"] <= 640, (button, box))
        self.assertGreater(self.evaluate("document.getElementById('picture').clientHeight"), 200)

    def test_controls_have_names(self):
        self.assertEqual(self.evaluate(
            "[...document.querySelectorAll('button, input, canvas:not([aria-hidden])')]"
            ".filter((e) => !e.hidden && !(e.ariaLabel || e.textContent.trim() || e.labels?.length)"
            " && !['plot', 'area-plot'].includes(e.id)).map((e) => e.outerHTML)"), [])
