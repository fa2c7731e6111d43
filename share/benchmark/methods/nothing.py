#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Corrects nothing: the strips as delivered, the priors as they are given."""
import shutil

import adapter


def work(block, entry, _):
    adapter.write_parameters(entry, block.about, {
        parameter["name"]: (0.0, parameter["prior_std"])
        for parameter in block.about["parameters"]})
    (entry / "points").mkdir(exist_ok=True)
    for strip in block.strips:
        shutil.copyfile(strip, entry / "points" / strip.name)
    return {"method": "nothing (strips as delivered, priors)", "version": "-", "seconds": 0.0,
            "cpu_seconds": 0.0}


if __name__ == "__main__":
    adapter.run(work, __doc__)
