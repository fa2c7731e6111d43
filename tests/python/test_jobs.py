# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Each job gives what its tool gives."""
import filecmp
import json
import os
import pickle
import subprocess
import unittest

import numpy as np

import pcl_als
from support import BIN, BLOCK, CONTROL, STRIPS, TRAJECTORY, FolderTest


def tool(verb, *arguments):
    """Runs a tool; its status may be that of no reliable answer."""
    done = subprocess.run([os.path.join(BIN, "pcl_als_" + verb), *arguments, "-quiet"], capture_output=True, text=True)
    assert done.returncode in (0, 3), done.stderr


def content(name):
    with open(name) as file:
        return json.load(file)


class JobTest(FolderTest):
    def test_check(self):
        result = pcl_als.check(STRIPS, control=CONTROL, trajectory=TRAJECTORY)
        tool("check", *STRIPS, "-control", CONTROL, "-trajectory", TRAJECTORY, "-output", "tool.json")
        expected, found = content("tool.json"), result.to_dict()
        for each in (expected, found):  # what differs from run to run
            each.pop("peak_memory_mb", None)
            for pair in each["pairs"]:
                for key in ("milliseconds", "memory_mb"):
                    pair.pop(key, None)
        self.assertEqual(found, expected)
        self.assertTrue(result.reliable)
        self.assertEqual(result.reason, "")
        pair = result.block.pairs[0]
        self.assertGreater(pair.overlap_area, 1000)
        self.assertLessEqual(len(pair.sampled_offsets), 5000)
        self.assertIsNone(result.before)

    def test_check_of_before_and_after_in_memory(self):
        strips = pcl_als.read_strips(STRIPS[:2])
        for strip in strips[:1]:
            strip.points["z"] += 0.1
        result = pcl_als.check(pcl_als.read_strips(STRIPS[:2]), before=strips)
        raised = result.before.pairs[0].vertical.mean - result.block.pairs[0].vertical.mean
        # The same places and points, one strip 10 cm higher; the floats have steps below 0.1 mm.
        self.assertAlmostEqual(raised, 0.1, delta=0.005)

    def test_icpatch(self):
        result = pcl_als.icpatch(STRIPS[0], STRIPS[1])
        tool("icpatch", STRIPS[0], STRIPS[1], "-output", "tool.json")
        self.assertEqual(result.to_dict(), content("tool.json"))
        clouds = pcl_als.icpatch(*pcl_als.read_strips(STRIPS[:2]))
        self.assertLess(np.abs(clouds.values - result.values)[:3].max(), 0.005)
        self.assertEqual(result.covariance.shape, (6, 6))
        with self.assertRaisesRegex(ValueError, "^source and target: "):
            pcl_als.icpatch(STRIPS[0], pcl_als.read_strips(STRIPS[1:2])[0])

    def test_intensity(self):
        air = pcl_als.Atmosphere(visibility_km=48.3, temperature_c=29.8, pressure_kpa=101.81)
        settings = pcl_als.IntensitySettings(estimate=["strip_gains"])
        os.mkdir("python")
        result = pcl_als.correct_intensity(STRIPS, [os.path.join("python", os.path.basename(s)) for s in STRIPS],
                                           TRAJECTORY, settings=settings, atmosphere=air)
        tool("intensity", *STRIPS, "-corrected", "tool", "-trajectory", TRAJECTORY, "-estimate", "strip_gains",
             "-visibility", "48.3", "-temperature", "29.8", "-pressure", "101.81", "-output", "tool.json")
        for strip in map(os.path.basename, STRIPS):
            self.assertTrue(filecmp.cmp(os.path.join("tool", strip), os.path.join("python", strip), shallow=False))
        self.assertEqual(result.gains.keys(), pcl_als.Survey(STRIPS).points_by_strip.keys())
        self.assertEqual(result.to_dict()["model"], content("tool.json")["model"])
        self.assertEqual(sum(result.points_by_status.values()), len(pcl_als.Survey(STRIPS)))

    def test_waveforms(self):
        tool("simulate", "-preset", "small", "-scale", "0.2", "-density", "0.05", "-waveforms", "-output", "waves")
        flight = pcl_als.read_trajectory("waves/trajectory.csv")
        settings = pcl_als.WaveformSettings(pulse_width_ns=4, beam_divergence=0.5, correct_attenuation=True, threads=1)
        result = pcl_als.decompose_waveforms("waves/strip1.las", "python.las", settings=settings, trajectory=flight,
                                             atmosphere=pcl_als.Atmosphere(visibility_km=23), waveforms=[3, 17])
        tool("waveform", "waves/strip1.las", "tool.las", "-pulse_width", "4", "-trajectory", "waves/trajectory.csv",
             "-visibility", "23", "-beam_divergence", "0.5", "-correct_attenuation", "-output", "tool.json", "-waveforms", "3,17")
        self.assertTrue(filecmp.cmp("tool.las", "python.las", shallow=False))
        expected = content("tool.json")
        self.assertEqual(result.warnings, [each.replace("tool.wdp", "python.wdp") for each in expected["warnings"]])
        expected.update(output="python.las", warnings=result.warnings)
        self.assertEqual(result.to_dict(), expected)
        self.assertEqual([each["number"] for each in expected["waveforms"]], [3, 17])
        self.assertEqual(result.response[:, 1].max(), 1.0)
        self.assertEqual(result.calibration_constant, 1.0)
        self.assertRegex(repr(result), r"^<pcl_als.WaveformResult: \d+ echoes in \d+ waveforms, \d+ new>$")
        examples = pcl_als.decompose_waveforms("waves/strip1.las", "python.las", settings=settings)
        self.assertIsNone(examples.calibration_constant)
        self.assertEqual({1, 2} - {len(each["echoes"]) for each in examples.to_dict()["waveforms"]}, set())
        self.assertEqual(len(pickle.loads(pickle.dumps(result)).to_frame()["number"]), 2)
        with self.assertRaisesRegex(ValueError, "has no point 10000000"):
            pcl_als.decompose_waveforms("waves/strip1.las", "x.las", waveforms=[10000000])
        with self.assertRaisesRegex(ValueError, "range_from: 'pulse' is none of automatic, anchor, emitted"):
            pcl_als.WaveformSettings(range_from="pulse")

    def test_classification(self):
        sites = os.path.join(BLOCK, "training.csv"), os.path.join(BLOCK, "checkpoints.csv")
        result = pcl_als.classify(STRIPS, "python.tif", training=sites[0], checkpoints=sites[1])
        tool("classify", *STRIPS, "-training", sites[0], "-checkpoints", sites[1], "-output", "tool.tif",
             "-accuracy", "tool.json")
        self.assertTrue(filecmp.cmp("tool.tif", "python.tif", shallow=False))
        self.assertEqual(result.to_dict()["confusion"], content("tool.json")["confusion"])
        self.assertEqual(result.confusion.trace() / result.confusion.sum(), result.overall_accuracy)
        result.model.write("model.json")
        again = pcl_als.classify(STRIPS, "again.tif", model=pcl_als.read_class_model("model.json"))
        self.assertTrue(filecmp.cmp("again.tif", "python.tif", shallow=False))
        self.assertIsNone(again.overall_accuracy)

    def test_trajectory(self):
        flight = pcl_als.reconstruct_trajectory(STRIPS, output="python.csv")
        self.assertTrue(flight.reconstructed)
        tool("trajectory", *STRIPS, "-positions", "-output", "tool.csv")
        self.assertTrue(filecmp.cmp("tool.csv", "python.csv", shallow=False))
        true = pcl_als.read_trajectory(TRAJECTORY)
        self.assertEqual(flight.samples.shape[1], 7)
        self.assertGreaterEqual(flight.start_time, true.start_time)
        self.assertEqual([str(path) for path in pcl_als.convert_trajectory([TRAJECTORY], "copy.csv")], ["copy.csv"])
        self.assertEqual(len(pcl_als.read_trajectory("copy.csv")), len(true))

    def test_simulation(self):
        simulation = pcl_als.Simulation("small", scale=0.1, density=0.2, noise="range", seed=3)
        simulation.set_bias("boresight_roll", 60)
        self.assertAlmostEqual(simulation.bias("boresight_roll"), 60)
        pcl_als.simulate("python", simulation)
        tool("simulate", "-output", "tool", "-preset", "small", "-scale", "0.1", "-density", "0.2", "-noise", "range",
             "-seed", "3", "-bias", "boresight_roll=60")
        for name in os.listdir("tool"):
            self.assertTrue(filecmp.cmp(os.path.join("tool", name), os.path.join("python", name), shallow=False), name)

    def test_plan(self):
        with open("plan.csv", "w") as file:
            file.write("id,x1,y1,x2,y2,height\n1,0,0,3000,0,1000\n2,3000,0,0,0,1000\n3,0,0,3000,0,500\n4,3000,200,0,200,500\n")
        result = pcl_als.plan("plan.csv", control=5)
        tool("plan", "-lines", "plan.csv", "-control", "5", "-output", "tool.json")
        expected, found = content("tool.json"), result.to_dict()
        expected.pop("inputs"), found.pop("inputs")
        self.assertEqual(found, expected)
        line = pcl_als.FlightLine(id="1", start=[0, 0], end=[3000, 0], height=1000)
        other = pcl_als.FlightLine(id="2", start=[3000, 0], end=[0, 0], height=1000)
        # Two opposite lines of one height do not separate ranges from heights.
        wanted = pcl_als.CalibrationSettings(estimate=["lever_arm_x", "boresight_pitch", "range_bias"])
        result = pcl_als.plan([line, other], settings=wanted)
        self.assertFalse(result.determined)
        self.assertGreater(len(result.advice), 0)

    def test_lines(self):
        lines = pcl_als.extract_lines(STRIPS, output="python.csv")
        tool("lines", *STRIPS, "-output", "tool.csv")
        self.assertTrue(filecmp.cmp("tool.csv", "python.csv", shallow=False))
        with open("python.csv") as file:
            self.assertEqual(len(file.readlines()), len(lines) + 1)


if __name__ == "__main__":
    unittest.main()
