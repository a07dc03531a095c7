# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks at reports of made-up runs in headless Chromium: report_browser.py FOLDER-WITH-REPORTS."""

import os
import re
import shutil
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from browser import Browser  # noqa: E402

REPORTS = sys.argv.pop()
PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def report(name):
    return os.path.join(REPORTS, name + ".html")


@unittest.skipUnless(PROGRAM, "no Chromium here")
class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(PROGRAM)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def setUp(self):
        self.browser.resize(1280, 900)

    def value(self, expression):
        return self.browser.evaluate(expression)

    def opens(self, name, charts):
        self.assertEqual(self.browser.open(report(name)), "ok")
        self.assertEqual(self.value("document.documentElement.dataset.charts"), str(charts))
        self.assertEqual(self.value("document.querySelectorAll('.uplot canvas').length"), charts)
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])
        # A canvas in one colour would be an empty chart.
        empty = self.value("""[...document.querySelectorAll('figure')].filter(figure => {
            const canvas = figure.querySelector('canvas');
            const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            return new Set(new Uint32Array(pixels.buffer)).size < 20;
        }).map(figure => figure.id)""")
        self.assertEqual(empty, [])

    def test_one_run(self):
        self.opens("one", 13)
        self.assertTrue(self.value("document.getElementById('along-section').hidden"))

    def test_four_laws_with_sensitivities(self):
        self.opens("four", 14)
        self.assertFalse(self.value("document.getElementById('sensitivity-section').hidden"))
        self.assertIn("outlet.resistance", self.value("document.getElementById('chart-sensitivity').textContent"))

    def test_curves_along_the_artery(self):
        self.opens("length", 17)
        self.assertFalse(self.value("document.getElementById('along-section').hidden"))
        chart = "document.getElementById('chart-along-pressure')"
        self.assertIn("Not shown: ", self.value(f"{chart}.textContent"))
        label = self.value(f"{chart}.querySelector('canvas').getAttribute('aria-label')")
        self.assertIn("90.00 to 100.00", label)
        # In dyn/cm2, which is a stress but no pressure.
        label = self.value("document.querySelector('#chart-along-shear canvas').getAttribute('aria-label')")
        self.assertIn("20.22 to 25.22", label)

    def test_tiers_compared(self):
        self.opens("verify", 14)
        section = "document.querySelector('section[aria-labelledby=compared]')"
        # 55 mmHg of range; 5 % of 130 mmHg is 6.5 mmHg, of which 2 % and 2.9 % are explained.
        cells = self.value(f"[...{section}.querySelector('tbody tr').cells].map(cell => cell.textContent)")
        self.assertEqual(cells[0], "pressure, %")
        expected = [1, 100 * 6.5 / 57.75, None, 100 * 2.6 / 57.75, 100 * 0.13 / 57.75, 100 * 3.77 / 57.75]
        for cell, value in zip(cells[1:], expected):
            if value is not None:
                self.assertAlmostEqual(float(cell), value, delta=0.006)
        self.assertIn("differs by the model", cells[-1])
        self.assertIn("<b>ends</b>", self.value(f"{section}.textContent"))
        chart = "document.getElementById('chart-difference-low')"
        self.assertIn("low minus high: pressure", self.value(f"{chart}.textContent"))
        label = self.value(f"{chart}.querySelector('canvas').getAttribute('aria-label')")
        self.assertIn("difference: \u221211.255 to", label)
        self.value("""(() => { const select = document.getElementById('compared-quantity');
            select.value = 'displacement P1'; select.dispatchEvent(new Event('change')); })()""")
        time.sleep(0.1)
        self.assertIn("displacement P1", self.value(f"{chart}.textContent"))
        self.assertEqual(self.value("document.querySelectorAll('#comparison-charts figure').length"), 1)
        self.assertEqual(self.browser.complaints(), [])

    def test_a_law_without_fibres_says_so(self):
        self.opens("isotropic", 8)
        notes = self.value("[...document.querySelectorAll('.charts > .note')].map(note => note.textContent)")
        self.assertEqual(len(notes), 5)
        self.assertTrue(all("no fibres" in note for note in notes), notes)

    def test_runs_with_other_output_times_share_charts(self):
        self.opens("grids", 13)

    def test_text_of_users_stays_text(self):
        self.opens("hostile", 13)
        self.assertIsNone(self.value("document.documentElement.dataset.broken || null"))
        self.assertEqual(self.value("document.querySelectorAll('img').length"), 0)
        self.assertEqual(self.value("document.scripts.length"), 5)
        self.assertTrue(self.value("document.querySelector('h1').textContent.includes('</script><script>')"))
        self.assertTrue(self.value("document.querySelector('h1').textContent.includes('{{data}}&amp;')"))

    def test_a_failing_script_is_told(self):
        with open(report("one"), encoding="utf-8") as file:
            text = file.read()
        broken = report("broken")
        with open(broken, "w", encoding="utf-8") as file:
            file.write(re.sub(r'(id="data">).*?(</script>)', r"\1{\2", text, flags=re.S))
        self.assertEqual(self.browser.open(broken), "error")
        self.assertIn("JSON", self.value("document.documentElement.dataset.message"))
        self.assertFalse(self.value("document.getElementById('failure').hidden"))

    def test_a_request_would_be_noticed(self):
        with open(report("one"), encoding="utf-8") as file:
            text = file.read()
        asking = report("asking")
        with open(asking, "w", encoding="utf-8") as file:
            file.write(re.sub(r"<meta http-equiv[^>]*>", "", text).replace("</main>", "</main><img src='missing.png'>"))
        self.browser.open(asking)
        self.assertEqual(len(self.browser.requests()), 1)

    def test_the_legend_hides_and_shows(self):
        self.browser.open(report("four"))
        state = "[...document.querySelectorAll('#chart-angle button')].map(button => button.getAttribute('aria-pressed'))"
        pixels = "document.querySelector('#chart-angle canvas').toDataURL()"
        before = self.value(pixels)
        # Buttons: P1 P2 P3 P4, then a run and its four lines, twice. The first hides P1 of both runs.
        self.assertEqual(self.value(state), ["true"] * 14)
        self.value("document.querySelector('#chart-angle button').click()")
        time.sleep(0.1)
        expected = ["true"] * 14
        for index in (0, 5, 10):
            expected[index] = "false"
        self.assertEqual(self.value(state), expected)
        self.assertNotEqual(self.value(pixels), before)
        self.value("document.querySelector('#chart-angle button').click()")
        time.sleep(0.1)
        self.assertEqual(self.value(state), ["true"] * 14)
        self.assertEqual(self.value(pixels), before)

    def test_a_run_is_hidden_in_all_charts(self):
        self.browser.open(report("four"))
        self.value("document.querySelectorAll('#run-list button')[3].click()")
        shown = self.value("""[...document.querySelectorAll('#time-charts .legend button[aria-pressed=false]')]
            .filter(button => button.closest('tbody th, .list')).length""")
        # The run's row in eight charts and its line in the two charts with a single quantity.
        self.assertEqual(shown, 10)

    def test_dragging_zooms_all_charts_over_time_and_reset_undoes_it(self):
        self.browser.open(report("four"))
        charts = ("pressure", "mises", "intervals")
        images = {chart: f"document.querySelector('#chart-{chart} canvas').toDataURL()" for chart in charts}
        before = {chart: self.value(image) for chart, image in images.items()}
        box = self.value("""(() => { const box = document.querySelector('#chart-pressure .u-over').getBoundingClientRect();
            return [box.left, box.top, box.width, box.height]; })()""")
        y = box[1] + box[3] / 2
        start, end = box[0] + 0.25 * box[2], box[0] + 0.5 * box[2]
        self.browser.mouse("mouseMoved", start, y)
        self.browser.mouse("mousePressed", start, y)
        self.browser.mouse("mouseMoved", (start + end) / 2, y)
        self.browser.mouse("mouseMoved", end, y)
        self.browser.mouse("mouseReleased", end, y)
        time.sleep(0.2)
        for chart in charts:
            self.assertNotEqual(self.value(images[chart]), before[chart], chart)
        self.value("document.getElementById('reset').click()")
        time.sleep(0.2)
        for chart in charts:
            self.assertEqual(self.value(images[chart]), before[chart], chart)

    def test_the_cursor_reads_values_in_all_charts(self):
        self.browser.open(report("one"))
        box = self.value("""(() => { const box = document.querySelector('#chart-pressure .u-over').getBoundingClientRect();
            return [box.left, box.top, box.width, box.height]; })()""")
        # The peak of the made-up pressure, 130 mmHg, is at 0.2112 s of 0.8 s.
        self.browser.mouse("mouseMoved", round(box[0] + 0.264 * box[2]), box[1] + 20)
        time.sleep(0.1)
        reading = self.value("document.querySelector('#chart-pressure output').textContent")
        self.assertAlmostEqual(float(reading), 130, delta=0.05)
        self.assertEqual(self.value("document.querySelector('#chart-intervals output').textContent"), "recruited")

    def test_the_whole_run_can_be_shown(self):
        self.browser.open(report("one"))
        label = "document.querySelector('#chart-pressure canvas').getAttribute('aria-label')"
        self.assertIn("mid-length: 75.00 to 130.00", self.value(label))
        self.value("document.querySelector('input[value=run]').click()")
        time.sleep(0.1)
        self.assertIn("mid-length: 0.00 to 130.00", self.value(label))
        self.assertEqual(self.browser.complaints(), [])

    def test_a_narrow_window_does_not_scroll_sideways(self):
        for width in (320, 500):
            self.browser.resize(width, 800)
            self.browser.open(report("four"))
            self.assertEqual(self.value("document.documentElement.scrollWidth"), width)
        self.browser.open(report("hostile"))
        self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 500)

    def test_tables_and_charts_have_names(self):
        self.browser.open(report("four"))
        self.assertEqual(self.value("document.querySelectorAll('canvas:not([role=img][aria-label])').length"), 0)
        self.assertEqual(self.value("""[...document.querySelectorAll('main table')]
            .filter(table => !table.caption && !table.getAttribute('aria-label')).length"""), 0)
        self.assertEqual(self.value("document.querySelectorAll('thead th:not([scope])').length"), 0)
        self.assertEqual(self.value("""[...document.querySelectorAll('button')]
            .filter(button => !button.textContent.trim() && !button.getAttribute('aria-label')).length"""), 0)

    def test_without_webgl_the_rest_is_there(self):
        self.opens("space", 13)
        self.assertEqual(self.value("document.documentElement.dataset.viewer"), "missing")
        self.assertFalse(self.value("document.getElementById('viewer-missing').hidden"))
        self.assertEqual(self.value("document.querySelectorAll('#viewer, .viewer-tools').length"), 0)

    def test_it_prints(self):
        self.browser.open(report("four"))
        target = report("print") + ".pdf"
        self.browser.print(target)
        self.assertGreater(os.path.getsize(target), 50000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
