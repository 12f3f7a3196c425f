# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page exports: PNG, SVG, WebM, and links."""
import base64
import re
import subprocess
import time
import xml.etree.ElementTree as ElementTree

import browser
from page import Page

SVG = "{http://www.w3.org/2000/svg}"
# The bytes of what is saved, in the place of a download.
CATCH = """void (() => {
  window.caught = [];
  URL.createObjectURL = (blob) => {
    caught.push(blob);
    return '#';
  };
})()"""
BYTES = """(async () => {
  const bytes = new Uint8Array(await caught[caught.length - 1].arrayBuffer());
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
})()"""


class Exporting(Page):
    def setUp(self):
        super().setUp()
        self.run_ = self.run_of("uniform")
        self.open(self.run_.page)
        self.go_to(3.0)

    def saved(self, button):
        self.evaluate(CATCH)
        self.browser.key("s")
        self.browser.click_element(button)
        deadline = time.monotonic() + browser.SECONDS
        while self.evaluate("caught.length") == 0:
            self.assertLess(time.monotonic(), deadline, "nothing is saved")
        data = base64.b64decode(self.evaluate(BYTES))
        self.browser.key("Escape")
        return data

    def test_png(self):
        self.evaluate("void (location.hash = 'color=area')")
        self.browser.settle()
        picture = browser.Picture(self.browser, self.saved("save-png"))
        box = self.picture_box()
        self.assertEqual(picture.size(), (2 * (box[2] - box[0]), 2 * (box[3] - box[1])))
        self.assertGreater(len(picture.counts()), 50)

    def test_svg(self):
        self.evaluate("void (location.hash = 'show=ids,axes&hide=hull&unit=km')")
        self.browser.settle()
        root = ElementTree.fromstring(self.saved("save-svg").decode())
        lines = circles = 0
        for path in root.iter(SVG + "path"):
            if path.get("stroke") is None:
                circles += path.get("d").count("A") // 2
            else:
                lines += path.get("d").count("L")
        self.assertEqual(circles, 40)
        self.assertGreaterEqual(lines, len(self.evaluate("kinetri.edges()")))
        texts = {text.text for text in root.iter(SVG + "text")}
        self.assertGreater(len(texts), 15)
        self.assertIn("km", texts)
        self.assertTrue({"0", "20", "\u221220"} <= texts)
        ids = {text for text in texts if text.isdigit() and int(text) < 40}
        self.assertGreater(len(ids), 15)

    def test_kinetri_render_draws_what_the_page_shows(self):
        scale = ["#" + "".join(f"{int(part):02x}" for part in re.findall(r"\d+", color))
                 for color in self.evaluate("kinetri.scale()")]
        for quantity in ("area", "density", "speed", "degree", "changes"):
            self.evaluate(f"void (location.hash = 'color={quantity}&t=3')")
            self.browser.settle()
            shades = self.evaluate("kinetri.colored().shades")
            areas = self.evaluate("kinetri.areas()")
            picture = subprocess.run([self.program, "render", self.run_.page, "--at", "3", "--output", "-", "--view",
                                      f"color={quantity}"], capture_output=True, text=True, check=True).stdout
            root = ElementTree.fromstring(picture)
            cells = next(group for group in root.iter(SVG + "g") if group.get("class") == "colors")
            self.assertEqual([path.get("fill") for path in cells],
                             [scale[shade] for shade, area in zip(shades, areas) if area is not None], quantity)
            edges = next(path for path in root.iter(SVG + "path") if path.get("class") == "edges")
            self.assertEqual(edges.get("d").count("M"), len(self.evaluate("kinetri.edges()")))

    def test_webm(self):
        self.evaluate("document.getElementById('film-seconds').value = 1")
        self.evaluate("document.getElementById('film-from').value = 2")
        self.evaluate("document.getElementById('film-until').value = 2.5")
        data = self.saved("save-film")
        self.assertEqual(data[:4], b"\x1a\x45\xdf\xa3")  # EBML
        self.assertGreater(len(data), 2000)
        self.assertEqual(self.evaluate("kinetri.time"), 2.5)

    def test_webm_of_impossible_times(self):
        self.evaluate("document.getElementById('film-until').value = 1000")
        self.browser.key("s")
        self.browser.click_element("save-film")
        self.assertIn("expected times from 0 to 8",
                      self.evaluate("document.getElementById('export-says').textContent"))

    def test_link(self):
        """It opens the same view."""
        self.evaluate("void (location.hash = 'show=voronoi&hide=hull,ids&color=speed&point=7&at=50,50,70&theme=dark')")
        self.browser.settle()
        self.go_to(4.25)
        self.browser.move(5, 5)
        view = self.look()
        self.browser.key("s")
        link = self.evaluate("document.getElementById('link').value")
        self.assertTrue(link.startswith(self.run_.page.resolve().as_uri() + "#"))
        self.browser.open(self.run_.page, link[link.index("#"):])
        self.browser.move(5, 5)
        self.assertTrue(self.evaluate("document.getElementById('address-note').hidden"))
        self.assertEqual(self.evaluate("[kinetri.time, kinetri.point, kinetri.colored().id]"), [4.25, 7, "speed"])
        # The width of what is seen, which is written into the link, is rounded.
        self.assertEqual(view.difference(self.look(), 16), 0)
