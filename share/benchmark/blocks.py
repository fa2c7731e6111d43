# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The twelve blocks: how they are flown, what is given of them, and what is asked."""
import dataclasses
import math
import random

ARCSEC = math.pi / 648000.0
UNITS = {"lever_arm_x": "m", "lever_arm_y": "m", "boresight_pitch": "arcsec",
         "boresight_roll": "arcsec", "boresight_heading": "arcsec", "range_bias": "m",
         "scan_angle_scale": "1", "time_offset": "ms", "offset_z": "m"}
# Standard deviations that the true values are drawn from, and that are given as priors.
AIRCRAFT = {"lever_arm_x": 0.05, "lever_arm_y": 0.05, "boresight_pitch": 120.0,
            "boresight_roll": 120.0, "boresight_heading": 180.0, "range_bias": 0.08,
            "scan_angle_scale": 2e-4}
LOW = {"lever_arm_x": 0.02, "lever_arm_y": 0.02, "boresight_pitch": 360.0, "boresight_roll": 360.0,
       "boresight_heading": 360.0, "range_bias": 0.03, "scan_angle_scale": 5e-4}
ANGLES = ("boresight_pitch", "boresight_roll", "boresight_heading")


@dataclasses.dataclass
class Block:
    """parts: prefix of a part of the block ("session2", ...) and what it has of its own with prior
    standard deviations: total of the part, or, of offset_z, against the first session."""
    name: str
    title: str
    seed: int
    preset: str
    density: float
    ins: str
    process: str = "gauss_markov"
    scale: float = 1.0
    options: tuple = ()
    priors: dict = dataclasses.field(default_factory=lambda: AIRCRAFT)
    without: tuple = ()
    parts: tuple = ()
    errors: dict = dataclasses.field(default_factory=dict)
    trajectory: bool = True
    cell: float = 20.0


BLOCKS = (
    Block("aeroplane", "an oscillating mirror at 540 and 1150 m over a suburb", 101, "small", 0.4,
          "survey"),
    Block("drone", "eight lines of a multirotor at 75 m", 102, "uav", 0.15, "tactical",
          "band_limited", priors=LOW, cell=10.0),
    Block("conical", "a conical scanner at 550 and 1100 m", 103, "conical", 0.2, "survey",
          without=("scan_angle_scale",)),
    Block("dual", "two channels, one looking ahead and one back", 104, "dual", 0.2, "survey",
          "drift", without=ANGLES, parts=(("channel0", ANGLES), ("channel1", ANGLES))),
    Block("corridor", "a helicopter at 200 m along bends; the strips overlap at their ends", 105,
          "corridor", 0.12, "tactical", priors=LOW, cell=10.0),
    Block("flat", "a plain without relief, with few buildings and trees", 106, "small", 0.4,
          "survey", options=("-relief", "0", "-buildings", "0.1", "-trees", "0.2")),
    Block("mountain", "a cross-fire scanner over a relief of 400 m", 107, "mountain", 0.3,
          "survey", "band_limited", scale=0.6),
    Block("town", "city blocks of 12 to 90 m", 108, "city", 0.12, "survey", "random_walk"),
    Block("sessions", "lines of two days; height and mounting changed between them", 109, "small",
          0.4, "survey", options=("-sessions", "2"), without=("boresight_roll",),
          parts=(("session1", ("boresight_roll",)), ("session2", ("boresight_roll", "offset_z"))),
          errors={"offset_z": 0.1}),
    Block("bad_ins", "the trajectory of a MEMS INS in an aeroplane", 110, "small", 0.4, "mems"),
    Block("time_offset", "time tags of the points that are wrong by some milliseconds", 111,
          "small", 0.4, "survey", errors={"time_offset": 4.0}),
    Block("no_trajectory", "the strips of an aeroplane, and no trajectory", 112, "small", 0.4,
          "survey", trajectory=False),
)


def parameters_of(block):
    """Name and prior standard deviation of all parameters that are asked, in order."""
    asked = {name: sigma for name, sigma in block.priors.items() if name not in block.without}
    for part, names in block.parts:
        for name in names:
            asked[f"{part}:{name}"] = {**block.priors, **block.errors}[name]
    asked.update({name: sigma for name, sigma in block.errors.items()
                  if not any(name in names for _, names in block.parts)})
    return asked


def truth_of(block):
    """True values, drawn from the priors (normal) by the seed of the block. By Box and Muller's
    transform of random(), which is the same in all versions of Python."""
    source = random.Random(block.seed)
    truth = {}
    for name, sigma in parameters_of(block).items():
        radius = math.sqrt(-2.0 * math.log(1.0 - source.random()))
        value = radius * math.cos(2.0 * math.pi * source.random())
        truth[name] = float(f"{sigma * value:.3g}")
    return truth


def simulation_of(block, truth):
    """Arguments of pcl_als_simulate that make the block."""
    common = {name: value for name, value in truth.items() if ":" not in name}
    errors = [f"{name}={common.pop(name)!r}" for name in list(common) if name in block.errors]
    errors += [f"{name}={value!r}" for name, value in truth.items() if ":" in name]
    biases = ",".join(["none"] + [f"{name}={value!r}" for name, value in common.items()])
    arguments = ["-preset", block.preset, "-scale", block.scale, "-density", block.density,
                 "-seed", block.seed, "-noise", "realistic", "-ins", block.ins, "-error_process",
                 block.process, "-bias", biases, *block.options]
    if errors:
        arguments += ["-error", ",".join(errors)]
    return [str(argument) for argument in arguments]


def millimetres_per_unit(name, height, field_of_view, speed):
    """What one unit of a parameter moves points at a flying height (m) by, root mean square over
    the swath (full field of view in radians), mm."""
    name = name.split(":")[-1]
    lateral = height * field_of_view / math.sqrt(12.0)  # RMS of height * angle across
    return 1000.0 * {"boresight_pitch": height * ARCSEC, "boresight_roll": height * ARCSEC,
                     "boresight_heading": lateral * ARCSEC, "scan_angle_scale": lateral,
                     "time_offset": speed / 1000.0}.get(name, 1.0)
