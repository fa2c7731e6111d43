// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/measured_box.h>
#include <pcl_als/processing/pair_alignment.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {
namespace {

using Eigen::AlignedBox2d;
using Paths = std::vector<std::filesystem::path>;

std::shared_ptr<SurveyReader> arranged(const Paths& files, StripChoice choice) {
  choice.keep_timeless = true;  // nothing here needs times
  choice.divide_lines = true;
  auto survey = std::make_shared<SurveyReader>(SurveyReader::ofFiles(files));
  survey->choose(choice, {});
  return survey;
}

/// A pair of whole files, of which the boxes are known from their headers or measured.
AlignmentPair wholeFiles(const std::vector<PointFileInfo>& files) {
  const auto survey = std::make_shared<SurveyReader>(SurveyReader::ofWholeFiles(files));
  return {StripPart::ofFile(survey, 0), StripPart::ofFile(survey, 1), {}};
}

bool isSourceId(const std::string& text) {
  constexpr std::size_t kMostDigits = 5;
  return !text.empty() && text.size() <= kMostDigits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

/// A number that no strip has is input without the strip; another word is no strip's name.
int indexOf(const std::vector<std::string>& names, const std::string& strip,
            const std::string& what) {
  const bool known = std::find(names.begin(), names.end(), strip) != names.end();
  if (known || !isSourceId(strip)) return static_cast<int>(stripNamed(names, strip, "pair"));
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw InputError(what + ": no point is of strip " + strip + "; there are " + all);
}

std::string boxText(const Eigen::AlignedBox3d& box) {
  char text[120];
  std::snprintf(text, sizeof text, "x %.1f to %.1f, y %.1f to %.1f", box.min().x(), box.max().x(),
                box.min().y(), box.max().y());
  return text;
}

/// The box in plan that both strips have points in, with what they may be apart; empty: none.
AlignedBox2d commonBox(const AlignmentPair& pair, double reach) {
  const auto wide = [reach](const Eigen::AlignedBox3d& box) {
    return AlignedBox2d(box.min().head<2>().array() - reach, box.max().head<2>().array() + reach);
  };
  if (pair.source.box.isEmpty() || pair.target.box.isEmpty()) return {};
  return wide(pair.source.box).intersection(wide(pair.target.box));
}

/// The points of two strips where they overlap, relative to one origin.
struct OverlapPoints {
  PointReference reference;
  StripPoints source, target;

  /// Reads the files where their headers say that they overlap, and once more where the points
  /// contradict these.
  void read(const AlignmentPair& pair, double reach) {
    if (tryBoxes(pair, reach) && (pair.measured || (source.box_right && target.box_right))) return;
    AlignmentPair measured = pair;
    std::vector<std::string> remarks;
    if (!pair.measured) {
      std::vector<PointFileInfo> files;
      for (const StripPart* part : {&pair.source, &pair.target}) {
        const MeasuredFile file = measureBox(part->files().front().path);
        if (!file.box_remark.empty()) remarks.push_back(file.box_remark);
        files.push_back(file.info);
      }
      measured = wholeFiles(files);
      if (tryBoxes(measured, reach)) {
        reference.remarks.insert(reference.remarks.end(), remarks.begin(), remarks.end());
        return;
      }
    }
    throw InputError(pair.source.name + " and " + pair.target.name + " do not overlap: " +
                     boxText(measured.source.box) + " and " + boxText(measured.target.box));
  }

 private:
  bool tryBoxes(const AlignmentPair& pair, double reach) {
    // Those of the survey: two strips may be in the same files.
    std::vector<PointFileInfo> files;
    for (const SurveyedFile& file : pair.source.survey->files()) files.push_back(file.sources.info);
    reference = commonReference(files);
    const AlignedBox2d box = commonBox(pair, reach);
    if (box.isEmpty()) return false;
    Eigen::Vector3d origin;
    origin << box.center(), pair.target.box.center().z();
    origin = origin.array().round();
    source = readStripPoints(pair.source, box, origin);
    target = readStripPoints(pair.target, box, origin);
    return true;
  }
};

}  // namespace

AlignmentPair filePair(const Paths& files, const std::optional<StripChoice>& choice) {
  if (!choice)
    return wholeFiles(
        {PointReader::open(files.at(0))->info(), PointReader::open(files.at(1))->info()});
  const std::shared_ptr<const SurveyReader> survey = arranged(files, *choice);
  return {StripPart::ofFile(survey, 0), StripPart::ofFile(survey, 1), survey->measure().excluded,
          true};
}

AlignmentPair namedPair(const Paths& files, const std::pair<std::string, std::string>& names,
                        const StripChoice& choice, const std::string& what) {
  const std::shared_ptr<const SurveyReader> survey = arranged(files, choice);
  const SurveyReader::Contents contents = survey->measure();
  const auto part = [&](const std::string& name) {
    const int strip = indexOf(survey->strips(), name, what);
    return StripPart::ofStrip(survey, strip, contents.boxes[static_cast<std::size_t>(strip)]);
  };
  return {part(names.first), part(names.second), contents.excluded, true};
}

PairAlignment registerPair(const AlignmentPair& pair, PatchAlignmentSettings settings,
                           const ProgressCallback& callback) {
  ProgressReport progress(callback);
  progress.begin("Reading " + pair.source.name + " and " + pair.target.name);
  OverlapPoints overlap;
  overlap.read(pair, settings.search_distance + 10.0);
  settings.resolution = pair.source.survey->resolution();
  const StripPoints &source = overlap.source, &target = overlap.target;
  progress.end(grouped(source.positions.size()) + " and " + grouped(target.positions.size()) +
               " points in common reach");
  for (const std::string& text : overlap.reference.remarks) progress.remark(text);
  for (const std::string& text : describe(pair.excluded)) progress.remark(text);

  progress.begin("Aligning");
  PairAlignment alignment{registerPatches(source.view(), target.view(), settings),
                          source.positions.size(), target.positions.size()};
  const PatchAlignmentResult& result = alignment.result;
  progress.end(grouped(result.pairs) + " pairs, " + std::to_string(result.iterations) +
               " iterations");
  if (result.status == PatchAlignmentResult::Status::no_overlap)
    throw InputError(pair.source.name + " and " + pair.target.name + ": " + result.message);
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
