# SPDX-License-Identifier: GPL-3.0-or-later
"""Clicks on edges, which show their certificates."""
import fractions
import itertools

import browser
import runs
from page import Page, edges


SUBSCRIPTS = "\u2080\u2081\u2082\u2083\u2084\u2085\u2086\u2087\u2088\u2089"


class Certificate(Page):
    """Clicks on edges that a flip, a hull event, or nothing removes."""

    def setUp(self):
        super().setUp()
        self.open_run("uniform")

    def open_run(self, name):
        self.run_ = self.run_of(name)
        self.open(self.run_.page)

    def place_of(self, edge):
        places = self.evaluate("kinetri.positions().map((p) => kinetri.screen(...p))")
        (ax, ay), (bx, by) = places[edge[0]], places[edge[1]]
        return (ax + bx) / 2, (ay + by) / 2, places

    def is_clear(self, edge):
        """Whether the middle of the edge is nearer than all others to a click there."""
        x, y, places = self.place_of(edge)
        for other in self.evaluate("kinetri.edges()"):
            if tuple(other) == edge:
                continue
            (ax, ay), (bx, by) = places[other[0]], places[other[1]]
            length = max((bx - ax) ** 2 + (by - ay) ** 2, 1e-9)
            share = min(max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length, 0), 1)
            if (ax + share * (bx - ax) - x) ** 2 + (ay + share * (by - ay) - y) ** 2 < 5 ** 2:
                return False
        return True

    def removals(self, kind):
        """Events of the kind with an edge that is removed and can be clicked some time before, and
        is in the end removed because that certificate fails; the page is there."""
        for i, event in enumerate(self.run_.events):
            if event.kind != kind:
                continue
            before = self.run_.events[i - 1].time[2] if i > 0 else 0.0
            for when in (before, event.time[0] - 0.2, event.time[0] - 0.6):
                self.go_to(max(when, 0.0))
                there = edges(self.evaluate("kinetri.edges()"))
                if event.removed in there and self.is_clear(event.removed):
                    self.click(event.removed)
                    if self.evaluate("document.getElementById('interval') !== null"):
                        yield event
                        break

    def click(self, edge):
        x, y, _ = self.place_of(edge)
        self.browser.click(x, y)
        self.assertFalse(self.evaluate("document.getElementById('certificate').hidden"))
        title = self.evaluate("document.getElementById('certificate-title').textContent")
        self.assertEqual(title, f"Edge {edge[0]}\u2013{edge[1]}")

    def check_removal(self, kind, degree, least):
        checked = 0
        for event in self.removals(kind):
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            interval = self.evaluate("document.getElementById('interval').textContent")
            found = [float(number) for number in interval.strip("[]").split(",")]
            self.assertEqual(found, sorted(set(event.time[1:])))
            self.assertIn(f"{kind.replace('_', ' ')} #{event.number}", text)
            self.assertIn("the certificate is zero there" if len(found) == 1 else
                          "positive at the lower one, negative at the upper one", text)
            self.assertLessEqual(int(text.split("Degree\n")[1].split()[0]), degree)
            checked += 1
            if checked == least:
                break
        self.assertGreaterEqual(checked, least, "too few edges that can be clicked")

    def test_flips(self):
        self.check_removal("flip", 4, 8)

    def test_coefficients(self):
        for name in ("uniform", "accelerated", "square", "sizes"):
            self.open_run(name)
            for event in itertools.islice(self.removals("flip"), 4):
                says = self.evaluate("document.getElementById('certificate-says').textContent")
                corners = [int(id) for id in says.split("in-circle(")[1].split(")")[0].split(",")]
                self.assertEqual(set(corners[:2]), set(event.removed))
                self.assertEqual(set(corners[2:]), set(event.added))
                digits = self.evaluate("[...document.querySelectorAll('#certificate-facts .digits')]"
                                       ".slice(-2).map((e) => e.textContent)")
                found = [float(line.split()[1]) for line in digits[1].splitlines()]
                self.assertEqual(found,
                                 [float(c) for c in runs.delaunay_polynomial(self.run_, corners, float(digits[0]))])

    def table(self):
        """The columns of the Sturm sequence by their names: texts from the top to V."""
        rows = self.evaluate("[...document.getElementById('sturm').rows].map("
                             "(row) => [...row.cells].map((cell) => cell.textContent))")
        return {column[0]: list(column[1:]) for column in zip(*rows)}

    def says(self):
        return self.evaluate("document.getElementById('sturm-says').textContent")

    def test_sturm_sequences_are_those_of_fractions(self):
        touches = 0
        for name, count in (("uniform", 6), ("accelerated", 3), ("square", 1), ("sizes", 4)):
            self.open_run(name)
            for event in itertools.islice(self.removals("flip"), count):
                says = self.evaluate("document.getElementById('certificate-says').textContent")
                corners = [int(id) for id in says.split("in-circle(")[1].split(")")[0].split(",")]
                origin = float(self.evaluate("[...document.querySelectorAll('#certificate-facts .digits')]"
                                             ".at(-2).textContent"))
                terms = runs.sturm_sequence(runs.delaunay_polynomial(self.run_, corners, origin))
                times = {"now": self.evaluate("kinetri.time"), "\u221e": float("inf")}
                ends = sorted(set(event.time[1:]))
                times.update(zip(("end",) if len(ends) == 1 else ("lower", "upper"), ends))
                table = self.table()
                self.assertEqual(table.pop(""), [
                    "f" + "".join(SUBSCRIPTS[int(digit)] for digit in str(k + 1)) for k in range(len(terms))] + ["V"])
                self.assertEqual(table.pop("degree"), [str(len(term) - 1) for term in terms] + [""])
                self.assertEqual(set(table), set(times))
                changes = {}
                for column, t in times.items():
                    signs = runs.signs(terms, t if t == float("inf") else
                                       fractions.Fraction(t) - fractions.Fraction(origin))
                    self.assertEqual(table[column][:-1], ["0+\u2212"[sign] for sign in signs], (name, column))
                    kept = [sign for sign in signs if sign]
                    changes[column] = sum(a != b for a, b in zip(kept, kept[1:]))
                    if len(terms[-1]) == 1:
                        self.assertEqual(table[column][-1], str(changes[column]), (name, column))
                if len(ends) == 2:
                    self.assertEqual(changes["lower"] - changes["upper"], 1)
                    self.assertIn("V(lower) \u2212 V(upper) = 1: exactly one root", self.says())
                    touches += changes["now"] - changes["lower"]
                    self.assertIn(f"V(now) \u2212 V(lower) = {changes['now'] - changes['lower']}: ", self.says())
        self.assertEqual(touches, 0)

    def open_edge(self, name, t):
        self.browser.open(self.run_of(name).page, f"#t={t}&edge=0-1")

    def test_a_touch_is_no_event(self):
        self.assertEqual([event.time[0] for event in self.run_of("touching").events if event.kind == "flip"], [2.0])
        self.open_edge("touching", 0)
        self.assertEqual(self.table(), {
            "": [*"f\u2081 f\u2082 f\u2083 V".split()], "degree": ["3", "2", "1", ""], "now": ["+", "\u2212", "+", "2"],
            "end": ["0", "\u2212", "\u2212", "0"], "\u221e": ["\u2212", "\u2212", "\u2212", "0"]})
        self.assertIn("V(now) \u2212 V(end) = 2: the failure itself, and one touch before the failure.", self.says())
        self.assertIn("root of multiplicity 1, odd: the failure", self.says())
        self.assertIn("a touch is no event", self.says())
        self.go_to(1)  # all terms are zero; V is right
        self.assertEqual(self.table()["now"], ["0", "0", "0", "1"])
        self.assertIn("V(now) \u2212 V(end) = 1: the failure itself, and no root before the failure.", self.says())

    def test_a_triple_root_is_an_event(self):
        self.open_edge("triple", 0)
        self.assertEqual(self.table()["end"], ["0", "0", "0"])
        self.assertIn("root of multiplicity 3, odd: the failure", self.says())

    def test_points_that_stay_cocircular_have_another_determinant(self):
        self.open_edge("cocircular", 0)
        if self.evaluate("document.getElementById('certificate').hidden"):  # the other diagonal
            self.browser.open(self.run_of("cocircular").page, "#t=0&edge=2-3")
        facts = self.evaluate("document.getElementById('certificate').textContent")
        self.assertIn("the in-circle determinant is zero at all times; with x\u00b2 in its last column", facts)
        self.assertEqual(self.table()["now"][0], "+")
        self.assertIn("it never fails", self.says())

    def test_an_edge_that_never_fails(self):
        self.open_edge("touching", 2.25)
        for edge in self.evaluate("kinetri.edges()"):
            self.browser.open(self.run_of("touching").page, f"#t=2.25&edge={edge[0]}-{edge[1]}")
            table = self.table()
            if set(table) == {"", "degree", "now", "\u221e"}:
                roots = int(table["now"][-1]) - int(table["\u221e"][-1])
                self.assertIn(f"V(now) \u2212 V(\u221e) = {roots}: with these motions it", self.says())
                self.assertEqual("never fails" in self.says(), roots == 0)
                return
        self.fail("no such edge")

    def test_hull_edges(self):
        self.open_run("box")
        self.check_removal("hull_insert", 2, 3)

    def test_accelerated_points(self):
        self.open_run("accelerated")
        self.check_removal("flip", 12, 6)

    def test_edges_of_a_point_that_is_hidden(self):
        self.open_run("sizes")
        self.check_removal("flip", 4, 3)
        self.check_removal("rebuild", 4, 1)
        self.assertIn("the power to", self.evaluate("document.getElementById('certificate-says').textContent"))

    def test_times_that_are_numbers(self):
        self.open_run("square")
        self.assertEqual([event.time for event in self.run_.events], [(1.0, 1.0, 1.0)])
        self.check_removal("flip", 2, 1)

    def test_corners_that_change(self):
        """Of an edge that is removed after its corners have changed, the first change is named."""
        for i, event in enumerate(self.run_.events):
            self.go_to(max(event.time[0] - 1, 0.0))
            there = edges(self.evaluate("kinetri.edges()"))
            if event.kind != "flip" or event.removed not in there or not self.is_clear(event.removed):
                continue
            self.click(event.removed)
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            if "its corners change before it fails" not in text:
                continue
            change = text.split("before it fails, ")[1].split()
            number = int(next(word for word in change if word.startswith("#"))[1:])
            self.assertLess(number, event.number)
            self.assertIn(f"later, by flip #{event.number}", text)
            ends = set(event.removed)
            changed = self.run_.events[number]
            self.assertTrue(ends & set((changed.removed or ()) + (changed.added or ())))
            self.go_to(changed.time[2])  # to the next certificate
            text = self.evaluate("document.getElementById('certificate-facts').innerText")
            self.assertIn(f"its corners changed with {changed.kind.replace('_', ' ')} #{number}", text)
            return
        self.fail("no such edge")

    def test_it_follows_time_and_closes(self):
        event = next(self.removals("flip"))
        sign = "document.querySelector('#certificate-facts dd').textContent"
        self.assertTrue(self.evaluate(sign).startswith("positive"))
        self.go_to(event.time[2])
        self.assertTrue(self.evaluate(sign).startswith("negative"), self.evaluate(sign))
        self.assertIn("not there", self.evaluate("document.getElementById('certificate-says').textContent"))
        self.browser.key("Escape")
        self.assertTrue(self.evaluate("document.getElementById('certificate').hidden"))

    def test_the_plot_is_drawn(self):
        next(self.removals("flip"))  # clicks its edge
        box = self.evaluate("document.getElementById('plot').getBoundingClientRect().toJSON()")
        area = tuple(round(box[side]) for side in ("left", "top", "right", "bottom"))
        counts = browser.Picture(self.browser, self.browser.screenshot(area)).counts()
        curve = bytes.fromhex("0072b2")
        self.assertGreater(counts.get(curve, 0), 100)
