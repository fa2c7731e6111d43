# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Entries that were made by hand, complete and wrong, given to score.py as anybody would."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

import las_writer

FOLDER = pathlib.Path(os.environ.get("PCL_ALS_BENCHMARK") or
                      pathlib.Path(__file__).resolve().parents[2] / "share" / "benchmark")
POINTS = numpy.stack([numpy.linspace(1.0, 9.0, 9), numpy.full(9, 4.0), numpy.full(9, 100.0)], 1)
ABOUT = {"name": "hand", "cell_m": 20.0, "strips": [
    {"id": "1", "file": "strips/strip1.las", "points": 9},
    {"id": "2", "file": "strips/strip2.las", "points": 9}],
    "parameters": [{"name": "range_bias", "unit": "m", "prior_std": 0.1, "mm_per_unit": 1000.0}]}


class Entries(unittest.TestCase):
    """The true points, an entry that is 10 mm too high in strip 2, and a range bias of 50 mm."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        block, truth = self.folder / "blocks/hand", self.folder / "truth/hand"
        block.mkdir(parents=True)
        (block / "block.json").write_text(json.dumps(ABOUT))
        self.entry = self.folder / "entry/hand"
        self.points = self.entry / "points"
        for number in (1, 2):
            las_writer.write(truth / f"points/strip{number}.las", POINTS)
            las_writer.write(self.points / f"strip{number}.las",
                             POINTS + [0.0, 0.0, 0.01 * (number - 1)])
        (truth / "parameters.csv").write_text("name,value,unit\nrange_bias,0.05,m\n")
        self.parameters = self.entry / "parameters.csv"
        self.parameters.write_text("name,value,std,unit\nrange_bias,0.04,0.01,m\n")
        (self.entry / "entry.json").write_text('{"method": "hand", "seconds": 3}')

    def score(self):
        """Status, errors and scores."""
        output = self.folder / "scores.json"
        done = subprocess.run(
            [sys.executable, "-B", str(FOLDER / "score.py"), str(self.folder),
             str(self.folder / "entry"), "--output", str(output)],
            capture_output=True, text=True, check=False)
        scores = json.loads(output.read_text())[0] if output.exists() else None
        return done.returncode, done.stderr, scores

    def refused(self, *words):
        status, errors, scores = self.score()
        self.assertEqual((status, scores), (2, None), errors)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        for word in words:
            self.assertIn(word, errors)

    def test_complete(self):
        status, errors, scores = self.score()
        self.assertEqual((status, errors), (0, ""))
        self.assertAlmostEqual(scores["parameters"]["rms_error_mm"], 10.0)
        self.assertEqual(scores["parameters"]["inside"], 1)
        self.assertAlmostEqual(scores["parameters"]["interval_score_mm"], 39.19928, places=4)
        self.assertAlmostEqual(scores["points"]["rms_mm"], 7.071068, places=5)
        self.assertAlmostEqual(scores["points"]["rms_shifted_mm"], 5.0, places=6)
        self.assertAlmostEqual(scores["points"]["misfit_mm"], 10.0, places=6)
        self.assertEqual((scores["points"]["claimed_share"], scores["seconds"]), (0.0, 3))

    def test_points_alone_and_parameters_alone(self):
        self.parameters.unlink()
        _, _, scores = self.score()
        self.assertNotIn("parameters", scores)
        self.parameters.write_text("name,value,unit\nrange_bias,0.04,m\n")
        shutil.rmtree(self.points)
        _, _, scores = self.score()
        self.assertNotIn("points", scores)
        self.assertIsNone(scores["parameters"]["interval_score_mm"])
        self.parameters.unlink()
        (self.folder / "scores.json").unlink()
        self.refused("neither parameters.csv nor")

    def test_common_deviations(self):
        (self.entry / "points.csv").write_text(
            "strip,sigma_x,sigma_y,sigma_z\n*,0.01,0.01,0.01\n2,0.01,0.01,0.004\n")
        _, _, scores = self.score()
        self.assertEqual(scores["points"]["claimed_share"], 1.0)
        self.assertEqual(scores["points"]["coverage_plan"], 1.0)
        self.assertEqual(scores["points"]["coverage_height"], 0.5)

    def test_deviations_of_points(self):
        three = [("sigma_x", 0.02), ("sigma_y", 0.03), ("sigma_z", 0.004)]
        radial = [("sigma_horizontal", 0.0005), ("sigma_vertical", 0.004)]
        for fields, width in ((three, 0.05), (radial, 0.001 / 2 ** 0.5)):
            for number in (1, 2):
                las_writer.write(self.points / f"strip{number}.las",
                                 POINTS + [0.0, 0.0, 0.01 * (number - 1)], extra=fields)
            _, _, scores = self.score()
            self.assertEqual(scores["points"]["coverage_height"], 0.5)
            self.assertAlmostEqual(scores["points"]["interval_score_plan_mm"],
                                   1959.964 * width, delta=0.01)
        las_writer.write(self.points / "strip2.las", POINTS, extra=three[:2])
        (self.folder / "scores.json").unlink()
        self.refused("strip2.las", "no sigma_z")

    def test_wrong_points(self):
        path = self.points / "strip2.las"
        las_writer.write(path, POINTS[:8])
        self.refused("strip2.las", "8 points", "9")
        las_writer.write(path, POINTS, times=numpy.arange(9)[::-1])
        self.refused("strip2.las", "8 points have other times", "order")
        las_writer.write(path, POINTS, times=[0, 1, 2, numpy.nan, 4, 5, 6, 7, 8])
        self.refused("strip2.las", "1 points have other times", "first point 3")
        las_writer.write(path, POINTS, compressed=True)
        self.refused("strip2.las", "LAZ")
        las_writer.write(path, POINTS)
        path.write_bytes(path.read_bytes()[:-1])
        self.refused("strip2.las", "ends before")
        path.write_text("no points")
        self.refused("strip2.las", "no LAS file")
        path.unlink()
        self.refused("strip2.las", "is missing")

    def test_wrong_parameters(self):
        head = "name,value,std,unit\n"
        for text, word in (("range_bias,nan,0.01,m", ":2: value is not finite"),
                           ("range_bias,x,0.01,m", ":2: value is no number"),
                           ("range_bias,0.1,-1,m", ":2: std is negative"),
                           ("range_bias,0.1,inf,m", ":2: std is not finite"),
                           ("range_bias,0.1,0.01,mm", "is asked in 'm', not in 'mm'"),
                           ("range,0.1,0.01,m", "'range' is not asked"),
                           ("range_bias,1,1,m\nrange_bias,1,1,m",
                            ":3: range_bias is stated twice")):
            self.parameters.write_text(head + text + "\n")
            self.refused("parameters.csv", word)
        self.parameters.write_text("name,std,unit\n")
        self.refused("parameters.csv", "no column 'value'")

    def test_wrong_deviations(self):
        path = self.entry / "points.csv"
        for text, word in (("3,1,1,1", "no strip '3'"), ("1,1,-1,1", "sigma_y is negative"),
                           ("1,nan,1,1", "sigma_x is not finite"),
                           ("1,1,1", "sigma_z is no number")):
            path.write_text("strip,sigma_x,sigma_y,sigma_z\n" + text + "\n")
            self.refused("points.csv:2", word)
        path.unlink()
        las_writer.write(self.points / "strip1.las", POINTS, extra=[
            ("sigma_x", 0.1), ("sigma_y", -0.1), ("sigma_z", 0.1)])
        self.refused("strip1.las", "sigma_y of point 0 is negative")

    def test_wrong_description(self):
        path = self.entry / "entry.json"
        for text, word in (("{", "is no JSON"), ("{}", "has no 'method'"),
                           ("[]", "has no 'method'"),
                           ('{"method": "m", "seconds": "3"}', "'seconds' is no number"),
                           ('{"method": "m", "seconds": NaN}', "'seconds' is no number")):
            path.write_text(text)
            self.refused("entry.json", word)
        path.unlink()
        self.refused("entry.json", "cannot be read")


if __name__ == "__main__":
    unittest.main()
