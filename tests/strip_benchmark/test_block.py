# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""A small block made, processed and scored; and the signs that the specification states."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

FOLDER = pathlib.Path(os.environ.get("PCL_ALS_BENCHMARK") or
                      pathlib.Path(__file__).resolve().parents[2] / "share" / "benchmark")
TOOLS = pathlib.Path(os.environ["PCL_ALS_BIN"])
sys.path.insert(0, str(FOLDER))
import blocks  # noqa: E402
import generate  # noqa: E402
import lasfile  # noqa: E402


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)


class Signs(Scratch):
    """Effects on points of a level flight: strip 2 of the preset goes north at 1150 m."""

    def effect(self, kind, text):
        """Effect (right, forward, up) at points, and their lateral distance to the right."""
        generate.simulate(TOOLS / "pcl_als_simulate", [
            "-preset", "small", "-scale", "0.1", "-density", "0.02", "-vertical", "-bias",
            text if kind == "-bias" else "none", "-truth_points",
            *(["-error", text] if kind == "-error" else [])], self.folder / "strips", 1)
        las = lasfile.LasFile(self.folder / "strips" / "strip2.las")
        trajectory = numpy.loadtxt(self.folder / "strips" / "trajectory.csv", delimiter=",",
                                   skiprows=1)
        heading = numpy.interp(las.time(), trajectory[:, 0], trajectory[:, 6])
        self.assertLess(abs(heading).max(), 1.0)
        x = numpy.interp(las.time(), trajectory[:, 0], trajectory[:, 1])
        return generate.columns(las, "bias"), las.xyz()[:, 0] - x

    def test_angles(self):
        nadir = 100.0 / 206264.806 * 1150.0  # m, of 100 arc-seconds
        effect, right = self.effect("-bias", "none,boresight_roll=100")
        middle = abs(right) < 50.0
        numpy.testing.assert_allclose(effect[middle].mean(axis=0), [-nadir, 0.0, 0.0], atol=0.03)
        effect, right = self.effect("-bias", "none,boresight_pitch=100")
        numpy.testing.assert_allclose(effect[middle].mean(axis=0), [0.0, nadir, 0.0], atol=0.03)
        effect, right = self.effect("-bias", "none,boresight_heading=100")
        # Points on the right move forward: anticlockwise.
        numpy.testing.assert_allclose(effect[:, 1], 100.0 / 206264.806 * right, atol=0.003)

    def test_lengths(self):
        effect, right = self.effect("-bias", "none,lever_arm_x=0.1,lever_arm_y=0.2")
        numpy.testing.assert_allclose(effect.mean(axis=0), [0.1, 0.2, 0.0], atol=0.005)
        effect, right = self.effect("-bias", "none,range_bias=0.1")
        self.assertAlmostEqual(effect[abs(right) < 50.0, 2].mean(), -0.1, delta=0.001)
        effect, right = self.effect("-bias", "none,scan_angle_scale=0.001")
        # 0.001 of an angle of some 0.2 at 1150 m.
        self.assertTrue((effect[right > 200.0, 0] > 0.15).all())
        self.assertTrue((effect[right < -200.0, 0] < -0.15).all())

    def test_further_errors(self):
        effect, _ = self.effect("-error", "time_offset=5")
        # 5 ms at 60 m/s, with the pose at a later time: forward.
        numpy.testing.assert_allclose(effect.mean(axis=0), [0.0, 0.3, 0.0], atol=0.03)
        effect, _ = self.effect("-error", "offset_z=0.2")
        numpy.testing.assert_allclose(effect.mean(axis=0), [0.0, 0.0, 0.2], atol=0.001)


class SmallBlock(Scratch):
    def test_run(self):
        done = subprocess.run(
            [sys.executable, "-B", str(FOLDER / "run.py"), str(self.folder), "--tools", str(TOOLS),
             "--only", "aeroplane", "--thin", "0.3", "--methods",
             "nothing,pcl_als,pcl_als_strips"],
            capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        scores = {one["entry"]: one for one in json.loads(
            (self.folder / "scores.json").read_text())}
        nothing, ours = scores["nothing"], scores["pcl_als"]
        for key in ("rms_mm", "misfit_mm"):
            self.assertLess(ours["points"][key], 0.6 * nothing["points"][key])
        self.assertLess(ours["parameters"]["interval_score_mm"],
                        0.5 * nothing["parameters"]["interval_score_mm"])
        self.assertEqual(nothing["parameters"]["stated"], 7)
        self.assertEqual(ours["points"]["claimed_share"], 1.0)
        self.assertGreater(ours["points"]["coverage_height"], 0.8)
        # What exact parameters would give is known without an estimate.
        self.assertLess(scores["true_parameters"]["points"]["misfit_mm"],
                        nothing["points"]["misfit_mm"])
        page = (self.folder / "results.md").read_text()
        self.assertIn("| pcl_als | 1 |", page)
        truth = dict(line.split(",")[:2] for line in (
            self.folder / "truth/aeroplane/parameters.csv").read_text().splitlines()[1:])
        self.assertEqual(float(truth["boresight_roll"]),
                         blocks.truth_of(blocks.BLOCKS[0])["boresight_roll"])


if __name__ == "__main__":
    unittest.main()
