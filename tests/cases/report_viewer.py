# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks at the artery in space in reports of made-up runs in headless Chromium: report_viewer.py FOLDER-WITH-REPORTS."""

import os
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
class Viewer(unittest.TestCase):
    """The artery in space, drawn by the processor."""

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(PROGRAM, webgl=True)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def value(self, expression):
        return self.browser.evaluate(expression)

    def opens(self, name, address=""):
        self.browser.open(report("one"))  # a mere change behind # would not load the page again
        self.assertEqual(self.browser.open(report(name), address=address), "ok")
        self.assertEqual(self.value("document.documentElement.dataset.viewer"), "ok")

    def picture(self, state):
        """Colours of the picture and how many pixels each has, "r,g,b,a"; in other than one run of the page's
        script the picture may be gone."""
        return self.value("""(() => {
            Viewer.show(%s);
            const copy = document.createElement('canvas');
            [copy.width, copy.height] = [Viewer.canvas.width, Viewer.canvas.height];
            const context = copy.getContext('2d');
            context.drawImage(Viewer.canvas, 0, 0);
            const counts = {}, pixels = context.getImageData(0, 0, copy.width, copy.height).data;
            for (let at = 0; at < pixels.length; at += 4) {
                const key = pixels.slice(at, at + 4).join();
                counts[key] = (counts[key] || 0) + 1;
            }
            return counts;
        })()""" % state)

    def sets(self, control, value, event):
        self.value(f"""(() => {{ const control = document.getElementById('viewer-{control}');
            control.value = '{value}'; control.dispatchEvent(new Event('{event}')); }})()""")

    def reads(self, x, y, expected):
        """The reading at a place. A busy browser knows only after a while where the page was scrolled to."""
        end = time.monotonic() + 10
        while True:
            self.browser.move(x, y)
            time.sleep(0.05)
            reading = self.value("document.getElementById('viewer-pointer').textContent")
            if reading == expected or time.monotonic() > end:
                return self.assertEqual(reading, expected)

    def bar(self):
        return self.value("document.getElementById('viewer-legend').getAttribute('aria-label')")

    def quiet(self):
        # Looking at a picture's pixels is slow, as the browser says.
        self.assertEqual([text for text in self.browser.complaints() if "ReadPixels" not in text], [])
        self.assertEqual(self.browser.requests(), [])

    def test_the_vessel_is_seen(self):
        self.opens("space")
        colours = self.picture("{}")
        self.assertGreater(len(colours), 500)
        # All of it, and not only a dot: the ground is around it.
        pixels = sum(colours.values())
        self.assertGreater(colours["0,0,0,0"], 0.5 * pixels)
        self.assertLess(colours["0,0,0,0"], 0.95 * pixels)
        self.quiet()

    def test_time_and_colours_change_the_picture(self):
        self.opens("space")
        before = self.picture("{}")
        self.assertIn("Displacement in the wall, cm, from 0 to 0.01", self.bar())
        # It began at the largest displacement, the fifth of nine times.
        self.assertEqual(self.value("document.getElementById('viewer-time-shown').textContent"), "0.400 s")
        self.sets("time", 2, "input")
        self.assertEqual(self.value("document.getElementById('viewer-time-shown').textContent"), "0.200 s")
        later = self.picture("{}")
        self.assertNotEqual(later, before)
        self.sets("field", "wall/von_mises", "change")
        self.assertIn("Von Mises stress in the wall, 10\u2075 dyn/cm\u00b2, from 0.84 to 10.4", self.bar())
        self.assertNotEqual(self.picture("{}"), later)
        self.sets("field", "blood/pressure", "change")
        self.assertIn("Pressure in the blood, mmHg, from 80 to 120", self.bar())
        self.assertEqual(self.value("Viewer.state.part"), "blood")
        self.quiet()

    def test_colours_stand_for_values(self):
        self.opens("space")
        # Pressure is the same everywhere: lowest at 0 s, in the middle at 0.2 s, highest at 0.4 s. Viridis there,
        # from matplotlib: 440154, between 21918c and 21908c, fde725.
        for time_of, expected in ((0, (0x44, 0x01, 0x54)), (0.2, (0x21, 0x90, 0x8c)), (0.4, (0xfd, 0xe7, 0x25))):
            colours = self.picture("{field: 'blood/pressure', shaded: false, time: %s}" % time_of)
            seen = max((key for key in colours if key.endswith(",255")), key=colours.get)
            for channel, wanted in zip(seen.split(","), expected):
                # Between 16 of the 256 colours viridis is taken as linear.
                self.assertAlmostEqual(int(channel), wanted, delta=4)
        # Where there are no fibres it is grey.
        colours = self.picture("{field: 'wall/recruitment', part: 'wall'}")
        self.assertEqual(max((key for key in colours if key.endswith(",255")), key=colours.get), "158,158,158,255")
        self.assertIn("grey: none", self.bar())

    def test_the_pointer_reads_values(self):
        self.opens("spaces")
        self.value("document.getElementById('viewer').scrollIntoView()")
        self.value("Viewer.show({run: 0, part: 'both', field: 'blood/pressure', time: 0.4, cut: true})")
        self.value("Viewer.view.look(new URLSearchParams('azimuth=0&elevation=0'))")
        time.sleep(0.1)
        box = self.value("(() => { const box = Viewer.canvas.getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()")
        # The picture is raised by 3 % for the colours below it.
        x, y = box[0] + box[2] / 2, box[1] + 0.47 * box[3]
        self.reads(x, y, "Pressure 120 mmHg")
        # Uncut, the wall is before the blood and has another colour.
        self.value("Viewer.show({cut: false})")
        self.reads(x, y, "")
        # On the outer surface at mid-length: 0.01 cm times 0.033 / 0.045.
        self.value("Viewer.show({field: 'wall/displacement'})")
        self.reads(x, y, "Displacement 0.00733 cm")
        self.reads(box[0] + 5, box[1] + 5, "")
        self.quiet()

    def test_a_cut_shows_the_inside(self):
        for run in (0, 1):
            self.opens("spaces")
            whole = self.picture("{run: %d, part: 'wall', field: 'recruitment', shaded: false, time: 0.4}" % run)
            cut = self.picture("{cut: true}")
            # The highest recruitment, of the inner layer: seen through the ends, then along the whole inside.
            bright = "253,231,37,255"
            self.assertGreater(cut[bright], 10 * whole.get(bright, 1))
            # With the blood, its section covers the inside.
            both = self.picture("{part: 'both'}")
            self.assertLess(both[bright], cut[bright])
            blood = "153,33,36,255"
            self.assertGreater(both[blood], 0.3 * cut[bright])
            self.quiet()

    def test_quarters_are_shown_whole(self):
        self.opens("spaces")
        state = "run: 0, part: 'wall', shaded: false, time: 0, cut: false"
        self.assertEqual(self.value("Viewer.state.run"), 0)
        # The same picture, turned upside down, of a vessel that is symmetric.
        rows = """(() => {
            Viewer.show({%s}); Viewer.view.look(new URLSearchParams('azimuth=0&elevation=0'));
            Viewer.show({});
            const gl = Viewer.canvas.getContext('webgl2'), [width, height] = [Viewer.canvas.width, Viewer.canvas.height];
            const pixels = new Uint8Array(4 * width * height);
            gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
            const column = width >> 1, seen = [];
            for (let y = 0; y < height; ++y) if (pixels[4 * (y * width + column) + 3]) seen.push(y);
            return [seen.length, seen.at(-1) - seen[0] + 1, height];
        })()""" % state
        filled, reach, height = self.value(rows)
        self.assertEqual(filled, reach)
        # 0.09 of 0.66 cm of the vessel, which fills some three quarters of a width of 1200 pixels.
        self.assertGreater(filled, 0.1 * 900)

    def test_several_runs_share_their_colours(self):
        self.opens("spaces")
        options = self.value("[...document.getElementById('viewer-run').options].map(option => option.textContent)")
        self.assertEqual(options, ["EXP1+EXP2-FS", "EXP2"])
        # 0.010 cm in the first run, 0.008 cm in the other.
        for run in (0, 1):
            self.sets("run", run, "change")
            self.assertIn("from 0 to 0.01", self.bar())
        self.quiet()

    def test_keys_turn_and_buttons_play(self):
        self.opens("space")
        where = "JSON.stringify(Viewer.view.camera.position.toArray().map(value => value.toFixed(4)))"
        home = self.value(where)
        places = {home}
        for key in ("ArrowLeft", "ArrowUp", "+"):
            self.value("Viewer.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: '%s', cancelable: true}))" % key)
            places.add(self.value(where))
        self.assertEqual(len(places), 4)
        self.value("document.getElementById('viewer-home').click()")
        self.assertEqual(self.value(where), home)
        self.value("document.getElementById('viewer-play').click()")
        time.sleep(0.5)
        self.value("document.getElementById('viewer-play').click()")
        self.assertNotEqual(self.value("Viewer.state.time"), 0.4)
        self.assertEqual(self.value("document.getElementById('viewer-play').textContent"), "Play")
        self.assertEqual(self.value("document.querySelectorAll('canvas:not([role=img][aria-label])').length"), 0)
        self.quiet()

    def test_an_address_tells_what_is_shown(self):
        self.opens("space", "still&part=both&field=blood/velocity&time=0.31&cut=1&scale=2")
        state = self.value("Viewer.state")
        self.assertEqual((state["part"], state["field"], state["cut"], state["scale"]), ("both", "blood/velocity", True, 2))
        self.assertAlmostEqual(state["time"], 0.3)
        self.assertEqual(self.value("Viewer.canvas.clientHeight"), self.value("innerHeight"))
        self.assertEqual(self.value("getComputedStyle(document.querySelector('header')).display"), "none")
        # What is not there is as if it had not been asked for.
        self.opens("space", "part=lumen&field=wall/heat&time=soon&run=7")
        self.assertIn("Displacement in the wall", self.bar())
        self.quiet()

    def test_it_begins_at_peak_flow(self):
        self.opens("peak")
        self.assertAlmostEqual(self.value("Viewer.state.time"), 0.2112)
        self.assertEqual(self.value("document.getElementById('viewer-time-shown').textContent"), "0.211 s")
        self.sets("time", 7, "input")
        self.assertAlmostEqual(self.value("Viewer.state.time"), 0.7)
        self.value("document.getElementById('viewer-peak').click()")
        self.assertAlmostEqual(self.value("Viewer.state.time"), 0.2112)
        # Without a picture at that time there is no such button.
        self.opens("space")
        self.assertTrue(self.value("document.getElementById('viewer-peak').hidden"))
        self.quiet()

    def test_the_colours_limits_can_be_set(self):
        self.opens("space", "part=blood&field=blood/velocity&time=0.2")
        # Largest on the axis: 20 + 40 sin^2(pi/4) = 40 cm/s at this time, 60 cm/s at 0.4 s.
        self.assertRegex(self.bar(), "from 0 to .* 59|from 0 to 60")
        whole = self.picture("{}")
        self.sets("range", "time", "change")
        self.assertIn("from 0 to 40", self.bar())
        self.assertNotEqual(self.picture("{}"), whole)
        self.sets("range", "typed", "change")
        self.assertFalse(self.value("document.getElementById('viewer-limits').hidden"))
        self.assertEqual(self.value("[...document.querySelectorAll('#viewer-limits input')].map(input => input.value)"), ["0", "40"])
        self.sets("lowest", 10, "input")
        self.sets("highest", 20, "input")
        self.assertIn("from \u2264 10 to \u2265 20", self.bar())
        # The other way round they are marked, and the colours are those of all times.
        self.sets("highest", 5, "input")
        self.assertEqual(self.value("document.getElementById('viewer-highest').getAttribute('aria-invalid')"), "true")
        self.assertNotIn("10", self.bar())
        # Pressure is 100 mmHg everywhere: the middle of 50 to 150 has the colour of viridis' middle, 21918c.
        self.opens("space", "part=blood&field=blood/pressure&time=0.2&lowest=50&highest=150&shaded=0")
        colours = self.picture("{}")
        seen = max((key for key in colours if key.endswith(",255")), key=colours.get)
        for channel, wanted in zip(seen.split(","), (0x21, 0x90, 0x8c)):
            self.assertAlmostEqual(int(channel), wanted, delta=4)
        # Limits of a pressure are none for a velocity.
        self.sets("field", "blood/velocity", "change")
        self.assertEqual(self.value("Viewer.state.range"), "all")
        self.quiet()

    def test_two_beats_of_3000_cells_are_within_15_megabytes(self):
        self.assertLess(os.path.getsize(report("large")), 15e6)
        self.opens("large")
        self.assertEqual(self.value("document.getElementById('viewer-time').max"), "32")

    def test_a_narrow_window_does_not_scroll_sideways(self):
        self.browser.resize(320, 800)
        self.opens("spaces")
        self.assertEqual(self.value("document.documentElement.scrollWidth"), 320)
        self.browser.resize(1280, 900)


if __name__ == "__main__":
    unittest.main(verbosity=2)
