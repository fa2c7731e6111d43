# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Wrong arguments are answered with one line; none ends the interpreter."""
import os
import subprocess
import sys
import unittest

import numpy as np

import pcl_als
from support import STRIPS, TRAJECTORY, FolderTest

PROGRAM = os.path.join(os.path.dirname(__file__), "wrong_arguments.py")


class EveryArgumentTest(FolderTest):
    def test_every_argument_of_every_function(self):
        first, wrong, ended, cases = 0, [], [], 0
        while len(ended) < 20:
            done = subprocess.run([sys.executable, PROGRAM, str(first)], capture_output=True, text=True, timeout=900)
            lines = done.stdout.splitlines()
            wrong += [line for line in lines if line.startswith("WRONG")]
            cases += sum(line[:1].isdigit() for line in lines)
            if lines and lines[-1] == "END":
                break
            self.assertTrue(lines, done.stderr)
            last = [line for line in lines if line[:1].isdigit()][-1]
            ended.append(f"{last}: exit status {done.returncode} {done.stderr[-300:]}")
            first = int(last.split()[0]) + 1
        self.assertEqual(ended, [])
        self.assertEqual(wrong, [], "\n".join(wrong[:40]))
        self.assertGreater(cases, 10_000)


class MessageTest(FolderTest):
    def assert_message(self, error, message, function, *args, **kwargs):
        with self.assertRaises(error) as caught:
            function(*args, **kwargs)
        self.assertEqual(str(caught.exception), message)

    def test_names_of_keywords(self):
        self.assert_message(TypeError, "calibrate(): unknown option 'contrl'; did you mean 'control'?",
                            pcl_als.calibrate, STRIPS, TRAJECTORY, contrl="control.csv")
        self.assert_message(TypeError, "CalibrationSettings(): unknown option 'thread'; did you mean 'threads'?",
                            pcl_als.CalibrationSettings, thread=2)
        self.assert_message(TypeError, "calibrate(): trajectory is missing", pcl_als.calibrate, STRIPS)
        self.assert_message(TypeError, "read_control(): unknown option 'zzz'; options are path", pcl_als.read_control, zzz=1)

    def test_values(self):
        self.assert_message(TypeError, "calibrate(): trajectory must be path, list of paths or Flight, not None",
                            pcl_als.calibrate, STRIPS, None)
        self.assert_message(TypeError, "CalibrationSettings.threads must be int, not 'two'",
                            setattr, pcl_als.CalibrationSettings(), "threads", "two")
        self.assert_message(TypeError, "PointWindow.bounds must be list of 4 float or None, not 3",
                            setattr, pcl_als.PointWindow(), "bounds", 3)
        self.assert_message(TypeError, "read_strips(): bounds must be list of 4 float or None, not list of int",
                            pcl_als.read_strips, STRIPS, bounds=[1, 2, 3])
        self.assert_message(TypeError, "empty_points(): count is out of range: -1", pcl_als.empty_points, -1)
        self.assert_message(TypeError, "this object was made without its __init__",
                            lambda: pcl_als.Strip.__new__(pcl_als.Strip).id)

    def test_nothing_in_a_list(self):
        for call in (lambda: pcl_als.read_trajectory([]), lambda: pcl_als.calibrate([], TRAJECTORY),
                     lambda: pcl_als.read_strips([]), lambda: pcl_als.convert([], "out"),
                     lambda: pcl_als.classify([], "map.tif"), lambda: pcl_als.Survey(iter(()))):
            with self.assertRaisesRegex(pcl_als.UsageError, "no .* given"):
                call()

    def test_remedies_name_arguments_of_the_function(self):
        with open("t.csv", "w") as file:
            file.write("a,b,c,d\n1,2,3,4\n2,3,4,5\n")
        with self.assertRaisesRegex(pcl_als.InputError, r"; columns=\.\.\. names the columns$") as caught:
            pcl_als.read_trajectory("t.csv")
        self.assertEqual(caught.exception.remedy, "columns")
        with self.assertRaisesRegex(pcl_als.InputError, r"; trajectory=read_trajectory\(\.\.\., columns=\.\.\.\)") as caught:
            pcl_als.calibrate(STRIPS, "t.csv")
        self.assertEqual(caught.exception.remedy, "trajectory")


if __name__ == "__main__":
    unittest.main()
