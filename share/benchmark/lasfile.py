# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Uncompressed LAS 1.2 to 1.4: what the benchmark needs of it, with numpy only."""
import pathlib

import numpy

# Of the point formats 0 to 10: bytes of a record, and where the GPS time is (-1: none).
LENGTHS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
TIMES = (-1, 20, -1, 20, 20, 20, 22, 22, 22, 22, 22)
# Types of extra bytes, from 1 to 10.
TYPES = ("u1", "i1", "<u2", "<i2", "<u4", "<i4", "<u8", "<i8", "<f4", "<f8")


class Unusable(Exception):
    """A file that cannot be used; the message names it."""


class LasFile:
    """The point records of a file, and its header."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        try:
            self.data = bytearray(self.path.read_bytes())
        except OSError as error:
            raise Unusable(f"{path}: cannot be read: {error.strerror}") from error
        data = self.data
        if len(data) < 227 or data[:4] != b"LASF":
            raise Unusable(f"{path}: is no LAS file")
        if data[24] != 1 or not 2 <= data[25] <= 4:
            raise Unusable(f"{path}: LAS {data[24]}.{data[25]}; the benchmark reads 1.2 to 1.4")
        if data[104] & 0xC0:
            raise Unusable(f"{path}: is compressed (LAZ); write it as LAS")
        self.format = data[104]
        if self.format >= len(LENGTHS):
            raise Unusable(f"{path}: point format {self.format} is not known")
        self.start, self.length = self._number(96, 4), self._number(105, 2)
        self.count = self._number(247, 8) if data[25] == 4 else self._number(107, 4)
        if self.length < LENGTHS[self.format]:
            raise Unusable(f"{path}: records of {self.length} bytes are too short for point format "
                           f"{self.format}")
        if len(data) < self.start + self.count * self.length:
            raise Unusable(f"{path}: ends before its {self.count} points do")
        self.scale, self.offset = numpy.frombuffer(data, "<f8", 6, 131).copy().reshape(2, 3)

    def _number(self, at, size):
        return int.from_bytes(self.data[at:at + size], "little")

    def _field(self, at, kind):
        records = numpy.dtype({"names": ["value"], "formats": [kind], "offsets": [at],
                               "itemsize": self.length})
        return numpy.frombuffer(self.data, records, self.count, self.start)["value"]

    def xyz(self):
        """Coordinates, n x 3, in the unit of the file."""
        whole = numpy.stack([self._field(4 * axis, "<i4") for axis in range(3)], axis=1)
        return whole * self.scale + self.offset

    def set_xyz(self, xyz):
        """Writes coordinates into the records, rounded to the scale of the file."""
        whole = numpy.rint((xyz - self.offset) / self.scale)
        if not numpy.all(numpy.abs(whole) < 2**31):  # NaN fails, too
            raise Unusable(f"{self.path}: coordinates are no numbers or too large for its scale")
        for axis in range(3):
            self._field(4 * axis, "<i4")[:] = whole[:, axis].astype("<i4")

    def time(self):
        """GPS time of every point; None where the point format has none."""
        at = TIMES[self.format]
        return None if at < 0 else self._field(at, "<f8")

    def _extra_fields(self):
        """Name: (place in the record, type, scale, offset) of the extra bytes."""
        fields, at, place = {}, self._number(94, 2), LENGTHS[self.format]
        for _ in range(self._number(100, 4)):
            size, number = self._number(at + 20, 2), self._number(at + 18, 2)
            user = bytes(self.data[at + 2:at + 18]).rstrip(b"\0")
            for record in range(at + 54, at + 54 + size, 192):
                if user != b"LASF_Spec" or number != 4:
                    break
                kind, options = self.data[record + 2], self.data[record + 3]
                if not 1 <= kind <= 10:
                    place += options if kind == 0 else 0
                    continue
                name = bytes(self.data[record + 4:record + 36]).split(b"\0")[0].decode("latin1")
                scale, offset = numpy.frombuffer(self.data, "<f8", 1, record + 112)[0], 0.0
                if options & 16:
                    offset = numpy.frombuffer(self.data, "<f8", 1, record + 136)[0]
                fields[name] = (place, TYPES[kind - 1], scale if options & 8 else 1.0, offset)
                place += numpy.dtype(TYPES[kind - 1]).itemsize
            at += 54 + size
        return fields

    def extra(self, name):
        """The values of a field of extra bytes, or None."""
        field = self._extra_fields().get(name)
        if field is None:
            return None
        at, kind, scale, offset = field
        return self._field(at, kind) * scale + offset

    def write(self, path):
        """Writes the file under another name, complete or not at all."""
        path = pathlib.Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(path.name + ".part")
        part.write_bytes(self.data)
        part.replace(path)
