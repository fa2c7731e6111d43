// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/simulation/scanner_options.h>

namespace pcl_als::simulation {

namespace {

struct KnownScanner {
  ScannerType type;
  std::string_view name;
  int channels;
  double degrees;  ///< ScannerOptions::channel_angle
};

constexpr std::array<KnownScanner, 7> kScanners = {{
    {ScannerType::oscillating, "oscillating", 1, 0.0},
    {ScannerType::polygon, "polygon", 1, 0.0},
    {ScannerType::conical, "conical", 1, 0.0},
    {ScannerType::rosette, "rosette", 1, 0.0},
    {ScannerType::dual, "dual", 2, 10.0},
    {ScannerType::cross, "cross", 2, 14.0},
    {ScannerType::multi, "multi", 16, 15.0},
}};

int channelsIn(std::string_view text) {
  const int channels = valueIn<int>(text).value_or(0);
  if (channels >= 2 && channels <= 64) return channels;
  throw UsageError("scanner multi:" + std::string(text) + ": the channels are 2 to 64");
}

}  // namespace

std::string_view nameOf(ScannerType type) {
  for (const KnownScanner& scanner : kScanners) {
    if (scanner.type == type) return scanner.name;
  }
  return {};
}

void ScannerOptions::setType(std::string_view name) {
  std::string names;
  const auto colon = name.find(':');
  for (const KnownScanner& known : kScanners) {
    names += (names.empty() ? "" : ", ") + std::string(known.name);
    if (known.name != name.substr(0, colon)) continue;
    if (colon != std::string_view::npos && known.type != ScannerType::multi) continue;
    type = known.type;
    channels =
        colon == std::string_view::npos ? known.channels : channelsIn(name.substr(colon + 1));
    channel_angle = known.degrees * kRadiansPerDegree;
    return;
  }
  throw UsageError("scanner '" + std::string(name) + "': there are " + names +
                   " (multi:32 for 32 channels)");
}

Eigen::Matrix3d ScannerOptions::laserFromChannel(int channel) const {
  const double angle = channel == 0 ? channel_angle : -channel_angle;
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (type == ScannerType::dual) rotation << 1, 0, 0, 0, c, -s, 0, s, c;   // about x
  if (type == ScannerType::cross) rotation << c, -s, 0, s, c, 0, 0, 0, 1;  // about z
  return rotation;
}

}  // namespace pcl_als::simulation
