// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/processing/pair_alignment.h>

namespace pcl_als {
namespace {

using Eigen::AlignedBox2d;
using Paths = std::vector<std::filesystem::path>;

void arrange(AlignmentPair& pair, const Paths& files, StripChoice choice) {
  choice.keep_timeless = true;  // nothing here needs times
  choice.divide_lines = true;
  pair.arranged = std::make_shared<const ArrangedFiles>(files, choice);
  pair.use = pair.arranged->use();
}

bool isSourceId(const std::string& text) {
  constexpr std::size_t kMostDigits = 5;
  return !text.empty() && text.size() <= kMostDigits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

/// A number that no strip has is input without the strip; another word is no strip's name.
int indexOf(const ArrangedFiles& arranged, const std::string& strip, const std::string& what) {
  const std::vector<std::string>& names = arranged.arrangement().names();
  const bool known = std::find(names.begin(), names.end(), strip) != names.end();
  if (known || !isSourceId(strip)) return static_cast<int>(stripNamed(names, strip, "pair"));
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw InputError(what + ": no point is of strip " + strip + "; there are " + all);
}

StripFiles stripOf(const AlignmentPair& pair, const std::string& strip, const std::string& what) {
  const ArrangedFiles& arranged = *pair.arranged;
  StripFiles files;
  files.strip = strip;
  files.arrangement = &arranged.arrangement();
  files.index = indexOf(arranged, strip, what);
  files.box = pair.use.boxes[static_cast<std::size_t>(files.index)];
  for (std::size_t file = 0; file < arranged.files().size(); ++file) {
    files.files.push_back(arranged.files()[file].sources.info.path);
    files.places.push_back(file);
  }
  return files;
}

StripFiles fileOf(const AlignmentPair& pair, const std::filesystem::path& path, std::size_t place) {
  StripFiles files;
  files.files = {path};
  if (pair.arranged) files.arrangement = &pair.arranged->arrangement();
  files.places = {place};
  return files;
}

std::string boxText(const Eigen::AlignedBox3d& box) {
  char text[120];
  std::snprintf(text, sizeof text, "x %.1f to %.1f, y %.1f to %.1f", box.min().x(), box.max().x(),
                box.min().y(), box.max().y());
  return text;
}

/// The box in plan that both strips have points in, with what they may be apart; empty: none.
AlignedBox2d commonBox(const StripFileInfo& source, const StripFileInfo& target, double reach) {
  const auto wide = [reach](const Eigen::AlignedBox3d& box) {
    return AlignedBox2d(box.min().head<2>().array() - reach, box.max().head<2>().array() + reach);
  };
  if (source.box.isEmpty() || target.box.isEmpty()) return {};
  return wide(source.box).intersection(wide(target.box));
}

/// The points of two strips where they overlap, relative to one origin.
struct OverlapPoints {
  StripFileInfo source_info, target_info;
  PointReference reference;
  StripPoints source, target;

  /// Reads the files where their headers say that they overlap, and once more where the points
  /// contradict these.
  void read(const AlignmentPair& pair, double reach) {
    if (tryBoxes(pair, reach, false) && source.headers_right && target.headers_right) return;
    if (tryBoxes(pair, reach, true)) return;
    throw InputError(pair.source.name() + " and " + pair.target.name() + " do not overlap: " +
                     boxText(source_info.box) + " and " + boxText(target_info.box));
  }

  double resolution() const { return std::min(source_info.resolution, target_info.resolution); }

  std::vector<std::string> remarks() const {
    std::vector<std::string> all = reference.remarks;
    for (const StripFileInfo* info : {&source_info, &target_info})
      all.insert(all.end(), info->remarks.begin(), info->remarks.end());
    return all;
  }

 private:
  bool tryBoxes(const AlignmentPair& pair, double reach, bool measured) {
    source_info = stripFileInfo(pair.source, measured);
    target_info = stripFileInfo(pair.target, measured);
    std::vector<PointFileInfo> files = source_info.files;
    files.insert(files.end(), target_info.files.begin(), target_info.files.end());
    reference = commonReference(files);
    const AlignedBox2d box = commonBox(source_info, target_info, reach);
    if (box.isEmpty()) return false;
    Eigen::Vector3d origin;
    origin << box.center(), target_info.box.center().z();
    origin = origin.array().round();
    source = readStripPoints(pair.source, box, origin);
    target = readStripPoints(pair.target, box, origin);
    return true;
  }
};

}  // namespace

AlignmentPair filePair(const Paths& files, const std::optional<StripChoice>& choice) {
  AlignmentPair pair;
  if (choice) arrange(pair, files, *choice);
  pair.source = fileOf(pair, files.at(0), 0);
  pair.target = fileOf(pair, files.at(1), 1);
  return pair;
}

AlignmentPair namedPair(const Paths& files, const std::pair<std::string, std::string>& names,
                        const StripChoice& choice, const std::string& what) {
  AlignmentPair pair;
  arrange(pair, files, choice);
  pair.source = stripOf(pair, names.first, what);
  pair.target = stripOf(pair, names.second, what);
  return pair;
}

PairAlignment alignPair(const AlignmentPair& pair, PatchAlignmentSettings settings,
                        const ProgressCallback& callback) {
  ProgressReport progress(callback);
  progress.begin("Reading " + pair.source.name() + " and " + pair.target.name());
  OverlapPoints overlap;
  overlap.read(pair, settings.search_distance + 10.0);
  settings.resolution = overlap.resolution();
  const StripPoints &source = overlap.source, &target = overlap.target;
  progress.end(grouped(source.positions.size()) + " and " + grouped(target.positions.size()) +
               " points in common reach");
  for (const std::string& text : overlap.remarks()) progress.remark(text);
  for (const std::string& text : describe(pair.use.left_out)) progress.remark(text);

  progress.begin("Aligning");
  PairAlignment alignment{alignPatches(source.view(), target.view(), settings),
                          source.positions.size(), target.positions.size()};
  const PatchAlignmentResult& result = alignment.result;
  progress.end(grouped(result.pairs) + " pairs, " + std::to_string(result.iterations) +
               " iterations");
  if (result.status == PatchAlignmentResult::Status::no_overlap)
    throw InputError(pair.source.name() + " and " + pair.target.name() + ": " + result.message);
  return alignment;
}

std::string unreliability(const PatchAlignmentResult& result) {
  if (!result.hasConverged()) return result.message;
  std::string why;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    if (result.parameters[p].determined) continue;
    why += (why.empty() ? "" : "; ") + std::string(PatchAlignmentResult::name(p)) +
           " is not determined (" + result.parameters[p].reason + ")";
  }
  return why;
}

}  // namespace pcl_als
