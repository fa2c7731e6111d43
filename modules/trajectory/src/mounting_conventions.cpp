// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <vector>

#include <pcl_als/trajectory/mounting_convention.h>

namespace pcl_als {
namespace {

/// What the documentation of a program or a standard states.
struct Definition {
  const char *name, *use, *source;
  std::array<MountingAngle, 3> angles;
  std::array<int, 3> product;
  const char *axes, *unit;

  MountingConvention convention() const {
    MountingConvention made;
    made.name = name;
    made.use = use;
    made.source = source;
    made.angles = angles;
    made.product = product;
    made.axes = axes;
    made.unit = unit;
    return made;
  }
};

using Angles = std::array<MountingAngle, 3>;
const Angles kXyz{{{"X", 'x'}, {"Y", 'y'}, {"Z", 'z'}}};
const Angles kRollPitchYaw{{{"roll", 'x'}, {"pitch", 'y'}, {"yaw", 'z'}}};
const Angles kYawPitchRoll{{{"yaw", 'z'}, {"pitch", 'y'}, {"roll", 'x'}}};
const Angles kOmegaPhiKappa{{{"omega", 'x'}, {"phi", 'y'}, {"kappa", 'z'}}};
const Angles kPitchRollHeading{{{"pitch", 'x'}, {"roll", 'y'}, {"heading", 'z'}}};

std::vector<Definition> definitions() {
  return {
      {"zyx_frd",
       "aerospace: yaw, pitch, roll about moving axes, body forward, right, down",
       "Swift Navigation SBP, message MSG_ORIENT_EULER; OPC UA Relative Spatial Location, "
       "RpyOrientationType",
       kRollPitchYaw,
       {2, 1, 0},
       "frd",
       "deg"},
      {"applanix",
       "Applanix: mounting angles of a sensor with respect to the reference frame",
       "Applanix, POS MV V5 Installation and Operation Guide (2017), mounting angles; LVX User "
       "Manual (2021), section 4.6.11, Tait-Bryan sequence",
       kXyz,
       {2, 1, 0},
       "frd",
       "deg"},
      {"novatel",
       "NovAtel SPAN (OEM7): rotation from the IMU body to a frame of interest",
       "docs.novatel.com: OEM7 command SETINSROTATION; Waypoint application note on rotations in "
       "SPAN and Inertial Explorer",
       kXyz,
       {2, 0, 1},
       "rfu",
       "deg"},
      {"ros",
       "ROS: rpy and xyz of an origin in URDF, body forward, left, up",
       "ROS REP 103; wiki.ros.org/urdf/XML/joint, element origin",
       kRollPitchYaw,
       {2, 1, 0},
       "flu",
       "rad"},
      {"zyx_flu",
       "yaw, pitch, roll about moving axes, body forward, left, up (CPose3D of MRPT)",
       "docs.mrpt.org: class mrpt::poses::CPose3D",
       kYawPitchRoll,
       {0, 1, 2},
       "flu",
       "deg"},
      {"opk_rfu",
       "photogrammetry: omega, phi, kappa about moving axes x, y, z",
       "doc.arcgis.com: Reality Studio, coordinate system conventions",
       kOmegaPhiKappa,
       {0, 1, 2},
       "rfu",
       "deg"},
      {"pcl_als",
       "parameters of calibration.json: pitch, roll, heading of the boresight",
       "pcl_als, README of the module trajectory; Habib et al. 2011, Eq. (1)",
       kPitchRollHeading,
       {2, 0, 1},
       "rfu",
       "arcsec"},
  };
}

std::vector<MountingConvention> documentedConventions() {
  std::vector<MountingConvention> conventions;
  for (const Definition& definition : definitions()) conventions.push_back(definition.convention());
  return conventions;
}

std::string sequenceOf(const MountingConvention& convention) {
  std::string text;
  for (const int at : convention.product) {
    const MountingAngle& angle = convention.angles[static_cast<std::size_t>(at)];
    text += (text.empty() ? "" : " ") + std::string("R") + angle.axis + "(" +
            (angle.sign < 0 ? "-" : "") + angle.name + ")";
  }
  return text;
}

}  // namespace

const std::vector<MountingConvention>& mountingConventions() {
  static const std::vector<MountingConvention> conventions = documentedConventions();
  return conventions;
}

std::string describe(const MountingConvention& convention) {
  const double handedness = bodyFromAxes(convention.axes).determinant();
  return sequenceOf(convention) +
         (convention.scanner_to_body ? ", scanner to body" : ", body to scanner") + ", body axes " +
         convention.axes + (handedness < 0.0 ? " (left-handed)" : "") + ", " + convention.unit +
         "; lever arm from " +
         (convention.lever_to_scanner ? "the body's origin to the scanner"
                                      : "the scanner to the body's origin") +
         " along the axes of the " + (convention.lever_in_body ? "body" : "scanner");
}

}  // namespace pcl_als
