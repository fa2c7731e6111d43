#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Writes a block of many vertical images over roofs, for the time of pcl_als_orient.

    tests/benchmarks/large_image_block.py FOLDER [--images 500] [--roofs 2000] [--rays 20000]
        [--blunders SHARE]

images.csv, measurements.csv, camera.json and lines.csv of a flight at 1000 m with 60 % overlap
along and 30 % across, with a 100 mm camera and image coordinates of 2 micrometres. Half of the
rays are places on lines, two for a roof and image; the others are tie points. A share of the rays
is displaced by 0.1 to 4 mm. Needs python3-numpy.
"""
import argparse
import json
import pathlib

import numpy

FOCAL, HALF = 100.0, numpy.array([27.0, 20.0])  # mm
HEIGHT, BASE, SPACING = 1000.0, 160.0, 378.0  # m
SIGMA, LINE_SIGMA = 0.002, 0.04  # mm, m


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--images", type=int, default=500)
    parser.add_argument("--roofs", type=int, default=2000)
    parser.add_argument("--rays", type=int, default=20000)
    parser.add_argument("--blunders", type=float, default=0.0)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    random = numpy.random.default_rng(1)
    rows = int(numpy.ceil(numpy.sqrt(arguments.images * SPACING / BASE)))
    origin = numpy.array([500000.0, 5400000.0, 200.0])
    number = numpy.arange(arguments.images)
    centres = numpy.stack([number // rows * SPACING, number % rows * BASE,
                           numpy.full(arguments.images, HEIGHT)], 1)
    extent = centres[:, :2].max(axis=0)
    with open(arguments.folder / "images.csv", "w") as file:
        file.write("image,x,y,z,omega,phi,kappa\n")
        for i, centre in enumerate(centres):
            given = origin + centre + random.normal(0, 0.5, 3)
            angles = random.normal(0, 0.02, 3)
            file.write(f"I{i}," + ",".join(f"{v:.4f}" for v in given) + ","
                       + ",".join(f"{v:.5f}" for v in angles) + "\n")

    def ray(i, kind, feature, at):
        if random.uniform() < arguments.blunders:
            at = at - numpy.sign(at) * random.uniform(0.1, 4.0, 2)
        return f"I{i},{kind},{feature},{at[0]:.5f},{at[1]:.5f},{SIGMA}\n"

    def seen(places):
        """Image coordinates of places in the images that see all of them."""
        for i, centre in enumerate(centres):
            at = FOCAL * (places[:, :2] - centre[:2]) / (centre[2] - places[:, 2:])
            if (numpy.abs(at) < HALF - 0.5).all():
                yield i, at + random.normal(0, SIGMA, at.shape)

    records, lines = [], []
    for roof in range(arguments.roofs):
        middle = numpy.array([*random.uniform(0, extent), random.uniform(-20, 20)])
        azimuth, half = random.uniform(0, numpy.pi), random.uniform(4, 9)
        along = half * numpy.array([numpy.cos(azimuth), numpy.sin(azimuth), 0])
        left = numpy.array([-numpy.sin(azimuth), numpy.cos(azimuth), 0])
        ends = [middle + sign * along + origin + random.normal(0, LINE_SIGMA) * left
                + random.normal(0, LINE_SIGMA) * numpy.array([0, 0, 1]) for sign in (-1, 1)]
        lines.append(f"R{roof}," + ",".join(f"{v:.4f}" for v in numpy.concatenate(ends))
                     + f",{LINE_SIGMA}\n")
        images = list(seen(middle + numpy.outer(random.uniform(-1, 1, 2), along)))
        most = max(2, arguments.rays // (4 * arguments.roofs))
        for i, at in (images[k] for k in random.permutation(len(images))[:most]):
            records += [ray(i, "line", f"R{roof}", place) for place in at]
    point = 0
    while len(records) < arguments.rays:
        place = numpy.array([*random.uniform(-80, extent + 80), random.uniform(-30, 30)])
        images = list(seen(place[None]))
        if len(images) < 2:
            continue
        records += [ray(i, "point", f"P{point}", at[0]) for i, at in images]
        point += 1
    (arguments.folder / "measurements.csv").write_text(
        "image,kind,feature,x,y,sigma\n" + "".join(records))
    (arguments.folder / "lines.csv").write_text("id,x1,y1,z1,x2,y2,z2,sigma\n" + "".join(lines))
    (arguments.folder / "camera.json").write_text(json.dumps(
        {"format": "pcl_als camera", "version": 1, "focal_length_mm": FOCAL,
         "image_size_mm": list(2 * HALF)}))
    print(f"{arguments.images} images, {arguments.roofs} roofs, {len(records)} rays, "
          f"{point} points in {arguments.folder}")


if __name__ == "__main__":
    main()
