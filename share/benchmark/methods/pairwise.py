# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Strips of a block put together by a registration of pairs.

The strip with the most overlap is held fixed. The others are added along the spanning tree of
largest overlap: each is registered to the strip before it in the tree, as that one was moved, with
points of their overlap only, and the rigid motion is applied to all of its points. No trajectory
and no control are used, so that the position of the block is that of the fixed strip.
"""
import numpy

import adapter
from lasfile import LasFile

CELL = 10.0  # m, of the map of overlaps


class Strip:
    def __init__(self, path):
        self.las = LasFile(path)
        self.xyz = self.las.xyz()
        self.cells = cells_of(self.xyz)
        self.motion = numpy.eye(4)  # as the block has it, about the origin of the block


def cells_of(xyz):
    """One number for the cell of each point."""
    keys = numpy.floor(xyz[:, :2] / CELL).astype(numpy.int64)
    return keys[:, 0] * 10_000_000 + keys[:, 1]


def spanning_tree(strips):
    """(parent, child) in order of addition, from the strip with the most overlap."""
    sets = [set(numpy.unique(strip.cells).tolist()) for strip in strips]
    common = numpy.array([[len(a & b) if a is not b else 0 for b in sets] for a in sets])
    inside, edges = [int(common.sum(axis=1).argmax())], []
    while len(inside) < len(strips):
        outside = [i for i in range(len(strips)) if i not in inside]
        part = common[numpy.ix_(inside, outside)]
        a, b = numpy.unravel_index(part.argmax(), part.shape)
        if part[a, b] == 0:
            break  # strips that overlap no other stay where they are
        edges.append((inside[a], outside[b]))
        inside.append(outside[b])
    return edges


def overlap(strip, other, count, random):
    """At most count points of a strip where the other has points, moved as the strip is."""
    xyz = strip.xyz[numpy.isin(strip.cells, other.cells)]
    if len(xyz) > count:
        xyz = xyz[numpy.sort(random.choice(len(xyz), count, replace=False))]
    return xyz


def moved(motion, xyz, origin):
    return (xyz - origin) @ motion[:3, :3].T + motion[:3, 3]


def register(block, entry, align, count):
    """align(fixed, moving) returns the 4 x 4 motion of moving onto fixed, both n x 3, metres from
    an origin in the block. Writes the corrected strips; returns a note on pairs that failed."""
    random = numpy.random.default_rng(1)
    strips = [Strip(path) for path in block.strips]
    origin = numpy.floor(strips[0].xyz.mean(axis=0))
    failed = []
    for parent, child in spanning_tree(strips):
        fixed = overlap(strips[parent], strips[child], count, random)
        moving = overlap(strips[child], strips[parent], count, random)
        start = strips[parent].motion
        try:
            motion = align(moved(start, fixed, origin), moved(start, moving, origin))
            strips[child].motion = motion @ start
        except (ArithmeticError, RuntimeError, ValueError) as error:
            strips[child].motion = start
            failed.append(f"{block.ids[child]} to {block.ids[parent]} ({error})")
    (entry / "points").mkdir(exist_ok=True)
    for path, strip in zip(block.strips, strips):
        strip.las.set_xyz(moved(strip.motion, strip.xyz, origin) + origin)
        strip.las.write(entry / "points" / path.name)
    return "pairs that failed: " + "; ".join(failed) if failed else ""


def run(description, method, version, align, count):
    def work(block, entry, _):
        note = register(block, entry, align, count)
        return {"method": method, "version": version, "note": note}
    adapter.run(work, description)
