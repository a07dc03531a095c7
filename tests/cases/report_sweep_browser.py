# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the page of a made-up sweep in headless Chromium: report_sweep_browser.py FOLDER-WITH-REPORTS.

The sweep (tests/support/made_sweep.hpp): 5 resistances, 2 laws, 3 stiffnesses, the last fastest; the pressure is
60 + 10 i + k mmHg with the levels i of the first and k of the last; point 29 gave up.
"""

import os
import shutil
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from browser import Browser  # noqa: E402

REPORTS = sys.argv.pop()
PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@unittest.skipUnless(PROGRAM, "no Chromium here")
class Sweep(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(PROGRAM)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def setUp(self):
        self.browser.resize(1280, 900)
        self.assertEqual(self.browser.open(os.path.join(REPORTS, "sweep.html")), "ok")

    def value(self, expression):
        return self.browser.evaluate(expression)

    def text(self, selector):
        return self.value(f"document.querySelector({selector!r}).textContent")

    def choose(self, select, index):
        self.value(f"""(() => {{ const select = document.getElementById('{select}');
            select.value = {index}; select.dispatchEvent(new Event('change')); }})()""")

    def grip(self, axis):
        """The place of an axis in the window: its middle in x, its ends in y."""
        return self.value(f"""(() => {{ const grip = document.querySelectorAll('.grip')[{axis}];
            grip.scrollIntoView({{block: 'center'}});
            const {{left, right, top, bottom}} = grip.getBoundingClientRect();
            return [(left + right) / 2, top, bottom]; }})()""")

    def numbers(self):
        return self.value("[...document.querySelectorAll('#listed button')].map(button => button.textContent)")

    def test_it_opens_alone_and_keeps_text_text(self):
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])
        self.assertIsNone(self.value("document.documentElement.dataset.broken || null"))
        self.assertEqual(self.value("document.documentElement.dataset.points"), "30")
        self.assertIn("30 points, 1 without a result", self.text(".subtitle"))
        self.assertIn("</script><script>", self.text("section[aria-labelledby=failures] td"))

    def test_reach_and_quantiles_are_those_of_the_formula(self):
        label = self.value("document.querySelector('#reach svg').getAttribute('aria-label')")
        # 60 + 10 i + 1, but 100.8 where the last of 100, 101, 102 twice is missing.
        self.assertIn("outlet.resistance: mean 61 to 100.8 mmHg; ", label)
        label = self.value("document.querySelector('#effect-0 svg').getAttribute('aria-label')")
        self.assertIn("medians 61, 71, 81, 91, 101", label)
        self.choose("quantity", 1)
        label = self.value("document.querySelector('#effect-2 svg').getAttribute('aria-label')")
        self.assertIn("medians 0.001, 0.002, 0.003", label)

    def test_map_has_a_cell_for_each_pair_of_values(self):
        self.choose("pair", 1)
        cells = self.value("[...document.querySelectorAll('#map .cell title')].map(title => title.textContent)")
        self.assertEqual(len(cells), 15)
        self.assertIn("outlet.resistance 5\u00b710\u2075, tether.stiffness 2\u00b710\u2077: 61 mmHg", cells)

    def test_indices_stand_with_their_intervals(self):
        names = self.value("[...document.querySelectorAll('#indices .name title')].map(title => title.textContent)")
        self.assertEqual(names[::2], ["outlet.resistance", "tether.stiffness", "wall.law"])
        self.assertEqual(self.value("document.querySelectorAll('#indices .whisker').length"), 6)
        self.assertIn("kriging of 29 points; held-out Q\u00b2 0.9877.", self.text("#indices figcaption"))
        self.choose("quantity", 1)
        self.assertIn("No indices of radial_displacement.P1.change: too <few> points.", self.text("#indices"))

    def test_a_brush_leaves_the_points_within(self):
        x, top, bottom = self.grip(0)
        # The upper part of the axis of resistances holds the last level, whose points are 24 to 29.
        self.browser.mouse("mousePressed", x, top + 1)
        self.browser.mouse("mouseMoved", x, top + 40)
        self.browser.mouse("mouseReleased", x, top + 40)
        self.assertEqual(self.text("#brushed"), "6 of 30 points within the brushes.")
        self.assertEqual(self.numbers(), [f"Point {number}" for number in range(24, 30)])
        # Another axis takes more away: that of pressures, where the point without a result has no place.
        x, top, bottom = self.grip(3)
        self.browser.mouse("mousePressed", x, bottom - 1)
        self.browser.mouse("mouseMoved", x, top + 1)
        self.browser.mouse("mouseReleased", x, top + 1)
        self.assertEqual(self.text("#brushed"), "5 of 30 points within the brushes.")
        # A brush of a key outlasts the choice of another quantity; that of a quantity goes with its axis.
        self.choose("quantity", 1)
        self.assertEqual(self.text("#brushed"), "6 of 30 points within the brushes.")
        self.value("document.getElementById('clear').click()")
        self.assertEqual(self.text("#brushed"), "30 points drawn.")

    def test_brushes_by_keyboard(self):
        press = """document.querySelectorAll('.grip')[2].dispatchEvent(
            new KeyboardEvent('keydown', {key: '%s', bubbles: true}))"""
        self.value(press % "+")  # from the middle: 0.35 to 0.65 of 1e7 to 3e7 holds the middle value
        self.assertEqual(self.text("#brushed"), "10 of 30 points within the brushes.")
        self.value(press % "ArrowUp")
        self.value(press % "ArrowUp")
        self.value(press % "ArrowUp")
        self.value(press % "ArrowUp")
        self.assertEqual(self.numbers()[0], "Point 2")
        self.value(press % "Escape")
        self.assertEqual(self.text("#brushed"), "30 points drawn.")

    def test_a_point_leads_to_its_curves_or_to_the_command(self):
        self.value("document.querySelectorAll('#listed button')[3].click()")
        self.assertRegex(self.text("#command code"), r"^tunica report '.*/sweep of '\\''many'\\'' points' --point 3$")
        self.assertEqual(self.value("document.querySelectorAll('#time-charts canvas').length"), 6)
        self.value("document.querySelectorAll('#listed button')[4].click()")
        self.assertIn("Point 4 is among the curves", self.text("#command"))
        shown = self.value("[...document.querySelectorAll('#chart-pressure .legend button')].map(button => button.getAttribute('aria-pressed'))")
        self.assertEqual(shown, ["false", "true"])  # point 7 was asked for and stands first

    def test_a_point_in_the_wall_is_chosen_for_all_charts(self):
        label = "document.querySelector('#chart-displacement canvas').getAttribute('aria-label')"
        inner = self.value(label)
        self.value("document.querySelector('input[value=P4]').click()")
        time.sleep(0.1)
        outer = self.value(label)
        # The made-up displacement falls by a fifth through the wall.
        largest = [float(text.split(" to ")[1].split(";")[0]) for text in (inner, outer)]
        self.assertAlmostEqual(largest[1] / largest[0], 0.8, delta=0.001)

    def test_it_fits_narrow_windows(self):
        for width in (390, 1280):
            self.browser.resize(width, 800)
            self.browser.open(os.path.join(REPORTS, "sweep.html"))
            self.assertEqual(self.value("document.documentElement.scrollWidth"), width)
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
