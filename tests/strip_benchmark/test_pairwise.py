# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The chain of pairwise registrations, with a registration whose answer is known."""
import os
import pathlib
import shutil
import sys
import tempfile
import types
import unittest

import numpy

import las_writer

FOLDER = pathlib.Path(os.environ.get("PCL_ALS_BENCHMARK") or
                      pathlib.Path(__file__).resolve().parents[2] / "share" / "benchmark")
sys.path[:0] = [str(FOLDER), str(FOLDER / "methods")]
import lasfile  # noqa: E402
import pairwise  # noqa: E402

TURN = numpy.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def squares(first, last):
    """Points every 5 m in cells first to last of 10 m along x."""
    x = numpy.arange(10.0 * first + 2.5, 10.0 * last + 10.0, 5.0)
    return numpy.stack([x, numpy.full(len(x), 5.0), 100.0 + 0.1 * x], axis=1)


def shift(fixed, moving):
    """The translation between clouds of the same points in the same order."""
    if len(fixed) != len(moving):
        raise RuntimeError("other points")
    motion = numpy.eye(4)
    motion[:3, 3] = (fixed - moving).mean(axis=0)
    return motion


class Chain(unittest.TestCase):
    """Strip 2 overlaps strips 1 and 3, which do not overlap each other."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.true = [squares(0, 9), squares(5, 19), squares(13, 25)]
        self.block = types.SimpleNamespace(
            ids=["1", "2", "3"], strips=[self.folder / f"strip{i}.las" for i in (1, 2, 3)])
        for path, xyz, up in zip(self.block.strips, self.true, (0.1, 0.0, -0.3)):
            las_writer.write(path, xyz + [0.0, 0.0, up])

    def result(self):
        return [lasfile.LasFile(self.folder / "points" / path.name).xyz()
                for path in self.block.strips]

    def test_tree(self):
        strips = [pairwise.Strip(path) for path in self.block.strips]
        self.assertEqual(pairwise.spanning_tree(strips), [(1, 2), (1, 0)])

    def test_strips_come_together(self):
        self.assertEqual(pairwise.register(self.block, self.folder, shift, 1000), "")
        for found, true in zip(self.result(), self.true):
            numpy.testing.assert_allclose(found, true, atol=0.0011)

    def test_a_failure_is_noted(self):
        def fails(_fixed, _moving):
            raise ValueError("no pairs")
        note = pairwise.register(self.block, self.folder, fails, 1000)
        self.assertIn("3 to 2 (no pairs)", note)
        self.assertIn("1 to 2 (no pairs)", note)
        numpy.testing.assert_allclose(self.result()[0], self.true[0] + [0.0, 0.0, 0.1], atol=0.0011)

    def test_motion_turns_about_the_origin_of_the_block(self):
        motion = numpy.eye(4)
        motion[:3, :3], motion[:3, 3] = TURN, (1.0, 2.0, 3.0)
        # (2, 0, 0) from the origin becomes (0, 2, 0), and is shifted.
        numpy.testing.assert_allclose(
            pairwise.moved(motion, numpy.array([[12.0, 10.0, 5.0]]), numpy.array([10.0, 10.0, 5.0])),
            [[1.0, 4.0, 3.0]])


if __name__ == "__main__":
    unittest.main()
