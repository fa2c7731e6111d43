# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Airborne LiDAR calibration and quality control: the jobs of pcl_als in Python.

Lengths are metres, angles radians where nothing else is stated, times seconds; coordinates are
those of the ground frame of the points (easting, northing, height).
"""
from . import _arguments, _results
from ._pcl_als import __version__

_names = _arguments.check_module()
_results.add_to_module()
globals().update(_names)
__all__ = sorted(_names)
