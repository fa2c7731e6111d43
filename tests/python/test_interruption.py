# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Progress callbacks, cancellation and Ctrl-C: nothing half written is left."""
import os
import signal
import subprocess
import sys
import time
import unittest

import pcl_als
from support import CONTROL, STRIPS, TRAJECTORY, FolderTest

# A block of eleven million points, which takes longer than the test waits before it interrupts.
INTERRUPTED = """
import sys, pcl_als
def progress(p):
    print(p.event, flush=True)
try:
    pcl_als.simulate("block", pcl_als.Simulation("paper"), threads=1, progress=progress)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(9)
"""


def unfinished():
    return [name for _, _, names in os.walk(".") for name in names if ".partial" in name]


class ProgressTest(FolderTest):
    def test_phases_are_reported_in_the_calling_thread(self):
        seen = []
        pcl_als.check(STRIPS[:2], progress=lambda p: seen.append((p.event, p.phase, p.fraction)))
        self.assertEqual({event for event, _, _ in seen} - {"begin", "advance", "end", "remark"}, set())
        self.assertTrue(all(0 <= fraction <= 1 for _, _, fraction in seen))
        self.assertGreater(len({phase for _, phase, _ in seen}), 1)

    def test_false_cancels(self):
        for job in (lambda p: pcl_als.convert(STRIPS, "out", progress=p),
                    lambda p: pcl_als.calibrate(STRIPS, TRAJECTORY, control=CONTROL, progress=p),
                    lambda p: pcl_als.check(STRIPS, progress=p),
                    lambda p: pcl_als.icpatch(STRIPS[0], STRIPS[1], progress=p),
                    lambda p: pcl_als.correct_intensity(STRIPS[:1], ["i.las"], TRAJECTORY, progress=p),
                    lambda p: pcl_als.reconstruct_trajectory(STRIPS, output="t.csv", progress=p),
                    lambda p: pcl_als.simulate("block", pcl_als.Simulation("small", scale=0.1), progress=p)):
            with self.assertRaises(pcl_als.Cancelled):
                job(lambda progress: False)
        self.assertEqual([name for _, _, names in os.walk(".") for name in names], [])

    def test_jobs_end_while_they_read(self):
        survey = pcl_als.Survey(STRIPS)
        for phase, job in (("Surveying the block", lambda p: pcl_als.calibrate(survey, TRAJECTORY, progress=p)),
                           ("Reading the areas", lambda p: pcl_als.calibrate(survey, TRAJECTORY, progress=p)),
                           ("Surveying the block", lambda p: pcl_als.check(survey, progress=p)),
                           ("Reading the areas", lambda p: pcl_als.check(survey, progress=p)),
                           ("Collecting rays and scan angles",
                            lambda p: pcl_als.reconstruct_trajectory(survey, progress=p))):
            with self.assertRaises(pcl_als.Cancelled):
                job(lambda p: not (p.event == "advance" and p.phase == phase))
        # The survey serves further jobs.
        self.assertGreater(len(pcl_als.check(survey).block.pairs), 0)

    def test_exceptions_pass_through(self):
        class Own(Exception):
            pass

        def progress(p):
            if p.event == "end":
                raise Own(p.phase)

        with self.assertRaises(Own):
            pcl_als.check(STRIPS[:2], progress=progress)


class InterruptTest(FolderTest):
    def interrupt(self, program, seconds):
        process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                   text=True)
        process.stdout.readline()  # the job has begun
        time.sleep(seconds)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=120)
        return process.returncode, out

    def test_interrupt_leaves_no_temporary_file(self):
        for seconds in (0.0, 0.3, 1.0):
            status, out = self.interrupt(INTERRUPTED, seconds)
            self.assertEqual(status, 9, out)
            self.assertTrue(out.endswith("interrupted\n"), out)
            self.assertEqual(unfinished(), [])
            self.assertFalse(os.path.exists("block/truth.json"), "the job was not interrupted")

    def test_interrupt_without_a_callback(self):
        program = ("import pcl_als\nprint('begin', flush=True)\n"
                   "pcl_als.simulate('block', pcl_als.Simulation('paper'), threads=1)\n")
        status, _ = self.interrupt(program, 1.0)
        self.assertIn(status, (-signal.SIGINT, 1, 130))
        self.assertEqual(unfinished(), [])
        self.assertFalse(os.path.exists("block/truth.json"), "the job was not interrupted")


if __name__ == "__main__":
    unittest.main()
