// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>

namespace pcl_als {
namespace {

bool isCode(const std::string& crs) {
  return crs.rfind("EPSG:", 0) == 0;
}

/// The middle of the box of a file; the place of its first point where that is no box.
Eigen::Vector2d placeIn(const PointFileInfo& file) {
  const Eigen::Vector2d middle = 0.5 * (file.minimum + file.maximum).head<2>();
  const Eigen::Vector2d size = (file.maximum - file.minimum).head<2>();
  const bool is_box = middle.allFinite() && size.minCoeff() >= 0.0 && size.maxCoeff() > 0.0;
  if (is_box || file.point_count == 0 || !std::filesystem::exists(file.path)) return middle;
  PointChunk chunk;
  if (!PointReader::open(file.path)->read(chunk)) return middle;
  return {chunk.x[0], chunk.y[0]};
}

/// Two codes are compared as systems; other descriptions by the coordinates that they give to a
/// place, because PROJ does not recognise every dialect of a description.
bool areOfOneSystem(const PointFileInfo& first, const PointFileInfo& other) {
  if (first.crs == other.crs) return true;
  if (isCode(first.crs) && isCode(other.crs)) return sameGroundFrame(first.crs, other.crs);
  return !coordinatesDiffer(first.crs, other.crs, placeIn(other));
}

/// "EPSG:25832", or of another description what PROJ calls it.
std::string nameOf(const PointFileInfo& file) {
  if (isCode(file.crs)) return file.crs;
  const std::string name = describeCrs(file.crs).name;
  return name.empty() ? shortCrsName(file.crs) : "'" + name + "'";
}

void requireSameCrs(const PointFileInfo& first, const PointFileInfo& other) {
  if (areOfOneSystem(first, other)) return;
  throw InputError(other.path.string() + ": is in " + nameOf(other) + " but " +
                   first.path.string() + " in " + nameOf(first) + "; reproject one of them");
}

/// A file that states no unit, beside one in feet, could be in either.
void requireKnownUnits(const std::vector<PointFileInfo>& files) {
  const auto stated = std::find_if(files.begin(), files.end(), [](const PointFileInfo& file) {
    return file.units.known() && !file.units.metric();
  });
  const auto silent = std::find_if(files.begin(), files.end(),
                                   [](const PointFileInfo& file) { return !file.units.known(); });
  if (stated == files.end() || silent == files.end()) return;
  throw InputError(silent->path.string() + ": states no unit of length, but " +
                   stated->path.string() + " is in " + stated->units.horizontal.name +
                   "; give both files their CRS");
}

std::string assumption(const PointFileInfo& file) {
  const std::string why =
      file.crs.empty() ? "no CRS and no unit of length are stated"
                       : "PROJ knows no unit of length for the CRS " + shortCrsName(file.crs);
  return why + "; coordinates are taken as metres";
}

/// What there is to say of a file's units (nothing of stated metres) and of earlier corrections.
std::vector<std::string> remarksOf(const PointFileInfo& file) {
  std::vector<std::string> remarks;
  if (!file.crs_ignored.empty())
    remarks.push_back("a CRS that it states is not used: " + file.crs_ignored);
  if (!file.units.known())
    remarks.push_back(assumption(file));
  else if (!file.units.metric())
    remarks.push_back("coordinates in " + describeUnits(file) +
                      " are brought to metres; point files are written in their own units");
  for (const AppliedCorrection& correction : parseCorrections(file.corrections))
    remarks.push_back(correction.describe());
  return remarks;
}

bool sameCorrections(const std::vector<PointFileInfo>& files) {
  return std::all_of(files.begin(), files.end(), [&files](const PointFileInfo& file) {
    return file.corrections == files.front().corrections;
  });
}

/// Files that hold the same points by their headers: each pair in a sentence.
std::vector<std::string> copiesAmong(const std::vector<PointFileInfo>& files) {
  using Box = std::array<double, 6>;
  std::map<std::pair<std::uint64_t, Box>, const PointFileInfo*> known;
  std::vector<std::string> copies;
  for (const PointFileInfo& file : files) {
    const Eigen::Vector3d size = file.maximum - file.minimum;
    if (!(size.minCoeff() >= 0.0 && size.maxCoeff() > 0.0)) continue;  // no box is stated
    Box box;
    Eigen::Map<Eigen::Vector3d>(box.data()) = file.minimum;
    Eigen::Map<Eigen::Vector3d>(box.data() + 3) = file.maximum;
    const auto [first, is_new] = known.try_emplace({file.point_count, box}, &file);
    if (is_new) continue;
    copies.push_back(file.path.string() + " and " + first->second->path.string() +
                     " hold the same points by their headers (" + grouped(file.point_count) +
                     " in the same box): give one of them, so that none counts twice");
  }
  return copies;
}

/// Remarks that several files share.
class SharedRemarks {
 public:
  void add(const std::string& remark, const PointFileInfo& file) {
    const auto known = std::find_if(remarks_.begin(), remarks_.end(),
                                    [&](const auto& entry) { return entry.first == remark; });
    if (known == remarks_.end())
      remarks_.push_back({remark, {&file}});
    else
      known->second.push_back(&file);
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const auto& [remark, of] : remarks_) {
      std::string name = of.front()->path.filename().string();
      if (of.size() > 1) name += " and " + std::to_string(of.size() - 1) + " more";
      texts.push_back(name + ": " + remark);
    }
    return texts;
  }

 private:
  std::vector<std::pair<std::string, std::vector<const PointFileInfo*>>> remarks_;
};

}  // namespace

PointReference commonReference(const std::vector<PointFileInfo>& files) {
  PointReference common;
  const PointFileInfo* first = nullptr;
  SharedRemarks remarks;
  for (const PointFileInfo& file : files) {
    requireMapCoordinates(file);
    if (first != nullptr && !file.crs.empty()) requireSameCrs(*first, file);
    if (first == nullptr && !file.crs.empty()) first = &file;
    for (const std::string& remark : remarksOf(file)) remarks.add(remark, file);
  }
  requireKnownUnits(files);
  if (first != nullptr) common.crs = first->crs;
  common.remarks = remarks.texts();
  for (std::string& copy : copiesAmong(files)) common.remarks.push_back(std::move(copy));
  if (!sameCorrections(files))
    common.remarks.emplace_back(
        "the files were not corrected alike: strips that are compared should be");
  return common;
}

PointReference commonReference(const std::vector<std::string>& paths) {
  std::vector<PointFileInfo> files;
  files.reserve(paths.size());
  for (const std::string& path : paths) files.push_back(PointReader::open(path)->info());
  return commonReference(files);
}

std::string describeUnits(const PointFileInfo& info) {
  if (info.crs_kind == CrsKind::geographic) return "degrees";
  const LinearUnits& units = info.units;
  if (!units.known() && !units.verticalKnown()) return "not stated, taken as metre";
  std::string text = units.horizontal.name;
  text += units.known() ? " (" + units.source + ")" : " (not stated, assumed)";
  const bool same = units.vertical.metres == units.horizontal.metres;
  if (!units.verticalKnown()) return text + ", heights as well (not stated, assumed)";
  return text + ", heights " + (same ? std::string("as well") : "in " + units.vertical.name) +
         (units.vertical_source == units.source ? "" : " (" + units.vertical_source + ")");
}

}  // namespace pcl_als
