# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Points as numpy arrays: what is a view, what is a copy, and how long both live."""
import gc
import os
import unittest

import numpy as np

import pcl_als
from support import BIN, STRIPS, FolderTest


def address(array):
    return array.__array_interface__["data"][0]


class ViewTest(FolderTest):
    def test_view_is_the_memory_of_the_strip(self):
        strip = pcl_als.read_strips(STRIPS[:1])[0]
        points = strip.points
        self.assertEqual(points.dtype, pcl_als.POINT)
        self.assertEqual(points.dtype.itemsize, 48)
        self.assertEqual(address(points), address(strip.points))
        points["intensity"][7] = 123.0
        self.assertEqual(strip.points["intensity"][7], 123.0)

    def test_view_outlives_the_strip(self):
        strip = pcl_als.read_strips(STRIPS[:1])[0]
        points, total = strip.points, float(strip.points["z"].sum())
        del strip
        gc.collect()
        np.zeros(1_000_000)  # memory that was given back would be used again
        self.assertEqual(float(points["z"].sum()), total)

    def test_ten_million_points_without_a_copy(self):
        points = pcl_als.empty_points(10_000_000)
        points["x"] = np.arange(10_000_000) % 1000
        strip = pcl_als.Strip(points, id="7", origin=[700000, 5660000, 1000])
        self.assertEqual(address(strip.points), address(points))
        again = pcl_als.Strip(strip.points)
        self.assertEqual(address(again.points), address(points))
        self.assertEqual(len(again), 10_000_000)
        self.assertEqual(again.points["x"][1234], 234)

    def test_parts_and_other_layouts_are_copied(self):
        points = pcl_als.empty_points(100)
        points["x"] = np.arange(100)
        for part in (points[10:], points[::-1], points[["x", "y", "z"]], points.copy()):
            strip = pcl_als.Strip(part)
            self.assertNotEqual(address(strip.points), address(points))
            self.assertEqual(list(strip.points["x"]), list(part["x"]))
        other = np.zeros(3, dtype=[("z", "f8"), ("x", "f8"), ("y", "f8"), ("gps_time", "f8"), ("q", "i4")])
        other["gps_time"], other["y"] = [1.5, 2.5, 3.5], [9, 8, 7]
        strip = pcl_als.Strip(other)
        self.assertEqual(list(strip.points["gps_time"]), [1.5, 2.5, 3.5])
        self.assertEqual(list(strip.points["y"]), [9, 8, 7])
        self.assertEqual(list(strip.points["return_number"]), [1, 1, 1])

    def test_arrays_that_are_no_points(self):
        for wrong in (np.zeros(3), np.zeros((2, 2), pcl_als.POINT), np.zeros(3, [("x", "f4"), ("y", "f4")])):
            with self.assertRaisesRegex(ValueError, "^points: "):
                pcl_als.Strip(wrong)

    def test_ground_coordinates_are_in_double(self):
        strip = pcl_als.Strip(pcl_als.empty_points(2), origin=[700000, 5660000, 1000])
        strip.points["x"] = [0.25, 1.5]
        self.assertEqual(strip.ground().tolist(), [[700000.25, 5660000, 1000], [700001.5, 5660000, 1000]])

    def test_pcd_keeps_every_field(self):
        strip = pcl_als.read_strips(STRIPS[:1])[0]
        pcl_als.write_pcd("a.pcd", strip)
        again = pcl_als.read_strips(["a.pcd"])[0]
        self.assertEqual(again.id, strip.id)
        self.assertEqual(again.origin.tolist(), strip.origin.tolist())
        for name in pcl_als.POINT.names:
            self.assertTrue(np.array_equal(again.points[name], strip.points[name]), name)

    def test_conversion_and_parts_of_files(self):
        made = pcl_als.convert(STRIPS[:1], "a.laz")
        self.assertEqual([str(file.path) for file in made], ["a.laz"])
        survey = pcl_als.Survey(["a.laz"])
        self.assertEqual(len(survey), made[0].points)
        west, south, east, north = survey.extent
        half = pcl_als.PointWindow(bounds=[west, south, (west + east) / 2, north])
        part = pcl_als.convert(["a.laz"], "part.las", window=half)[0].points
        self.assertTrue(0 < part < made[0].points)
        with self.assertRaises(TypeError):
            pcl_als.PointWindow(bound=None)


class ErrorTest(FolderTest):
    def test_missing_and_corrupt_files(self):
        with self.assertRaisesRegex(OSError, "missing.las") as caught:
            pcl_als.Survey(["missing.las"])
        self.assertIsInstance(caught.exception, pcl_als.InputError)
        self.assertIsInstance(caught.exception, pcl_als.Error)
        with open("short.las", "wb") as file:
            file.write(b"LASF" + bytes(100))
        with self.assertRaisesRegex(pcl_als.InputError, "short.las"):
            pcl_als.read_strips(["short.las"])

    def test_wrong_arguments(self):
        with self.assertRaisesRegex(ValueError, "estimate: 'roll'") as caught:
            pcl_als.CalibrationSettings(estimate=["roll"])
        self.assertIsInstance(caught.exception, pcl_als.UsageError)
        with self.assertRaisesRegex(ValueError, "attitude: 'maybe' is none of 'where_given'"):
            pcl_als.read_trajectory("t.csv", attitude="maybe")

    def test_remedy_names_the_argument(self):
        with open("t.csv", "w") as file:
            file.write("a,b,c,d\n1,2,3,4\n2,3,4,5\n")
        with self.assertRaisesRegex(pcl_als.InputError, "columns=") as caught:
            pcl_als.read_trajectory("t.csv")
        self.assertEqual(caught.exception.remedy, "columns")


if __name__ == "__main__":
    unittest.main()
