// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/file_motion.h>

#include "correction_record.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// The record of corrections of a moved file.
std::string recordOf(const RigidMotion& motion, const std::string& before, const fs::path& input) {
  AppliedCorrection correction;
  correction.kind = CorrectionKind::rigid_motion;
  std::ostringstream values;
  values << "shift " << motion.shift.transpose() << " m, rotation "
         << (motion.rotation / kRadiansPerDegree).transpose() << " degrees";
  correction.values = values.str();
  correction.id = contentId(correction.values);
  Warnings warnings;
  return detail::recordWith(before, correction, input.string(), true, warnings);
}

MovedFile moveLas(const fs::path& input, const fs::path& output, const RigidMotion& motion,
                  int threads) {
  const LasFile file(input);
  const LasScaling metres = file.toMetres();
  const Vector3d scale = metres.scale, offset = metres.offset;
  const Vector3d c = motion.centroid;
  const Eigen::Affine3d moving = motion.transformation(c, c);
  const LasEdit edit = [&](const LasRecordBlock& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
      std::byte* record = block.records + i * block.record_length;
      const Vector3d ground = LasRecordLayout::positionOf(record, scale, offset);
      const Vector3d moved = (c + moving * (ground - c) - offset).cwiseQuotient(scale);
      for (int axis = 0; axis < 3; ++axis) {
        const double value = std::round(moved[axis]);
        if (!(std::abs(value) <= std::numeric_limits<std::int32_t>::max()))
          throw InputError(input.string() + ": point " + std::to_string(block.first + i) +
                           " would leave the range of the file's coordinates");
        LasRecordLayout::storeCoordinate(static_cast<std::int32_t>(value), axis, record);
      }
    }
  };
  LasExtension extension;
  extension.corrections = recordOf(motion, file.info().corrections, input);
  LasRewriteResult written = extendLas(file, output, extension, edit, threads);
  return {written.points, std::move(written.remarks)};
}

MovedFile movePcd(const fs::path& input, const fs::path& output, const RigidMotion& motion) {
  PcdFindings findings;
  Strip<PointLidar> strip = loadPcd(input, {}, findings);
  const Eigen::Affine3d local = motion.transformation(strip.frame.origin, strip.frame.origin);
  for (PointLidar& point : *strip.cloud)
    point.getVector3fMap() = (local * point.getVector3fMap().cast<double>()).cast<float>();
  strip.corrections = recordOf(motion, strip.corrections, input);
  savePcd(output, strip);
  return {strip.cloud->size(), std::move(findings.remarks)};
}

}  // namespace

void checkMovable(const fs::path& input, const fs::path& output) {
  requireCopyable(input);
  if ((lowerExtension(input) == ".pcd") != (lowerExtension(output) == ".pcd"))
    throw UsageError(output.string() +
                     ": source and output must be of one kind, .las/.laz or .pcd");
}

MovedFile movePointFile(const fs::path& input, const fs::path& output, const RigidMotion& motion,
                        int threads) {
  checkMovable(input, output);
  return lowerExtension(input) == ".pcd" ? movePcd(input, output, motion)
                                         : moveLas(input, output, motion, threads);
}

}  // namespace pcl_als
