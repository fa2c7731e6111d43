# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The programs of share/examples/python and the Python of the README run and do their work."""
import contextlib
import glob
import importlib.util
import io
import os
import re
import subprocess
import sys
import unittest

import numpy as np

import pcl_als
from support import BLOCK, CONTROL, STRIPS, TRAJECTORY, FolderTest

ROOT = os.environ["PCL_ALS_ROOT"]
EXAMPLES = os.path.join(ROOT, "share/examples/python")


def samples(page):
    """The Python code in a page of Markdown."""
    with open(os.path.join(ROOT, page)) as file:
        return re.findall(r"^```python\n(.*?)^```$", file.read(), re.M | re.S)


class ReadmeTest(FolderTest):
    def setUp(self):
        super().setUp()
        for path in [*STRIPS, TRAJECTORY, CONTROL]:
            os.symlink(path, os.path.basename(path))

    def test_second_example_of_the_readme(self):
        code, = samples("README.md")
        self.assertLessEqual(len([line for line in code.splitlines() if line]), 7)
        exec(compile(code, "README.md", "exec"), {})
        self.assertEqual(len(glob.glob("corrected_strip*.las")), len(STRIPS))
        before = pcl_als.check(STRIPS).block.pairs
        after = pcl_als.check(glob.glob("corrected_strip*.las")).block.pairs
        # The range noise of the block is 2 cm; the misfit before is decimetres.
        self.assertGreater(max(pair.normal.rms for pair in before), 0.1)
        self.assertLess(max(pair.normal.rms for pair in after if pair.normal.count > 0), 0.04)

    def test_page_of_the_module(self):
        calibrate, coordinates, arrays = samples("modules/python/README.md")
        exec(compile(calibrate, "README.md", "exec"), {})
        values = {}
        ground = pcl_als.read_strips(["strip1.las"])[0].ground()
        values.update(np=np, pcl_als=pcl_als, x=ground[:, 0], y=ground[:, 1], z=ground[:, 2], time=ground[:, 0] * 0)
        os.remove("strip1.las")
        for code in (coordinates, arrays):
            exec(compile(code, "README.md", "exec"), values)
            self.assertLess(abs(values["strip"].ground() - ground).max(), 1e-3)
        self.assertLess(abs(pcl_als.read_strips("strip1.laz")[0].ground() - ground).max(), 1e-3)

    def test_page_of_the_manual(self):
        os.symlink(BLOCK, "block")
        values, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for code in samples("share/doc/python.md"):
                exec(compile(code, "python.md", "exec"), values)
        self.assertRegex(printed.getvalue(), r"boresight_roll +-\d+\.\d+ \+- [0-9.]+ arcsec")
        self.assertLess(values["quality"].block.pairs[0].vertical.rms, 0.04)  # noise of the block: 2 cm


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "SKIPPED: no matplotlib")
class ExampleTest(FolderTest):
    def run_example(self, name, *arguments):
        environment = {**os.environ, "MPLCONFIGDIR": os.getcwd()}
        done = subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *arguments], env=environment,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("plot.png", "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        return done.stdout

    def test_calibrate_a_block(self):
        out = self.run_example("calibrate_block.py", TRAJECTORY, CONTROL, "calibration.json", "plot.png", *STRIPS)
        self.assertRegex(out, r"boresight_roll +-\d+\.\d+ arcsec")
        self.assertTrue(pcl_als.read_calibration("calibration.json").converged)

    def test_check_a_delivery(self):
        out = self.run_example("check_delivery.py", "quality.json", "plot.png", *STRIPS)
        self.assertRegex(out, r"1 & 2: RMSDz 0\.\d+ m")
        self.assertTrue(os.path.getsize("quality.json") > 1000)

    def test_intensity_of_a_tile_without_trajectory(self):
        out = self.run_example("normalise_intensity.py", STRIPS[0], "normalised.las", "plot.png")
        self.assertIn("reconstructed", out)
        self.assertEqual(len(pcl_als.Survey(["normalised.las"])), len(pcl_als.Survey(STRIPS[:1])))


if __name__ == "__main__":
    unittest.main()
