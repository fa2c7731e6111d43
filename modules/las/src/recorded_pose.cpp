// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include <pcl_als/las/recorded_pose.h>

namespace pcl_als {
namespace {

const char* const kSensors[] = {"sensor",     "scanner", "platform", "beamorigin",
                                "trajectory", "imu",     "gnss",     "antenna"};
const char* const kAngles[] = {"roll", "pitch", "yaw", "heading"};

std::string plainName(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) plain += static_cast<char>(std::tolower(letter));
  }
  return plain;
}

template <std::size_t N>
bool holdsAny(const std::string& name, const char* const (&words)[N]) {
  return std::any_of(std::begin(words), std::end(words),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

}  // namespace

std::string recordedPose(const std::vector<LasExtraField>& fields) {
  std::map<std::string, std::array<std::string, 3>> positions;  // by the name without its axis
  std::string angles;
  for (const LasExtraField& field : fields) {
    const std::string name = plainName(field.name);
    if (holdsAny(name, kAngles)) angles += ", " + field.name;
    if (name.empty() || name.back() < 'x' || name.back() > 'z') continue;
    const std::string sensor = name.substr(0, name.size() - 1);
    if (holdsAny(sensor, kSensors)) positions[sensor][name.back() - 'x'] = field.name;
  }
  for (const auto& [sensor, axes] : positions) {
    if (axes[0].empty() || axes[1].empty() || axes[2].empty()) continue;
    return axes[0] + ", " + axes[1] + ", " + axes[2] + angles;
  }
  return {};
}

}  // namespace pcl_als
