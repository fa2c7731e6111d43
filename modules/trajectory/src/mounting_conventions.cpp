// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <utility>

#include <pcl_als/trajectory/mounting_convention.h>

namespace pcl_als {
namespace {

/// Of aircraft, and of the manufacturers of GNSS/INS that follow them.
std::vector<MountingConvention> conventionsOfNavigation() {
  MountingConvention aerospace;
  aerospace.name = "zyx_frd";
  aerospace.use = "aerospace: yaw, pitch, roll about moving axes, body forward, right, down";
  aerospace.source =
      "Swift Navigation SBP, message MSG_ORIENT_EULER; OPC UA Relative Spatial Location, "
      "RpyOrientationType";
  aerospace.angles = {{{"roll", 'x'}, {"pitch", 'y'}, {"yaw", 'z'}}};
  aerospace.product = {2, 1, 0};

  MountingConvention applanix = aerospace;
  applanix.name = "applanix";
  applanix.use = "Applanix: mounting angles of a sensor with respect to the reference frame";
  applanix.source =
      "Applanix, POS MV V5 Installation and Operation Guide (2017), mounting angles; LVX User "
      "Manual (2021), section 4.6.11, Tait-Bryan sequence";
  applanix.angles = {{{"X", 'x'}, {"Y", 'y'}, {"Z", 'z'}}};

  MountingConvention novatel;
  novatel.name = "novatel";
  novatel.use = "NovAtel SPAN (OEM7): rotation from the IMU body to a frame of interest";
  novatel.source =
      "docs.novatel.com: OEM7 command SETINSROTATION; Waypoint application note on rotations in "
      "SPAN and Inertial Explorer";
  novatel.product = {2, 0, 1};
  novatel.axes = "rfu";

  return {aerospace, applanix, novatel};
}

/// Of robotics and photogrammetry, and that of this library.
std::vector<MountingConvention> otherConventions() {
  MountingConvention ros;
  ros.name = "ros";
  ros.use = "ROS: rpy and xyz of an origin in URDF, body forward, left, up";
  ros.source = "ROS REP 103; wiki.ros.org/urdf/XML/joint, element origin";
  ros.angles = {{{"roll", 'x'}, {"pitch", 'y'}, {"yaw", 'z'}}};
  ros.product = {2, 1, 0};
  ros.axes = "flu";
  ros.unit = "rad";

  MountingConvention mrpt = ros;
  mrpt.name = "zyx_flu";
  mrpt.use = "yaw, pitch, roll about moving axes, body forward, left, up (CPose3D of MRPT)";
  mrpt.source = "docs.mrpt.org: class mrpt::poses::CPose3D";
  mrpt.angles = {{{"yaw", 'z'}, {"pitch", 'y'}, {"roll", 'x'}}};
  mrpt.product = {0, 1, 2};
  mrpt.unit = "deg";

  MountingConvention photogrammetric;
  photogrammetric.name = "opk_rfu";
  photogrammetric.use = "photogrammetry: omega, phi, kappa about moving axes x, y, z";
  photogrammetric.source = "doc.arcgis.com: Reality Studio, coordinate system conventions";
  photogrammetric.angles = {{{"omega", 'x'}, {"phi", 'y'}, {"kappa", 'z'}}};
  photogrammetric.axes = "rfu";

  MountingConvention own;
  own.name = "pcl_als";
  own.use = "parameters of calibration.json: pitch, roll, heading of the boresight";
  own.source = "pcl_als, README of the module trajectory; Habib et al. 2011, Eq. (1)";
  own.angles = {{{"pitch", 'x'}, {"roll", 'y'}, {"heading", 'z'}}};
  own.product = {2, 0, 1};
  own.axes = "rfu";
  own.unit = "arcsec";

  return {ros, mrpt, photogrammetric, own};
}

std::vector<MountingConvention> documentedConventions() {
  std::vector<MountingConvention> conventions = conventionsOfNavigation();
  for (MountingConvention& convention : otherConventions())
    conventions.push_back(std::move(convention));
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
