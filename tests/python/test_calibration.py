# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Calibration and correction: as the tools do, from files, surveys and strips in memory."""
import filecmp
import json
import os
import subprocess
import threading
import unittest

import numpy as np

import pcl_als
from support import BIN, CONTROL, STRIPS, TRAJECTORY, FolderTest

SMALL = dict(candidates=20_000)


class CalibrationTest(FolderTest):
    def test_as_the_tool(self):
        result = pcl_als.calibrate(STRIPS, TRAJECTORY, control=CONTROL)
        subprocess.run([os.path.join(BIN, "pcl_als_calibrate"), *STRIPS, "-trajectory", TRAJECTORY,
                        "-control", CONTROL, "-output", "tool.json", "-quiet"])
        with open("tool.json") as file:
            tool = json.load(file)
        self.assertEqual(result.to_dict(), tool)
        result.write("python.json")
        self.assertTrue(filecmp.cmp("python.json", "tool.json", shallow=False))
        self.assertEqual(pcl_als.read_calibration("tool.json").to_dict(), tool)
        roll = result.parameters["boresight_roll"]
        self.assertEqual(roll.unit, "arcsec")
        # The bias that was put in is -90 arc-seconds; four standard deviations are below 4.
        self.assertAlmostEqual(roll.bias, -90.0, delta=4.0)
        self.assertEqual(roll.bias, tool["instrument"]["parameters"]["boresight_roll"]["bias"])
        self.assertEqual(result.correlation.shape, (len(result.correlation_order),) * 2)
        self.assertEqual(result.verdict.usable, tool["instrument"]["verdict"]["status"] == "usable")
        self.assertIn("boresight_roll", str(result))
        instrument = result.instrument().to_dict()
        self.assertEqual(instrument["instrument"], tool["instrument"])
        self.assertEqual(instrument["flight"], {"strip_corrections": []})
        self.assertNotEqual(tool["flight"]["strip_corrections"], [])
        self.assertEqual(list(result.parameters)[:4],
                         ["lever_arm_x", "lever_arm_y", "lever_arm_z", "boresight_pitch"])

    def test_survey_and_strips_in_memory(self):
        settings = pcl_als.CalibrationSettings(**SMALL)
        survey = pcl_als.Survey(STRIPS)
        flight = pcl_als.read_trajectory(TRAJECTORY)
        self.assertTrue(flight.has_attitude)
        from_files = pcl_als.calibrate(survey, flight, settings=settings)
        again = pcl_als.calibrate(survey, pcl_als.Flight(flight.samples), settings=settings)
        self.assertEqual(again.to_dict()["instrument"]["parameters"],
                         from_files.to_dict()["instrument"]["parameters"])
        strips = pcl_als.read_strips(STRIPS)
        for strip in strips:
            pcl_als.write_pcd("cloud" + strip.id + ".pcd", strip)
        clouds = pcl_als.calibrate(strips, flight, settings=settings)
        files = pcl_als.calibrate(["cloud" + s.id + ".pcd" for s in strips], flight, settings=settings)
        self.assertEqual(clouds.to_dict()["instrument"]["parameters"], files.to_dict()["instrument"]["parameters"])

    def test_choice_of_strips_and_parameters(self):
        settings = pcl_als.CalibrationSettings(estimate=["boresight_roll"], **SMALL)
        result = pcl_als.calibrate(STRIPS, TRAJECTORY, settings=settings, strips=["1", "2"])
        self.assertEqual([(pair.a, pair.b) for pair in result.pairs], [("1", "2")])
        self.assertEqual(result.correlation_order, ["boresight_roll"])
        self.assertEqual(result.parameters["range_bias"].status, "fixed")

    def test_several_systems(self):
        settings = pcl_als.CalibrationSettings(systems=[("day1", ["1", "2", "3"]), ("day2", ["4", "5"])],
                                               own=["boresight_roll"], **SMALL)
        self.assertEqual(settings.own, ["boresight_roll"])
        result = pcl_als.calibrate(STRIPS, TRAJECTORY, control=CONTROL, settings=settings)
        self.assertEqual([system.name for system in result.systems], ["day1", "day2"])
        self.assertEqual(result.systems[1].strips, ["4", "5"])
        first, second = (system.parameters["boresight_roll"].bias for system in result.systems)
        self.assertEqual(first, result.parameters["boresight_roll"].bias)
        self.assertNotEqual(first, second)
        with self.assertRaisesRegex(ValueError, "roll"):
            pcl_als.CalibrationSettings(own=["roll"])

    def test_correction_of_files_and_strips(self):
        calibration = pcl_als.calibrate(STRIPS, TRAJECTORY, control=CONTROL)
        calibration.write("calibration.json")
        done = pcl_als.correct_file(STRIPS[0], "python.las", TRAJECTORY, "calibration.json", force=True)
        subprocess.run([os.path.join(BIN, "pcl_als_apply"), STRIPS[0], "tool.las", "-trajectory", TRAJECTORY,
                        "-calibration", "calibration.json", "-quiet", "-force"], check=True)
        self.assertTrue(filecmp.cmp("python.las", "tool.las", shallow=False))
        before = pcl_als.read_strips(STRIPS[:1])[0]
        self.assertEqual(done.points, len(before))
        after = pcl_als.correct_strip(before, TRAJECTORY, calibration)
        from_file = pcl_als.read_strips(["python.las"])[0]
        # Steps of the file are 1 mm, those of the floats less.
        self.assertLess(np.abs(after.ground() - from_file.ground()).max(), 2e-3)
        self.assertGreater(np.abs(after.ground() - before.ground()).max(), 0.05)

    def test_channels_in_an_extra_field(self):
        calibration = pcl_als.calibrate(STRIPS[:2], TRAJECTORY, settings=pcl_als.CalibrationSettings(**SMALL))
        content = calibration.to_dict()
        parameters = content["instrument"]["parameters"]
        strip, = pcl_als.read_strips(STRIPS[:1])
        system = {"parameters": parameters, "difference_std": {}, "offset_m": [0, 0, 0], "offset_std_m": [0, 0, 0]}
        none = {name: {**value, "bias": 0} for name, value in parameters.items()}
        content["instrument"]["systems"] = [
            {**system, "name": "a", "strips": [strip.id + ".ch3"]},
            {**system, "name": "b", "strips": [strip.id + ".ch4"], "parameters": none}]
        content["instrument"]["channel_field"] = "beam"
        with open("channels.json", "w") as file:
            json.dump(content, file)
        with self.assertRaisesRegex(pcl_als.UsageError, "field beam"):
            pcl_als.correct_strip(strip, TRAJECTORY, "channels.json")
        beams = np.arange(len(strip)) % 2 + 3
        strip.extra = {"beam": beams.astype("u2")}
        moved = pcl_als.correct_strip(strip, TRAJECTORY, "channels.json").ground() - strip.ground()
        expected = pcl_als.correct_strip(strip, TRAJECTORY, calibration).ground() - strip.ground()
        self.assertTrue(np.array_equal(moved[beams == 3], expected[beams == 3]))
        self.assertFalse(moved[beams == 4].any())
        self.assertTrue(expected.any(axis=1).all())


class ThreadTest(FolderTest):
    def test_two_jobs_in_two_threads(self):
        settings = pcl_als.CalibrationSettings(**SMALL)
        jobs = {"some": STRIPS[:3], "all": STRIPS}
        single = {name: pcl_als.calibrate(files, TRAJECTORY, settings=settings) for name, files in jobs.items()}
        running, both, results = set(), threading.Event(), {}

        def run(name):
            def progress(_):
                running.add(name)
                if len(running) == 2:
                    both.set()
                # Neither ends before both have begun: they do run at the same time.
                return both.wait(60)

            results[name] = pcl_als.calibrate(jobs[name], TRAJECTORY, settings=settings, progress=progress)

        threads = [threading.Thread(target=run, args=(name,)) for name in jobs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for name in jobs:
            self.assertEqual(results[name].to_dict(), single[name].to_dict())

    def test_one_survey_in_two_threads(self):
        settings = pcl_als.CalibrationSettings(**SMALL)
        survey, results = pcl_als.Survey(STRIPS), []
        single = pcl_als.calibrate(survey, TRAJECTORY, settings=settings).to_dict()

        def run():
            results.append(pcl_als.calibrate(survey, TRAJECTORY, settings=settings).to_dict())

        threads = [threading.Thread(target=run) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, [single, single])

    def test_other_threads_run_during_a_job(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(0.005):
                ticks.append(None)

        thread = threading.Thread(target=tick)
        thread.start()
        pcl_als.calibrate(STRIPS, TRAJECTORY, settings=pcl_als.CalibrationSettings(**SMALL))
        done.set()
        thread.join()
        self.assertGreater(len(ticks), 5)


if __name__ == "__main__":
    unittest.main()
