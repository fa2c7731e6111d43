# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Strips from arrays, and files from strips."""
import glob
import os
import pathlib
import unittest

import numpy as np

import pcl_als
from support import STRIPS, TRAJECTORY, FolderTest


def map_points(count=1000, dtype="f8"):
    """Points at UTM coordinates, 1 m apart, with heights in millimetres."""
    points = np.zeros(count, [("x", dtype), ("y", dtype), ("z", dtype), ("gps_time", "f8"), ("intensity", "u2")])
    points["x"], points["y"] = 583_000 + np.arange(count), 5_283_100.125
    points["z"], points["gps_time"], points["intensity"] = 498.123, 2.4e8 + np.arange(count), np.arange(count)
    return points


def ground_of(points):
    return np.stack([points["x"], points["y"], points["z"]], axis=1)


class OriginTest(unittest.TestCase):
    def test_map_coordinates_keep_their_millimetres(self):
        points = map_points()
        strip = pcl_als.Strip(points)
        self.assertEqual(strip.origin.tolist(), [583_500, 5_283_100, 500])
        # Steps of floats up to 512 m from the origin are 0.03 mm.
        self.assertLess(np.abs(strip.ground() - ground_of(points)).max(), 1e-4)

    def test_an_origin_for_map_coordinates_is_refused(self):
        with self.assertRaisesRegex(ValueError, "5283100 m from the origin, where 32-bit floats have steps of 0.5 m"):
            pcl_als.Strip(map_points(), origin=[0, 0, 0])

    def test_float32_cannot_hold_map_coordinates(self):
        with self.assertRaisesRegex(ValueError, "^points: coordinates reach"):
            pcl_als.Strip(map_points(dtype="f4"))

    def test_coordinates_near_zero_need_no_origin(self):
        points = map_points(100)
        points["x"] -= 583_000
        points["y"] -= 5_283_000
        self.assertEqual(pcl_als.Strip(points).origin.tolist(), [0, 0, 0])
        relative = pcl_als.Strip(points, origin=[583_000, 5_283_000, 0])
        self.assertEqual(relative.ground()[:, 0].tolist(), map_points(100)["x"].tolist())

    def test_strips_that_are_too_long_are_refused(self):
        points = map_points()
        points["x"] += np.arange(1000) * 40.0
        with self.assertRaisesRegex(ValueError, "in parts$"):
            pcl_als.Strip(points)


class WritingTest(FolderTest):
    def test_las_and_laz_from_memory(self):
        points = map_points()
        strip = pcl_als.Strip(points, id="7", crs="EPSG:25832")
        for name in ("o.laz", "o.las", pathlib.Path("path.laz")):
            pcl_als.write_points(name, strip)
            again, = pcl_als.read_strips(name)
            self.assertEqual(again.id, "7")
            self.assertIn("25832", again.crs)
            self.assertLess(np.abs(again.ground() - ground_of(points)).max(), 0.0006)  # steps of 1 mm
            for field in ("gps_time", "intensity"):
                self.assertEqual(again.points[field].tolist(), points[field].tolist())
            with open(name, "rb") as file:
                self.assertEqual(file.read(4), b"LASF")

    def test_write_pcd_writes_pcd_only(self):
        with self.assertRaisesRegex(ValueError, "^o.las: is not .pcd; write_points"):
            pcl_als.write_pcd("o.las", pcl_als.Strip(map_points()))
        with self.assertRaisesRegex(ValueError, "^o.xyz: is neither"):
            pcl_als.write_points("o.xyz", pcl_als.Strip(map_points()))
        self.assertEqual(os.listdir(), [])

    def test_colours_and_extra_bytes(self):
        strip = pcl_als.Strip(map_points(), id="7")
        values = {"red": np.arange(1000, dtype="u2"), "nir": np.full(1000, 65535, "u2"),
                  "reflectance": np.linspace(-1, 1, 1000, dtype="f4"), "echo id": np.arange(1000, dtype="u4")}
        strip.extra = values
        pcl_als.write_points("o.laz", strip)
        self.assertEqual(dict(pcl_als.read_strips("o.laz")[0].extra), {})
        again, = pcl_als.read_strips("o.laz", extra=True)
        for name, expected in values.items():
            self.assertEqual(again.extra[name].dtype, expected.dtype)
            self.assertTrue(np.array_equal(again.extra[name], expected), name)
        self.assertEqual(list(pcl_als.read_strips("o.laz", extra=["red", "echo id"])[0].extra), ["red", "echo id"])
        with self.assertRaisesRegex(OSError, "has no field 'width'; it has red, green, blue, nir, refl"):
            pcl_als.read_strips("o.laz", extra=["width"])

    def test_extra_cannot_be_changed_in_place(self):
        strip = pcl_als.Strip(map_points(3))
        strip.extra = {"width": [1.0, 2.0, 3.0]}
        with self.assertRaises(TypeError):
            strip.extra["width"] = np.zeros(3)
        with self.assertRaises(ValueError):
            strip.extra["width"][0] = 5.0
        for wrong in ({"width": [1.0]}, {"x": [1.0] * 3}, {"width": ["a"] * 3}, {"width": np.zeros((3, 2))}):
            with self.assertRaisesRegex(ValueError, "^extra: "):
                strip.extra = wrong
        self.assertEqual(strip.extra["width"].tolist(), [1, 2, 3])

    def test_fields_of_an_array_that_points_lack_become_extra(self):
        points = np.zeros(3, [("x", "f8"), ("y", "f8"), ("z", "f8"), ("amplitude", "i2")])
        points["amplitude"] = [-1, 0, 300]
        strip = pcl_als.Strip(points)
        self.assertEqual(strip.extra["amplitude"].tolist(), [-1, 0, 300])

    def test_part_of_files(self):
        west, south, east, north = pcl_als.Survey(STRIPS[:1]).extent
        middle = (west + east) / 2
        whole, = pcl_als.read_strips(STRIPS[0])
        part, = pcl_als.read_strips(STRIPS[0], bounds=(west, south, middle, north))
        self.assertEqual(len(part), int((whole.ground()[:, 0] <= middle).sum()))
        window = pcl_als.PointWindow(bounds=[west, south, middle, north])
        self.assertEqual(len(pcl_als.read_strips(STRIPS[0], window=window)[0]), len(part))
        with self.assertRaisesRegex(ValueError, "^bounds: "):
            pcl_als.read_strips(STRIPS[0], bounds=(east, south, west, north))

    def test_corrected_strips_keep_their_extra_fields(self):
        strip, = pcl_als.read_strips(STRIPS[0])
        strip.extra = {"number": np.arange(len(strip), dtype="u4")}
        biases = pcl_als.plan([pcl_als.FlightLine(id=str(i), start=[0, 0], end=[3000, 99 * i], height=1000) for i in (1, 2)])
        try:
            corrected = pcl_als.correct_strip(strip, TRAJECTORY, biases.expected)
        except pcl_als.UsageError as error:  # a plan does not determine everything
            self.skipTest(str(error))
        self.assertEqual(corrected.extra["number"][-1], len(strip) - 1)


class PathTest(FolderTest):
    def test_paths_of_all_kinds(self):
        expected = len(pcl_als.Survey(STRIPS))
        for files in (tuple(STRIPS), [pathlib.Path(path) for path in STRIPS], (path for path in STRIPS), np.array(STRIPS),
                      set(STRIPS), glob.iglob(os.path.join(os.path.dirname(STRIPS[0]), "strip*.las")),
                      pathlib.Path(STRIPS[0]).parent.glob("strip*.las"), {path: 1 for path in STRIPS}.keys()):
            self.assertEqual(len(pcl_als.Survey(files)), expected)
        self.assertEqual(len(pcl_als.Survey(STRIPS[0])), len(pcl_als.Survey(STRIPS[:1])))
        self.assertEqual([str(file.path) for file in pcl_als.convert(pathlib.Path(STRIPS[0]), "a.laz")], ["a.laz"])
        self.assertEqual(len(pcl_als.read_trajectory(iter([TRAJECTORY]))), len(pcl_als.read_trajectory(TRAJECTORY)))

    def test_lists_of_other_things(self):
        settings = pcl_als.CalibrationSettings(estimate=(name for name in ["boresight_roll"]))
        settings.fixed = {"1"}
        self.assertEqual((settings.estimate, settings.fixed), (["boresight_roll"], ["1"]))
        for strips in (["1", "2"], ("1", "2"), iter(["1", "2"]), np.array(["1", "2"]), pcl_als.StripChoice(only=["1", "2"])):
            self.assertEqual(len(pcl_als.check(STRIPS, strips=strips).block.pairs), 1)
        strips = pcl_als.read_strips(STRIPS[:2])
        self.assertEqual(len(pcl_als.check(strip for strip in strips).block.pairs), 1)


if __name__ == "__main__":
    unittest.main()
