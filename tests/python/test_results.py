# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Texts, tables and copies of settings, strips and results."""
import copy
import os
import pickle
import subprocess
import sys
import types
import unittest
from unittest import mock

import numpy as np

import pcl_als
from support import BLOCK, CONTROL, STRIPS, TRAJECTORY, FolderTest

SMALL = dict(candidates=20_000)


def copies_of(value):
    return pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)


class FakePandas(types.ModuleType):
    """pandas, as far as it is used."""

    class DataFrame:
        def __init__(self, columns):
            self.columns = columns


class ResultTest(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.calibration = pcl_als.calibrate(STRIPS, TRAJECTORY, control=CONTROL)
        cls.check = pcl_als.check(STRIPS[:2], control=CONTROL, before=STRIPS[:2])
        cls.alignment = pcl_als.icpatch(STRIPS[0], STRIPS[1])
        lines = [pcl_als.FlightLine(id=str(i), start=[0, 0], end=[900, 90 * i], height=800) for i in range(2)]
        cls.plan = pcl_als.plan(lines)

    def test_copies_of_results(self):
        for result in (self.calibration, self.check, self.alignment, self.plan):
            for again in copies_of(result):
                self.assertEqual(again.to_dict(), result.to_dict())
                self.assertEqual(str(again), str(result))
                self.assertEqual(repr(again), repr(result))
        for again in copies_of(self.calibration):
            self.assertEqual(again.parameters["boresight_roll"].bias, self.calibration.parameters["boresight_roll"].bias)
            self.assertEqual([part.points for part in again.left_out], [part.points for part in self.calibration.left_out])
        for again in copies_of(self.check):
            self.assertEqual(again.before.pairs[0].sampled_offsets, self.check.before.pairs[0].sampled_offsets)
            self.assertEqual(again.block.warnings, self.check.block.warnings)
        for again in copies_of(self.alignment):
            self.assertEqual(pcl_als.move_file(STRIPS[0], "moved.las", again), len(pcl_als.Survey(STRIPS[0])))
            self.assertTrue(np.array_equal(again.transformation, self.alignment.transformation))

    def test_copies_of_parts_of_results(self):
        parts = [*self.calibration.pairs, *self.calibration.diagnosis, *self.calibration.parameters.values(),
                 *self.calibration.control, self.calibration.verdict, self.calibration.misfit, *self.check.block.pairs]
        for part in parts:
            for again in copies_of(part):
                self.assertEqual(repr(again), repr(part))

    def test_copies_of_other_results(self):
        sites = os.path.join(BLOCK, "training.csv"), os.path.join(BLOCK, "checkpoints.csv")
        cover = pcl_als.classify(STRIPS, "map.tif", training=sites[0], checkpoints=sites[1])
        os.mkdir("out")
        radiometry = pcl_als.correct_intensity(STRIPS[:2], [os.path.join("out", os.path.basename(s)) for s in STRIPS[:2]],
                                               TRAJECTORY)
        for result in (cover, radiometry):
            for again in copies_of(result):
                self.assertEqual((again.to_dict(), repr(again)), (result.to_dict(), repr(result)))
        self.assertTrue(np.array_equal(copies_of(cover)[0].model.covariance(0), cover.model.covariance(0)))
        self.assertEqual(copies_of(radiometry)[0].gains, radiometry.gains)

    def test_short_texts_with_the_verdict(self):
        self.assertRegex(repr(self.calibration), r"^<pcl_als.CalibrationResult: usable.*; \d parameters, \d+ pairs, misfit ")
        self.assertRegex(repr(self.check), r"^<pcl_als.CheckResult: reliable; 1 pairs, largest RMSDz 0\.\d+ m>$")
        self.assertRegex(repr(self.alignment), r"^<pcl_als.Alignment: (not )?reliable")
        self.assertRegex(repr(self.plan), r"^<pcl_als.PlanResult: (not )?determined.*; 2 lines>$")
        self.assertRegex(repr(self.calibration.pairs[0]), r"^<pcl_als.PairFit a='1', b='2', correspondences=\d+, rms_before=0\.")
        self.assertRegex(repr(pcl_als.Survey(STRIPS)), r"^<pcl_als.Survey: \d+ points in 5 strips>$")
        self.assertRegex(repr(pcl_als.read_trajectory(TRAJECTORY)), "samples, .* s, with attitude>$")
        self.assertEqual(repr(pcl_als.CalibrationSettings(threads=2, estimate=["boresight_roll"])),
                         "CalibrationSettings(estimate=['boresight_roll'], threads=2)")
        self.assertEqual(repr(pcl_als.ControlPoint("7", 1, 2, 3)).split(",")[0], "<pcl_als.ControlPoint id='7'")

    def test_every_result_has_a_short_text(self):
        for value in vars(pcl_als).values():
            if isinstance(value, type) and not issubclass(value, Exception):
                self.assertIsNot(value.__repr__, object.__repr__, value)
                self.assertNotIn("pybind11", str(getattr(value.__repr__, "__qualname__", "")), value)

    def test_notebooks(self):
        for result in (self.calibration, self.check, self.alignment, self.plan):
            text = result._repr_html_()
            self.assertTrue(text.startswith(f"<p><b>{type(result).__name__}</b>: "), text)
            self.assertEqual(text.count("<table>"), text.count("</table>"))
            self.assertGreaterEqual(text.count("<tr>"), 2)
        self.assertIn("usable", self.calibration._repr_html_())

    def test_tables(self):
        survey, flight = pcl_als.Survey(STRIPS), pcl_als.read_trajectory(TRAJECTORY)
        strip = pcl_als.read_strips(STRIPS[:1])[0]
        strip.extra = {"amplitude": np.arange(len(strip))}
        objects = (self.calibration, self.check, self.check.block, self.alignment, self.plan, survey, flight, strip)
        with mock.patch.dict(sys.modules, {"pandas": None}):
            columns = [each.to_frame() for each in objects]
            pairs = self.calibration.to_frame("pairs")
        for table in columns + [pairs]:
            self.assertIsInstance(table, dict)
            self.assertEqual(len({len(column) for column in table.values()}), 1)
        self.assertEqual(columns[0]["name"][:2], ["lever_arm_x", "lever_arm_y"])
        self.assertEqual(columns[1]["vertical_rms"], [self.check.block.pairs[0].vertical.rms])
        self.assertEqual(pairs["a"], [pair.a for pair in self.calibration.pairs])
        self.assertTrue(np.array_equal(columns[-1]["x"], strip.ground()[:, 0]))
        self.assertEqual(columns[-1]["amplitude"][-1], len(strip) - 1)
        fake = FakePandas("pandas")
        with mock.patch.dict(sys.modules, {"pandas": fake}):
            frame = self.check.to_frame()
        self.assertIsInstance(frame, FakePandas.DataFrame)
        with self.assertRaisesRegex(ValueError, "^table: 'pair' is none of 'parameters', 'pairs'"):
            self.calibration.to_frame("pair")


class CopyTest(FolderTest):
    def test_settings(self):
        settings = pcl_als.CalibrationSettings(threads=3, systems=[("a", ["1"])], noise=pcl_als.NoiseModel(range=0.5))
        for again in copies_of(settings):
            self.assertEqual(repr(again), repr(settings))
            self.assertEqual(again.noise.range, 0.5)
        again = copy.deepcopy(settings)
        again.noise.range = 0.25
        self.assertEqual(settings.noise.range, 0.5)
        window = pcl_als.PointWindow(bounds=[0, 1, 2, 3])
        self.assertEqual(copies_of(window)[0].bounds, [0, 1, 2, 3])
        self.assertEqual(repr(copies_of(pcl_als.ControlPoint("7", 1, 2, 3, diameter=1))[0].diameter), "1.0")

    def test_strips(self):
        strip = pcl_als.read_strips(STRIPS[:1])[0]
        strip.extra = {"red": np.arange(len(strip), dtype="u2")}
        for again in copies_of(strip):
            self.assertEqual((again.id, again.crs, again.origin.tolist()), (strip.id, strip.crs, strip.origin.tolist()))
            self.assertTrue(np.array_equal(again.points, strip.points))
            self.assertTrue(np.array_equal(again.extra["red"], strip.extra["red"]))
        shallow, deep = copy.copy(strip), copy.deepcopy(strip)
        strip.points["z"][0] = 77.0
        self.assertEqual(shallow.points["z"][0], 77.0)
        self.assertNotEqual(deep.points["z"][0], 77.0)

    def test_trajectories_and_surveys(self):
        flight = pcl_als.read_trajectory(TRAJECTORY)
        for again in copies_of(flight):
            self.assertTrue(np.array_equal(again.samples, flight.samples, equal_nan=True))
            self.assertEqual((again.has_attitude, again.format, again.remarks),
                             (flight.has_attitude, flight.format, flight.remarks))
        survey = pcl_als.Survey(STRIPS[:2])
        self.assertEqual(copies_of(survey)[0].points_by_strip, survey.points_by_strip)

    def test_functions_in_other_processes(self):
        self.assertIs(pickle.loads(pickle.dumps(pcl_als.calibrate)), pcl_als.calibrate)
        program = ("import multiprocessing, sys, pcl_als\n"
                   "with multiprocessing.get_context('spawn').Pool(2) as pool:\n"
                   "    strips = pool.map(pcl_als.read_strips, sys.argv[1:])\n"
                   "print(sum(len(strip) for each in strips for strip in each))\n")
        with open("program.py", "w") as file:
            file.write("if __name__ == '__main__':\n" + "".join("    " + line + "\n" for line in program.splitlines()))
        done = subprocess.run([sys.executable, "program.py", *STRIPS[:2]], capture_output=True, text=True)
        self.assertEqual(done.stdout.strip(), str(len(pcl_als.Survey(STRIPS[:2]))), done.stderr)


if __name__ == "__main__":
    unittest.main()
