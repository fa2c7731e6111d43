# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Small LAS 1.4 files of point format 6, written by hand for the tests of the benchmark."""
import struct

import numpy

SCALE = 0.001


def write(path, xyz, times=None, extra=None, compressed=False):
    """xyz: metres, n x 3; extra: (name, values) of extra bytes of type double."""
    xyz, extra = numpy.asarray(xyz, float), extra or []
    times = numpy.arange(len(xyz), dtype=float) if times is None else numpy.asarray(times, float)
    length, described = 30 + 8 * len(extra), b""
    for name, _ in extra:
        described += struct.pack("<2xBB32s4x24x24x24x24x24x32s", 10, 0, name.encode(), b"")
    vlr = b""
    if extra:
        vlr = struct.pack("<H16sHH32s", 0, b"LASF_Spec", 4, len(described), b"") + described
    header = bytearray(375)
    header[0:4], header[24], header[25] = b"LASF", 1, 4
    struct.pack_into("<HIIBH", header, 94, 375, 375 + len(vlr), 1 if extra else 0,
                     6 | (0x80 if compressed else 0), length)
    struct.pack_into("<6d", header, 131, SCALE, SCALE, SCALE, 0.0, 0.0, 0.0)
    struct.pack_into("<Q", header, 247, len(xyz))
    fields = [("xyz", "<i4", 3), ("rest", "V10"), ("time", "<f8")]
    records = numpy.zeros(len(xyz), fields + [(name, "<f8") for name, _ in extra])
    records["xyz"], records["time"] = numpy.rint(xyz / SCALE), times
    for name, values in extra:
        records[name] = values
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(bytes(header) + vlr + records.tobytes())
