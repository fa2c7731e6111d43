# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""What the tests of the Python package share: the simulated block, and a folder for each test."""
import glob
import os
import tempfile
import unittest

BLOCK = os.environ["PCL_ALS_BLOCK"]
BIN = os.environ["PCL_ALS_BIN"]
STRIPS = sorted(glob.glob(os.path.join(BLOCK, "strip*.las")))
TRAJECTORY = os.path.join(BLOCK, "trajectory.csv")
CONTROL = os.path.join(BLOCK, "control.csv")


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, in which it is run."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self._before = os.getcwd()
        os.chdir(self._folder.name)

    def tearDown(self):
        os.chdir(self._before)
        self._folder.cleanup()
