# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Airborne LiDAR calibration and quality control: the jobs of pcl_als in Python.

Lengths are metres, angles radians where nothing else is stated, times seconds; coordinates are
those of the ground frame of the points (easting, northing, height).
"""
from . import _pcl_als
from ._pcl_als import *  # noqa: F401,F403
from ._pcl_als import __version__

__all__ = sorted(name for name in vars(_pcl_als) if not name.startswith("_"))
