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

    def cells(self, selector):
        """Text of the cells of each row of a table's body."""
        return self.value(f"""[...document.querySelectorAll('{selector} tbody tr')]
            .map(row => [...row.cells].map(cell => cell.textContent))""")

    def test_static_states_have_values_and_points(self):
        self.opens("states", 8)
        self.assertTrue(self.value("document.getElementById('beat-section').hidden"))
        rows = self.cells("section[aria-labelledby=states] .scroll")
        self.assertEqual(len(rows), 12)
        # The made-up peak: pressure as asked for, 15 mmHg across the wall, and 0.020 cm falling by a fifth.
        self.assertEqual(rows[0], ["EXP1+EXP2-FS, pressure\u00a080\u00a0mmHg", "80.00", "15.00", "P1", "0.020000",
                                   "33.32", "1.3000", "1.000", "6.400"])
        self.assertEqual(rows[3], ["P4", "0.016000", "35.70", "1.2250", "1.000", "4.480"])
        self.assertEqual(rows[8][3:], ["P1", "0.020000", "\u2013", "\u2013", "\u2013", "8.000"])
        # No fibres are denied to those that have some.
        shares = [row[-4:] for row in self.cells("section[aria-labelledby=numbers] .scroll")]
        self.assertEqual(shares[:2], [["on"] * 4] * 2)
        self.assertEqual(shares[2][-1], "no fibres")
        # Each point is a dot, which a line alone would not make.
        for chart, lines in (("displacement", 3), ("angle", 2), ("stretch", 2), ("recruitment", 2), ("mises", 3)):
            self.assertEqual(self.value(f"document.querySelectorAll('#chart-state-{chart} .legend tr').length"), lines)
        self.assertIn("Not shown: EXP1, pressure\u00a0100\u00a0mmHg (no fibres).", self.value("document.getElementById('chart-state-angle').textContent"))
        self.assertGreater(self.dots("chart-state-displacement"), 8 * 5)  # four lie below others

    def test_static_states_stand_against_what_differs(self):
        # As for the states above, and pressure, displacement, stress and angle against the key.
        self.opens("states-by-key", 12)
        label = self.value("document.querySelector('#chart-state-displacement-by-key canvas').getAttribute('aria-label')")
        self.assertIn("against inlet.pressure, mmHg", label)
        self.assertIn("P1: 0.01600 to 0.02400", label)  # 2e-4 cm/mmHg from 80 to 120 mmHg
        self.assertIn("mid-length: 80.00 to 120.00",
                      self.value("document.querySelector('#chart-state-pressure-by-key canvas').getAttribute('aria-label')"))
        self.assertGreater(self.dots("chart-state-pressure-by-key"), 4 * 5)
        # A line is of all states: hiding one of them hides no line.
        self.value("document.querySelector('#run-list button').click()")
        self.assertEqual(self.value("document.querySelectorAll('#chart-state-pressure-by-key [aria-pressed=false]').length"), 0)

    def dots(self, figure):
        """Pixels of a chart that have the colour of its lines all around them, as in a dot and in no line."""
        return self.value(f"""(() => {{
            const canvas = document.querySelector('#{figure} canvas'), {{width, height}} = canvas;
            const pixels = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, width, height).data.buffer);
            const paint = ['--c0', '--c1', '--c2'].map(name => {{
                const [r, g, b] = getComputedStyle(document.documentElement).getPropertyValue(name).trim().match(/\\w\\w/g).map(text => parseInt(text, 16));
                return (255 << 24 | b << 16 | g << 8 | r) >>> 0; }});
            let count = 0;
            for (let y = 2; y < height - 2; ++y) for (let x = 2; x < width - 2; ++x) {{
                const own = pixels[y * width + x];
                if (!paint.includes(own)) continue;
                let all = true;
                for (let dy = -1; dy <= 1; ++dy) for (let dx = -1; dx <= 1; ++dx) all &&= pixels[(y + dy) * width + x + dx] === own;
                count += all;
            }}
            return count;
        }})()""")

    def test_a_state_beside_a_run_has_its_values_and_the_run_its_curves(self):
        self.opens("mixed", 18)
        self.assertEqual(len(self.cells("section[aria-labelledby=states] .scroll")), 4)
        legend = self.value("document.querySelector('#chart-pressure .legend').textContent")
        self.assertNotIn("static", legend)
        self.assertEqual(self.value("document.querySelectorAll('#run-list button')[0].textContent"),
                         "inlet\u00a0pressure, time\u00a0static, pressure\u00a080\u00a0mmHg")

    def test_runs_are_named_by_what_differs(self):
        self.opens("ten", 13)
        names = self.value("[...document.querySelectorAll('#run-list button')].map(button => button.textContent)")
        self.assertEqual(names[:5], [f"resistance\u00a0{value}\u00a0dyn\u00a0s/cm5" for value in ("2e5", "4e5", "6e5", "8e5", "1e6")])
        self.assertEqual(len(set(names)), 10)
        self.assertEqual(self.value("document.querySelector('.subtitle').textContent"), "10 runs \u00b7 EXP1+EXP2-FS \u00b7 lumped tier")
        colours = self.value("[...document.querySelectorAll('#run-list .swatch')].map(swatch => getComputedStyle(swatch).backgroundColor)")
        self.assertEqual(len(set(colours)), 10)
        # The folder is a detail.
        differing = self.cells("section[aria-labelledby=runs] > .scroll")
        self.assertEqual(differing[9], [names[9], "2e6\u00a0dyn\u00a0s/cm5", "cylinder", "results/sweeps/of/the/outlets/resistance/run-10"])
        self.assertNotIn("sweeps", self.value("document.querySelector('section[aria-labelledby=numbers]').textContent"))
        left_out = self.value("document.querySelector('section[aria-labelledby=paper]').textContent")
        self.assertIn(f"{names[0]}: not one of the paper's arteries", left_out)

    def test_one_point_in_the_wall_of_many_runs(self):
        shown = """[...document.querySelectorAll('#chart-mises .legend tbody td button')]
            .map(button => button.getAttribute('aria-pressed') === 'true')"""
        choose = "(() => { const list = document.getElementById('wall-point'); list.value = '%s'; list.dispatchEvent(new Event('change')); })()"
        self.opens("ten", 13)
        self.assertEqual(self.value(shown), [True, False, False, False] * 10)
        self.value(choose % "P3")
        self.assertEqual(self.value(shown), [False, False, True, False] * 10)
        # A run that is hidden stays so, and one that is shown again has the chosen point only.
        self.value("document.querySelectorAll('#run-list button')[1].click()")
        self.value(choose % "")
        self.assertEqual(self.value(shown), [True] * 4 + [False] * 4 + [True] * 32)
        self.value(choose % "P2")
        self.value("document.querySelectorAll('#run-list button')[1].click()")
        self.assertEqual(self.value(shown), [False, True, False, False] * 10)
        # Other charts keep all their lines.
        self.assertEqual(self.value("document.querySelectorAll('#chart-pressure .legend [aria-pressed=false]').length"), 0)
        self.opens("one", 13)
        self.assertTrue(self.value("document.getElementById('point-choice').hidden"))

    def unreachable(self):
        """Cells of tables that are not wholly within the window, or within a box that would have to be scrolled, and
        values whose head is neither above nor beside them."""
        return self.value("""[...document.querySelectorAll('details')].forEach(details => { details.open = true; }) ||
            new Promise(resolve => setTimeout(() => resolve([...document.querySelectorAll('.scroll, .legend')].flatMap(box => {
                const bounds = box.getBoundingClientRect(), narrow = box.classList.contains('narrow');
                return [...box.querySelectorAll(narrow ? 'tbody th, tbody td' : 'th, td')].filter(cell => {
                    const place = cell.getBoundingClientRect();
                    const outside = place.width > 0 && (place.left < bounds.left - 1 || place.right > Math.min(bounds.right, innerWidth) + 1);
                    const nameless = narrow && box.className.includes('scroll') && cell.tagName === 'TD' && !cell.dataset.head;
                    return outside || nameless || cell.scrollWidth > cell.clientWidth + 1;
                }).map(cell => `${box.className}: ${cell.textContent}`);
            })), 300))""")

    def test_every_column_is_reached_at_any_width(self):
        widths = {"one": (390,), "four": (390, 1280), "ten": (320, 390, 768, 1280), "states": (390,), "verify": (390, 1280)}
        for name, all_widths in widths.items():
            for width in all_widths:
                self.browser.resize(width, 900)
                self.browser.open(report(name))
                self.assertEqual(self.unreachable(), [], f"{name} at {width}")
                self.assertEqual(self.value("document.documentElement.scrollWidth"), width)

    def test_a_table_with_room_is_a_table(self):
        for name in ("four", "ten"):
            self.browser.resize(1280, 900)
            self.browser.open(report(name))
            self.assertEqual(self.value("document.querySelectorAll('.scroll.narrow, .legend.narrow').length"), 0, name)
        # And becomes one again.
        self.browser.resize(390, 900)
        time.sleep(0.3)
        self.assertGreater(self.value("document.querySelectorAll('.scroll.narrow').length"), 0)
        heads = self.value("[...document.querySelector('section[aria-labelledby=numbers] tbody tr').cells].map(cell => cell.dataset.head)")
        self.assertEqual(heads[1:4], ["Pressure mmHg", "Transmural mmHg", "Inner radius, % of R0: change"])
        self.assertEqual(heads[-1], "Fibres recruited, % of the beat: P4")
        self.browser.resize(1280, 900)
        time.sleep(0.3)
        self.assertEqual(self.value("document.querySelectorAll('.scroll.narrow, .legend.narrow').length"), 0)

    def test_the_paper_is_beside_with_its_readings(self):
        self.browser.open(report("four"))
        section = "document.querySelector('section[aria-labelledby=paper]')"
        lines = self.value(f"[...{section}.children].map(child => child.tagName)")
        self.assertLess(lines.index("P"), lines.index("UL"))
        sentence = self.value(f"{section}.querySelector('p').textContent")
        self.assertIn("lumped, tether\u00a0normal, a\u00b2\u00a0=\u00a01.6740, exponent\u00a02", sentence)
        self.assertIn("docs/reproduction.md", sentence)
        wrong = self.value(f"{section}.querySelector('.counts .disagrees b').textContent")
        self.assertIn(f"{wrong} answers disagree under this reading", sentence)
        # A torus has numbers of its own.
        self.browser.open(report("peak"))
        cells = self.cells("section[aria-labelledby=paper] .scroll")
        # Its one beat begins at rest.
        self.assertEqual([cells[k][2] for k in (0, 1)], ["EXP2\u00a00.0 mmHg", "EXP2\u00a0130.0 mmHg"])
        self.assertEqual([cells[k][3] for k in (0, 1)], ["\u2717 disagrees", "\u2713 agrees"])

    def test_verdicts_stand_first(self):
        self.browser.open(report("verify"))
        section = "document.querySelector('section[aria-labelledby=compared]')"
        first = self.value(f"{section}.querySelector('h2').nextElementSibling.textContent")
        self.assertRegex(first, r"^low against high differs by the model \(explained\): \d+ quantities agree, \d+ differ by the model, 0 disagree")

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
