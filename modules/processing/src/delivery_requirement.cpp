// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/quality/accuracy_standards.h>

namespace pcl_als {
namespace {

constexpr std::size_t kNamedReasons = 3;  // in one line

std::string exceeds(const char* figure, double metres, double limit) {
  char text[120];
  std::snprintf(text, sizeof text, "%s %.2f cm, more than the %.0f cm that are allowed", figure,
                100.0 * metres, 100.0 * limit);
  return text;
}

bool isWithin(const std::optional<int>& reached, int level) {
  return reached && *reached <= level;
}

/// Why a pair does not keep the level; empty where it does.
std::string objection(const CheckedPair& pair, const QualityLevelLimits& limits) {
  const PairAssessment& found = pair.assessment;
  const std::string strips = "strips " + pair.a + " and " + pair.b + ": ";
  if (found.status == PairAssessment::Status::too_far) {
    char height[32];
    std::snprintf(height, sizeof height, "%.2f m", std::abs(found.apart));
    return strips + "too far apart in height to be compared (" + height + ")";
  }
  if (found.status != PairAssessment::Status::judged)
    return pair.too_small ? std::string() : strips + "not measured (" + found.reason + ")";
  if (isWithin(found.quality_level, limits.level)) return {};
  return strips + exceeds("RMSDz", found.vertical.rms, limits.swath_overlap_rmsdz);
}

std::string objection(const ControlAssessment& control, const QualityLevelLimits& limits) {
  if (!control.no_class.empty()) return control.no_class;
  if (!control.accuracy)
    return control.differences.empty() ? "no strip covers a control point"
                                       : "no strip has a surface at a control point";
  if (isWithin(control.quality_level, limits.level)) return {};
  return "control: " + exceeds("RMSE", control.accuracy->fit, limits.absolute_rmsez);
}

}  // namespace

std::string DeliveryRequirement::describe() const {
  const std::string name = "QL" + std::to_string(level);
  if (kept) return "the delivery keeps " + name;
  std::string text = "the delivery does not keep " + name;
  for (std::size_t i = 0; i < std::min(kNamedReasons, reasons.size()); ++i)
    text += (i == 0 ? ": " : "; ") + reasons[i];
  if (reasons.size() > kNamedReasons)
    text += "; and " + counted(reasons.size() - kNamedReasons, "more reason");
  return text;
}

DeliveryRequirement requireLevel(const CheckedBlock& block, int level) {
  if (level < 0 || level >= kQualityLevels)
    throw UsageError("the quality level must be 0, 1, 2 or 3, not " + std::to_string(level));
  const QualityLevelLimits& limits = qualityLevels()[static_cast<std::size_t>(level)];
  DeliveryRequirement requirement;
  requirement.level = level;
  const auto add = [&requirement](std::string reason) {
    if (!reason.empty()) requirement.reasons.push_back(std::move(reason));
  };
  for (const CheckedPair& pair : block.pairs) {
    const bool measured = pair.assessment.status == PairAssessment::Status::judged;
    requirement.pairs += measured && !pair.of_one_pass ? 1 : 0;
    add(objection(pair, limits));
  }
  if (block.control) {
    requirement.control_points = block.control->points;
    add(objection(*block.control, limits));
  }
  const bool measured = requirement.pairs > 0 || requirement.control_points > 0;
  if (!measured && requirement.reasons.empty()) add("nothing could be measured");
  requirement.kept = requirement.reasons.empty();
  return requirement;
}

}  // namespace pcl_als
