# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Scores of known estimates, with figures that were computed by hand."""
import math
import os
import pathlib
import sys
import unittest

import numpy

sys.path.insert(0, os.environ.get("PCL_ALS_BENCHMARK") or str(
    pathlib.Path(__file__).resolve().parents[2] / "share" / "benchmark"))
import blocks  # noqa: E402
import scoring  # noqa: E402

ROLL = {"name": "boresight_roll", "unit": "arcsec", "prior_std": 100.0, "mm_per_unit": 5.0}
LEVER = {"name": "lever_arm_x", "unit": "m", "prior_std": 0.05, "mm_per_unit": 1000.0}
TRUTH = {"boresight_roll": 10.0, "lever_arm_x": 0.02}


def grid(count, height=0.0):
    """Points on a line of 1 m in one cell of 20 m."""
    return numpy.stack([numpy.linspace(1.0, 2.0, count), numpy.full(count, 3.0),
                        numpy.full(count, height)], axis=1)


class IntervalScore(unittest.TestCase):
    def test_width_inside(self):
        self.assertAlmostEqual(scoring.interval_score(0.5, 1.0), 3.919928, places=6)

    def test_forty_times_the_distance_outside(self):
        # 3.919928 + 2 / 0.05 * (3 - 1.959964)
        self.assertAlmostEqual(scoring.interval_score(-3.0, 1.0), 45.521369, places=5)

    def test_the_true_deviation_is_best(self):
        # A proper score: of a normal error, the expectation is least for its own deviation.
        error = numpy.array([math.sqrt(2.0) * inverse_erf(2.0 * (i + 0.5) / 4000.0 - 1.0)
                             for i in range(4000)])
        means = [scoring.interval_score(error, std).mean() for std in (0.8, 0.9, 1.0, 1.1, 1.25)]
        self.assertEqual(min(means), means[2])


def inverse_erf(value):
    """By bisection."""
    low, high = -6.0, 6.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if math.erf(middle) < value else (low, middle)
    return low


class Parameters(unittest.TestCase):
    def test_one_outside_and_one_not_stated(self):
        rows, summary = scoring.score_parameters([ROLL, LEVER], TRUTH,
                                                 {"boresight_roll": (12.0, 0.5)})
        self.assertAlmostEqual(rows[0]["error_mm"], 10.0)
        self.assertAlmostEqual(rows[0]["error_over_std"], 4.0)
        self.assertFalse(rows[0]["inside"])
        # 5 * (2 * 0.979982 + 40 * (2 - 0.979982))
        self.assertAlmostEqual(rows[0]["interval_score_mm"], 213.80342, places=4)
        # The prior: 0 +- 0.05 m, wrong by 20 mm, width 2 * 1.959964 * 50 mm.
        self.assertAlmostEqual(rows[1]["error_mm"], -20.0)
        self.assertAlmostEqual(rows[1]["interval_score_mm"], 195.99640, places=4)
        self.assertAlmostEqual(summary["rms_error_mm"], 15.811388, places=5)
        self.assertAlmostEqual(summary["interval_score_mm"], 204.89991, places=4)
        self.assertEqual((summary["asked"], summary["stated"], summary["claimed"],
                          summary["inside"]), (2, 1, 1, 0))

    def test_without_a_deviation_only_the_error_counts(self):
        _, summary = scoring.score_parameters([ROLL], TRUTH, {"boresight_roll": (7.0, None)})
        self.assertAlmostEqual(summary["rms_error_mm"], 15.0)
        self.assertIsNone(summary["interval_score_mm"])
        self.assertEqual((summary["claimed"], summary["inside"]), (0, 0))

    def test_exact_value_with_deviation_zero(self):
        rows, summary = scoring.score_parameters([ROLL], TRUTH, {"boresight_roll": (10.0, 0.0)})
        self.assertTrue(rows[0]["inside"])
        self.assertEqual(summary["interval_score_mm"], 0.0)

    def test_effect_on_the_ground(self):
        effect = blocks.millimetres_per_unit
        # One arc-second at 1000 m is 4.848 mm; 40 degrees at 1000 m: RMS lateral 201.5 m.
        field = math.radians(40.0)
        self.assertAlmostEqual(effect("boresight_roll", 1000.0, field, 60.0), 4.848137, places=5)
        self.assertAlmostEqual(effect("channel1:boresight_heading", 1000.0, field, 60.0), 0.977060,
                               places=4)
        self.assertAlmostEqual(effect("scan_angle_scale", 1000.0, field, 60.0), 201533.0, delta=1)
        self.assertAlmostEqual(effect("time_offset", 1000.0, field, 60.0), 60.0)
        self.assertAlmostEqual(effect("range_bias", 1000.0, field, 60.0), 1000.0)


class Points(unittest.TestCase):
    def setUp(self):
        first, second = grid(10), grid(10, 5.0)
        self.strips = [
            (first, first + [0.030, 0.0, 0.0], numpy.full((10, 3), 0.020)),
            (second, second + [-0.010, 0.0, 0.040], numpy.full((10, 3), 0.005))]

    def test_errors(self):
        score = scoring.score_points(self.strips, 20.0)
        self.assertEqual(score["points"], 20)
        # sqrt((30^2 + 10^2 + 40^2) / 2), sqrt(40^2 / 2), |(-10, 0, 40)|
        self.assertAlmostEqual(score["rms_mm"], 36.055513, places=5)
        self.assertAlmostEqual(score["rms_height_mm"], 28.284271, places=5)
        self.assertAlmostEqual(score["p95_mm"], 41.231056, places=5)

    def test_common_translation(self):
        score = scoring.score_points(self.strips, 20.0)
        # The mean error is (10, 0, 20), what remains (20, 0, -20) and (-20, 0, 20).
        numpy.testing.assert_allclose(score["translation_mm"], [10.0, 0.0, 20.0], atol=1e-9)
        self.assertAlmostEqual(score["rms_shifted_mm"], 28.284271, places=5)
        self.assertAlmostEqual(score["rms_height_shifted_mm"], 20.0, places=9)

    def test_misfit_between_strips(self):
        score = scoring.score_points(self.strips, 20.0)
        # (30, 0, 0) - (-10, 0, 40) in the one cell.
        self.assertEqual(score["cells"], 1)
        self.assertAlmostEqual(score["misfit_mm"], 56.568542, places=5)
        self.assertAlmostEqual(score["misfit_height_mm"], 40.0, places=9)

    def test_no_misfit_without_a_common_cell(self):
        first, second = grid(10), grid(10) + [100.0, 0.0, 0.0]
        score = scoring.score_points([(first, first, None), (second, second, None)], 20.0)
        self.assertIsNone(score["misfit_mm"])
        self.assertEqual((score["rms_mm"], score["claimed_share"]), (0.0, 0.0))

    def test_cells_with_few_points_do_not_count(self):
        self.strips[0] = tuple(part[:7] for part in self.strips[0])
        self.assertEqual(scoring.score_points(self.strips, 20.0)["cells"], 0)

    def test_claims(self):
        score = scoring.score_points(self.strips, 20.0)
        # 1.96 * 20 mm covers all of the first strip, 1.96 * 5 mm of the second north alone.
        self.assertAlmostEqual(score["coverage_plan"], 0.75)
        self.assertAlmostEqual(score["coverage_height"], 0.5)
        # Widths 78.398561, 19.599640; outside by 10 - 9.799820 and 40 - 9.799820, times 40.
        self.assertAlmostEqual(score["interval_score_plan_mm"],
                               (2 * 78.398561 + 19.599640 + 8.007193 + 19.599640) / 4, places=4)
        self.assertAlmostEqual(score["interval_score_height_mm"],
                               (78.398561 + 19.599640 + 1208.007193) / 2, places=4)

    def test_points_without_a_claim(self):
        self.strips[1] = (*self.strips[1][:2], None)
        self.strips[0][2][:5] = numpy.nan
        score = scoring.score_points(self.strips, 20.0)
        self.assertAlmostEqual(score["claimed_share"], 0.25)
        self.assertEqual((score["coverage_plan"], score["coverage_height"]), (1.0, 1.0))


if __name__ == "__main__":
    unittest.main()
