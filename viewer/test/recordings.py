# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings in which there is little, and damaged ones."""
import base64
import json

import runs
from page import STEPS, Page, edges


def cut(text, count):
    """The base64 text without its last bytes."""
    return base64.b64encode(base64.b64decode(text)[:-count]).decode()


class Small(Page):
    """Recordings in which there is little, or nothing."""

    def check(self, name, points, until, count, *options):
        file = self.folder / f"{name}.csv"
        self.folder.mkdir(parents=True, exist_ok=True)
        file.write_text("x,y,vx,vy\n" + points)
        page = file.with_suffix(".html")
        runs.execute(self.program, "simulate", file, "--until", until, "--html", page, "--quiet", *options)
        self.open(page)
        self.assertEqual(self.evaluate("kinetri.counts.points"), count)
        for key in "vctdhiofnamukkkkkkgp]jr":
            self.browser.key(key)
        self.assertTrue(self.evaluate("kinetri.screen(0, 0).every(Number.isFinite)"))
        left, top, right, bottom = self.picture_box()
        self.browser.click((left + right) / 2, (top + bottom) / 2)
        self.browser.key("End")
        self.browser.key("ArrowLeft")
        self.browser.key("Home")
        self.browser.key(" ")
        self.browser.settle()
        return self.evaluate("kinetri.edges()")

    def test_no_point(self):
        self.assertEqual(self.check("none", "", 1, 0), [])

    def test_one_point(self):
        self.assertEqual(self.check("one", "3,4,1,0\n", 1, 1), [])

    def test_two_points(self):
        self.assertEqual(self.check("two", "3,4,1,0\n5,6,0,1\n", 1, 2), [[0, 1]])

    def test_points_on_a_line(self):
        found = self.check("line", "0,0,1,1\n2,2,0,0\n4,4,-1,-1\n7,7,0,0\n", 1, 4)
        self.assertEqual(len(found), 3)

    def test_no_event(self):
        found = self.check("rest", "0,0,0,0\n4,0,0,0\n0,3,0,0\n9,9,0,0\n", 1, 4)
        self.assertEqual(len(found), 5)

    def test_no_time(self):
        self.assertEqual(len(self.check("instant", "0,0,1,0\n4,0,0,0\n0,3,0,1\n", 0, 3)), 3)

    def test_points_on_a_line_have_no_triangles(self):
        self.check("line", "0,0,1,1\n2,2,0,0\n4,4,-1,-1\n7,7,0,0\n", 1, 4)
        self.assertEqual(self.evaluate("kinetri.triangles()"), [])

    def test_triangles_that_change_without_an_event(self):
        """Points pass each other on the hull: no edge changes, but triangles do, at exactly t = 1."""
        run = self.run_of("passing")
        self.assertEqual(run.events, [])
        self.open(run.page)
        seen = self.evaluate(STEPS.replace("DIRECTION", "stepForward"))
        self.assertEqual([(t, n) for t, n, _, _ in seen], [(0, 0), (1, 1)])
        for (_, _, found, triangles), when in zip(seen, (0.5, 1.5)):
            self.assertEqual(edges(found), run.initial)
            self.assertEqual(runs.check_combinatorics(run.initial, triangles), "")
            self.assertTrue(runs.is_delaunay(run, triangles, when))
        self.assertNotEqual(seen[0][3], seen[1][3])
        self.assertEqual(self.evaluate("document.getElementById('row-0').innerText").split("\n"),
                         ["\u21bb", "rebuild", "triangles change, edges do not", "1", "row 0"])
        self.go_to(0.5)
        self.assertEqual(self.evaluate("kinetri.triangles()"), seen[0][3])
        # The triangle above the edge 0-1 is 0 1 2 until then, 0 1 3 afterwards.
        self.browser.open(run.page, "#t=0.5&edge=0-1")
        facts = "document.getElementById('certificate-facts').innerText"
        self.assertIn("its corners change before it fails, rebuild row 0", self.evaluate(facts))
        self.go_to(1.5)
        self.assertIn("its corners changed with rebuild row 0", self.evaluate(facts))

    def test_large_numbers(self):
        points = "-1e300,0,1,0\n1e300,0,0,0\n0,1e300,0,1\n0,-1e-300,0,0\n"
        self.assertEqual(len(self.check("large", points, 1, 4)), 5)


class Damaged(Page):
    """A damaged recording is named, and nothing else happens."""

    def setUp(self):
        super().setUp()
        self.page = self.run_of("uniform").page
        self.recording = runs.recording_of(self.page)

    def check(self, text, expected):
        target = self.folder / "damaged.html"
        runs.with_recording(self.page, text, target)
        self.browser.open(target)
        self.assertTrue(self.evaluate("document.getElementById('viewer').hidden"))
        self.assertFalse(self.evaluate("document.getElementById('message').hidden"))
        message = self.evaluate("document.getElementById('message').innerText")
        self.assertIn("This recording is damaged", message)
        self.assertIn(expected, message)

    def damage(self, expected, **members):
        self.check(json.dumps({**self.recording, **members}), expected)

    def test_not_json(self):
        self.check("{", "not JSON")

    def test_cut_off(self):
        text = json.dumps(self.recording)
        self.check(text[:len(text) // 2], "not JSON")

    def test_other_format(self):
        self.damage("format is 1", format=1)

    def test_lists(self):
        events, motions = self.recording["events"], self.recording["motions"]
        self.damage("not base64", initial_edges="AAA*")
        self.damage("is not there", initial_edges=None)
        self.damage("events are not there", events=None)
        self.damage("times of them", events={**events, "time": cut(events["time"], 8)})
        self.damage("within a number", events={**events, "time": cut(events["time"], 1)})
        self.damage("the ids of event", events={**events, "ids": cut(events["ids"], 2)})
        self.damage("without a name", events={**events, "kinds": [], "colors": []})
        for colors in (None, events["colors"][:-1], ["blue", *events["colors"][1:]]):
            self.damage("have no colors", events={**events, "colors": colors})
        self.damage("places of them", motions={**motions, "data": cut(motions["data"], 40)})

    def test_wrong_coincidences(self):
        right = {"count": 1, "starting": 1, "event": "AAAAAA==", "point": "AQA=", "shown": "AAA="}
        damage = lambda expected, **members: self.damage(expected, coincidences={**right, **members})
        damage("1 coincidences, but 0 events", event="")
        damage("coincidences are those of the start", starting=2)
        damage("coincidence 0 is at a wrong event", starting=0, event="//8AAA==")
        damage("coincidence 0 is at a wrong event", starting=0, event="/////w==")
        damage("coincidence 0 is of a point that is not there", point="//8=")

    def test_wrong_edges(self):
        self.damage("the ids end with 3", points=4)
        there = self.recording["triangles"]["initial"]
        self.assertEqual(self.recording["initial_edges"], "", "an edge without a triangle")
        one_id, one_edge = (base64.b64encode(base64.b64decode(there)[:n]).decode() for n in (2, 4))
        self.damage("within an edge", initial_edges=one_id)
        self.damage("is twice", initial_edges=one_edge)
        self.damage("which is not there then", triangles={**self.recording["triangles"],
                                                          "initial": cut(there, 120)})

    def test_wrong_triangles(self):
        triangles = self.recording["triangles"]
        self.assertGreater(triangles["count"], 1)
        damage = lambda expected, **members: self.damage(expected, triangles={**triangles, **members})
        self.damage("triangles are not there", triangles=None)
        damage("within a triangle", initial=cut(triangles["initial"], 2))
        twice = base64.b64decode(triangles["initial"])
        twice = base64.b64encode(twice + twice[:6]).decode()
        damage("the start adds the triangle", initial=twice)
        damage("numbers of triangles of them", count=triangles["count"] + 1)
        damage("corners of", ids=cut(triangles["ids"], 6))
        ids = base64.b64decode(triangles["ids"])
        turned = base64.b64encode(ids[2:4] + ids[:2] + ids[4:]).decode()
        damage("triangle", ids=turned)
        rows = base64.b64decode(triangles["event"])
        damage("not in order", event=base64.b64encode(rows[4:8] + rows[:4] + rows[8:]).decode())
        last = (10 ** 6).to_bytes(4, "little")
        damage("triangle", event=base64.b64encode(rows[:-4] + last).decode())
        # Without the changes on the hull, a flip there does not fit.
        damage("not the other diagonal", count=0, event="", removed="", added="", ids="")

    def test_times(self):
        self.damage("not two numbers in order", until=-1)
        self.damage("not two numbers in order", until="soon")
