// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <limits>
#include <locale>
#include <sstream>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <nlohmann/json.hpp>

#include <pcl_als/io/applied_correction.h>

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

/// Characters of a description that are kept.
constexpr std::size_t kLongestValues = 1000;
/// Bytes that a VLR can hold.
constexpr std::size_t kLongestRecord = std::numeric_limits<std::uint16_t>::max();

struct KindName {
  CorrectionKind kind;
  const char* name;
};
constexpr std::array<KindName, 4> kKindNames{{{CorrectionKind::biases_removed, "biases_removed"},
                                              {CorrectionKind::biases_applied, "biases_applied"},
                                              {CorrectionKind::rigid_motion, "rigid_motion"},
                                              {CorrectionKind::intensity, "intensity"}}};

const char* nameOf(CorrectionKind kind) {
  for (const KindName& known : kKindNames)
    if (known.kind == kind) return known.name;
  return "unreadable";
}

CorrectionKind kindNamed(const std::string& name) {
  for (const KindName& known : kKindNames)
    if (name == known.name) return known.kind;
  return CorrectionKind::unreadable;
}

AppliedCorrection correctionOf(const Json& entry) {
  AppliedCorrection correction;
  correction.kind = kindNamed(entry.at("kind").get<std::string>());
  correction.id = entry.value("id", "");
  correction.strip_corrections = entry.value("strip_corrections", false);
  correction.values = entry.value("values", "");
  return correction;
}

Json jsonOf(const AppliedCorrection& correction) {
  Json entry{{"kind", nameOf(correction.kind)}};
  if (!correction.id.empty()) entry["id"] = correction.id;
  if (correction.strip_corrections) entry["strip_corrections"] = true;
  entry["values"] = correction.values.size() <= kLongestValues
                        ? correction.values
                        : correction.values.substr(0, kLongestValues) + " ...";
  return entry;
}

std::string actionOf(const AppliedCorrection& correction) {
  switch (correction.kind) {
    case CorrectionKind::biases_removed:
      return "the biases of calibration " + correction.id + " were removed";
    case CorrectionKind::biases_applied:
      return "the biases of calibration " + correction.id + " were applied";
    case CorrectionKind::rigid_motion:
      return "the points were moved";
    case CorrectionKind::intensity:
      return "the intensities were corrected";
    case CorrectionKind::unreadable:
      break;
  }
  return "the points were corrected by another version of pcl_als";
}

}  // namespace

std::string AppliedCorrection::describe() const {
  std::string details = values;
  if (strip_corrections)
    details += (details.empty() ? "" : "; ") + std::string("with strip corrections");
  return actionOf(*this) + (details.empty() ? "" : " (" + details + ")");
}

AppliedCorrections parseCorrections(const std::string& record) {
  if (record.empty()) return {};
  AppliedCorrections corrections;
  try {
    const Json content = Json::parse(record);
    for (const Json& entry : content.at("corrections")) corrections.push_back(correctionOf(entry));
  } catch (const Json::exception&) {
    return {{CorrectionKind::unreadable, {}, false, {}}};
  }
  return corrections;
}

std::string correctionsRecord(const AppliedCorrections& corrections) {
  for (std::size_t first = 0; first < corrections.size(); ++first) {
    Json entries = Json::array();
    for (std::size_t i = first; i < corrections.size(); ++i)
      entries.push_back(jsonOf(corrections[i]));
    // A name may hold bytes that are no UTF-8.
    const std::string text =
        Json{{"corrections", entries}}.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() <= kLongestRecord) return text;
  }
  return {};
}

std::string contentId(const std::string& text) {
  const boost::uuids::name_generator_sha1 generator(boost::uuids::ns::oid());
  return boost::uuids::to_string(generator(text));
}

std::string calibrationId(const CalibrationResult& calibration) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  // Values that passed a file differ in their last bits from those that were estimated.
  text.precision(7);
  text << toString(calibration.attitude) << ' ' << calibration.biases().transpose() << ' '
       << calibration.sources.transpose() << ' ' << calibration.channel_field << '\n';
  for (const SystemEstimate& system : calibration.systems)
    text << system.group.name << ' ' << system.values().transpose() << '\n';
  for (const FixedSurface& held : calibration.held)
    for (const std::string& strip : held.strips) text << strip << '\n';
  for (const StripErrors& strip : calibration.strip_errors) {
    text << strip.id << '\n';
    for (const TrajectoryErrorKnot& knot : strip.knots)
      text << knot.time << ' ' << knot.position.transpose() << ' ' << knot.angles.transpose()
           << '\n';
  }
  return contentId(text.str());
}

}  // namespace pcl_als
