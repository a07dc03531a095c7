# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package against the program's files, differences of its own runs, and the interpreter's rules."""
import csv
import locale
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pandas

import tunica

cylinder = os.environ["TUNICA_SOURCE"] + "/scenes/cylinder.toml"
program = os.environ["TUNICA_PROGRAM"]
mmhg = 1333.22387415  # dyn/cm2


def columns_of(file):
    """Text of each column by its head, by Python's own reader."""
    with open(file, newline="") as stream:
        rows = list(csv.reader(stream))
    return dict(zip(rows[0], zip(*rows[1:])))


def numbers(texts):
    return np.array([float(text) if text else np.nan for text in texts])


class Scenes(unittest.TestCase):
    def test_a_scene_is_a_mapping_with_units(self):
        scene = tunica.Scene(cylinder)
        self.assertEqual(scene["outlet.resistance"], 1.032e6)
        self.assertEqual(scene.unit("outlet.resistance"), "dyn s/cm5")
        self.assertEqual(dict(scene)["wall.law"], "EXP1+EXP2-FS")
        scene["outlet.pressure"] = "10 mmHg"
        self.assertAlmostEqual(scene["outlet.pressure"] / (10 * mmhg), 1, 8)
        other = scene.with_({"time.beats": 3.0, "outlet.resistance": np.float64(1 / 3)})
        self.assertEqual((other["time.beats"], other["outlet.resistance"]), (3, 1 / 3))
        self.assertEqual((scene["time.beats"], scene["outlet.resistance"]), (2, 1.032e6))
        self.assertEqual(other["outlet.pressure"], scene["outlet.pressure"])

    def test_a_description_gives_the_same_scene(self):
        scene = tunica.Scene(cylinder, {"outlet.resistance": 1 / 3})
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "again.toml"
            file.write_text(scene.describe())
            self.assertEqual(dict(tunica.Scene(file)), dict(scene))

    def test_what_is_refused_leaves_the_scene_as_it_was(self):
        scene = tunica.Scene(cylinder)
        for key, value, says in [("outlet.resistence", 1, "outlet.resistance"), ("outlet.resistance", -1, "out of range"),
                                 ("outlet.resistance", "1 mmHg", "mmHg"), ("outlet.resistance", {}, "{}")]:
            with self.subTest(key=key, value=value), self.assertRaisesRegex(tunica.InvalidInput, says):
                scene[key] = value
        self.assertEqual(dict(scene), dict(tunica.Scene(cylinder)))
        with self.assertRaisesRegex(ValueError, "did you mean outlet.resistance"):
            scene["outlet.resistence"]
        with self.assertRaises(tunica.InvalidInput):
            tunica.Scene("/nowhere.toml")


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "run"
        subprocess.run([program, "run", cylinder, "--quiet", "--no-report", "--out", cls.out, "--set",
                        'sensitivity.parameters=["outlet.resistance"]'], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tables_are_those_of_the_files(self):
        result = tunica.read(self.out)
        for name in ("observables", "events", "sensitivities", "recruited_time"):
            table = getattr(result, name)
            self.assertIsInstance(table, pandas.DataFrame)
            written = columns_of(self.out / f"{name}.csv")
            units = table.attrs["units"]
            self.assertEqual([f"{column}[{units[column]}]" if column in units else column for column in table],
                             list(written))
            for column, texts in zip(table, written.values()):
                if column in units:
                    np.testing.assert_array_equal(table[column], numbers(texts))
                else:
                    self.assertEqual(list(table[column]), list(texts))
        self.assertEqual(result.record["tier"], "lumped")
        self.assertEqual(len(result.along.columns), 0)

    def test_a_run_here_is_the_run_of_the_program(self):
        result = tunica.run(tunica.Scene(cylinder, {"sensitivity.parameters": ["outlet.resistance"]}))
        pandas.testing.assert_frame_equal(result.observables, tunica.read(self.out).observables)
        self.assertTrue(result.record["converged"])

    def test_a_run_is_kept(self):
        kept = Path(self.folder.name) / "kept"
        result = tunica.run(tunica.Scene(cylinder), out=kept)
        pandas.testing.assert_frame_equal(tunica.read(kept).observables, result.observables)
        with self.assertRaisesRegex(OSError, "/proc/nowhere"):
            tunica.run(tunica.Scene(cylinder), out="/proc/nowhere")
        with self.assertRaises(tunica.InvalidInput):
            tunica.read(self.folder.name)

    def test_a_solver_that_gives_up_tells_when_and_keeps_what_it_has(self):
        # Thirty times the scene's resistance asks for pressures that open the lumen beyond what the wall is computed for.
        hopeless = tunica.Scene(cylinder, {"outlet.resistance": 3e7})
        with self.assertRaisesRegex(tunica.SolverFailure, "lumen stretch") as caught:
            tunica.run(hopeless)
        failure = caught.exception
        self.assertIsInstance(failure, RuntimeError)
        self.assertTrue(0 < failure.time < 0.8)
        self.assertAlmostEqual(failure.result.observables["time"].iloc[-1], failure.time)
        with self.assertRaises(tunica.SolverFailure):
            tunica.ask(hopeless, ["pressure.max"])

    @unittest.skipUnless("TUNICA_FULL3D" in os.environ, "the 3D tier is not built")
    def test_the_program_computes_in_space(self):
        scene = tunica.Scene(cylinder, {"time.beats": 1, "accuracy.tolerance": "5%"})
        peaks = {tier: tunica.run(scene, tier).observables["pressure"].max() for tier in ("full3d", "axisym")}
        # Both compute the same equations, each to 5 %.
        self.assertAlmostEqual(peaks["full3d"] / peaks["axisym"], 1, delta=0.1)
        with self.assertRaisesRegex(tunica.InvalidInput, "full3d"):
            tunica.run(scene, "full4d")

    def test_without_pandas_there_are_arrays(self):
        text = ("import sys; sys.modules['pandas'] = None; import tunica; "
                f"table = tunica.read({str(self.out)!r}).observables; "
                "assert type(table) is tunica.Columns and table.attrs['units']['pressure'] == 'dyn/cm2'; "
                "print(repr(float(table['pressure'].max())))")
        printed = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True).stdout
        self.assertEqual(float(printed), tunica.read(self.out).observables["pressure"].max())


class Sweeps(unittest.TestCase):
    def test_rows_with_units_from_either_file(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "sweep"
            subprocess.run([program, "sweep", cylinder, "--vary", "outlet.resistance=8e5:1.2e6:3", "--vary",
                            "wall.law=EXP1,EXP1+EXP2-FS", "--out", out], check=True, capture_output=True)
            written = columns_of(out / "sweep.csv")
            growing = tunica.read_sweep(out)
            os.remove(out / "sweep.db")
            over = tunica.read_sweep(out)
            self.assertEqual(list(over["point"]), [int(text) for text in written["point"]])
            for table in (growing, over):
                self.assertEqual(table.attrs["units"]["outlet.resistance"], "dyn s/cm5")
                self.assertEqual(list(table["wall.law"]), list(written["wall.law"]))
                self.assertEqual(list(table["status"]), ["done"] * 6)
                np.testing.assert_array_equal(table["pressure.max"], numbers(written["pressure.max[dyn/cm2]"]))
            self.assertEqual(list(growing.columns), list(over.columns))
            self.assertTrue((growing["seconds"] > 0).all())
            with self.assertRaisesRegex(tunica.InvalidInput, "no sweep"):
                tunica.read_sweep(folder)
            (out / "sweep.db").write_text("no database at all, but long enough to be looked at" * 20)
            with self.assertRaisesRegex(tunica.InvalidInput, "not the table of a sweep"):
                tunica.read_sweep(out)


class Answers(unittest.TestCase):
    scene = tunica.Scene(cylinder, {"accuracy.tolerance": 1e-4})
    keys = ["outlet.resistance", "tether.stiffness"]

    def test_gradients_are_differences(self):
        asked = ["pressure.max", "radial_displacement.P1.change"]
        answer = tunica.ask(self.scene, asked, gradients=self.keys)
        self.assertEqual(answer.units, {"pressure.max": "dyn/cm2", "radial_displacement.P1.change": "cm"})
        for key in self.keys:
            step = 0.01 * self.scene[key]
            above, below = (tunica.ask(self.scene.with_({key: self.scene[key] + sign * step}), asked) for sign in (1, -1))
            for quantity in asked:
                # The error of a central difference over 1 % of the key, and the runs' own 1e-4 over 2 %.
                self.assertAlmostEqual(answer.gradient(quantity, key) * 2 * step / (above[quantity] - below[quantity]),
                                       1, delta=0.02, msg=f"d({quantity})/d({key})")
        with self.assertRaisesRegex(tunica.InvalidInput, "no gradients"):
            tunica.ask(self.scene, asked).gradient("pressure.max", "outlet.resistance")
        with self.assertRaisesRegex(tunica.InvalidInput, "pressure.max"):
            tunica.ask(self.scene, ["presure.max"])

    def test_many_points_as_samplers_make_them(self):
        seed = 20240611
        points = np.random.default_rng(seed).uniform([5e5, 5e6], [1.2e6, 2e7], (40, 2))
        points[7, 0] = -1
        points[8, 1] = np.nan
        asked = ["pressure.max", "radial_displacement.P1.max"]
        many, reasons = tunica.evaluate(self.scene, self.keys, points, asked, threads=3)
        alone, _ = tunica.evaluate(self.scene, self.keys, points, asked, threads=1)
        np.testing.assert_array_equal(many, alone, err_msg=f"seed {seed}")
        for row in (0, 39):
            one = tunica.ask(self.scene.with_(dict(zip(self.keys, points[row]))), asked)
            np.testing.assert_array_equal(many[row], one.values, err_msg=f"seed {seed}")
        self.assertEqual([row for row, reason in enumerate(reasons) if reason], [7, 8])
        self.assertIn("outlet.resistance", reasons[7])
        self.assertIn("tether.stiffness", reasons[8])
        self.assertEqual(sorted(set(np.argwhere(np.isnan(many))[:, 0])), [7, 8])

    def test_shapes_and_keys_that_suit_no_point(self):
        for keys, points, says in [(self.keys, [[1e6]], "shape"), (["wall.law"], [[1.0]], "number"),
                                   (["outlet.resistence"], [[1.0]], "outlet.resistance")]:
            with self.subTest(keys=keys), self.assertRaisesRegex(tunica.InvalidInput, says):
                tunica.evaluate(self.scene, keys, points, ["pressure.max"])
        values, reasons = tunica.evaluate(self.scene, self.keys, np.empty((0, 2)), ["pressure.max"])
        self.assertEqual((values.shape, reasons), ((0, 1), []))

    def test_python_threads_side_by_side(self):
        resistances = np.linspace(5e5, 1.2e6, 12)

        def peak(resistance):
            return tunica.ask(self.scene.with_({"outlet.resistance": resistance}), ["pressure.max"])["pressure.max"]

        with ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(peak, resistances)), [peak(one) for one in resistances])


class Interpreter(unittest.TestCase):
    """A 2D run of many beats, which no test waits for."""
    long_run = tunica.Scene(cylinder, {"time.beats": 50})
    a_moment = 5  # s, of a busy machine; the run takes minutes

    def test_what_progress_raises_ends_the_run(self):
        seen = []

        def stop(progress):
            seen.append(progress)
            raise LookupError("enough")

        began = time.monotonic()
        with self.assertRaisesRegex(LookupError, "enough"):
            tunica.run(self.long_run, "axisym", progress=stop)
        self.assertEqual(len(seen), 1)
        self.assertAlmostEqual(seen[0].end_time, 50 * self.long_run["inlet.period"])
        self.assertLess(time.monotonic() - began, 2 * self.a_moment)

    def test_control_c_ends_a_run_and_other_threads_go_on(self):
        counted = 0
        sent = []

        def count_and_interrupt():
            nonlocal counted
            end = time.monotonic() + 1
            while time.monotonic() < end:
                counted += 1
                time.sleep(0.001)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        other = threading.Thread(target=count_and_interrupt)
        other.start()
        with self.assertRaises(KeyboardInterrupt):
            tunica.run(self.long_run, "axisym")
        self.assertLess(time.monotonic() - sent[0], self.a_moment)
        other.join()
        # A lock held for whole steps of the run would leave a handful.
        self.assertGreater(counted, 50)

    def test_control_c_ends_many_points(self):
        sent = []

        def interrupt(progress):
            self.assertEqual(progress.end_time, 500)
            if not sent:
                sent.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            tunica.evaluate(tunica.Scene(cylinder), ["outlet.resistance"], np.linspace(5e5, 1.2e6, 500)[:, None],
                            ["pressure.max"], "axisym", progress=interrupt)
        self.assertLess(time.monotonic() - sent[0], self.a_moment)

    def test_an_interrupted_run_is_kept_and_gone_on_with(self):
        scene = tunica.Scene(cylinder, {"time.beats": 1})

        def stop(progress):
            if progress.time > 0.2:
                raise KeyboardInterrupt

        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "run"
            with self.assertRaises(KeyboardInterrupt):
                tunica.run(scene, "axisym", out=out, progress=stop)
            self.assertLess(tunica.read(out).observables["time"].iloc[-1], 0.8)
            gone_on = tunica.run(scene, "axisym", out=out, resume=True)
            pandas.testing.assert_frame_equal(gone_on.observables, tunica.run(scene, "axisym").observables)
        with self.assertRaisesRegex(tunica.InvalidInput, "resume needs out"):
            tunica.run(scene, resume=True)

    def test_locale_and_handlers_stay(self):
        before = locale.setlocale(locale.LC_ALL), signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
        tunica.run(tunica.Scene(cylinder))
        self.assertEqual((locale.setlocale(locale.LC_ALL), signal.getsignal(signal.SIGINT),
                          signal.getsignal(signal.SIGTERM)), before)
        with self.assertRaises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


if __name__ == "__main__":
    unittest.main()
