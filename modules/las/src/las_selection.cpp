// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_selection.h>

#include "las_extension.h"
#include "las_output.h"
#include "las_statistics.h"
#include "las_tail.h"

namespace pcl_als {
namespace {

// Offsets are multiples of the scale up to the rounding of doubles at 1e7 m, some 1e-9 m.
constexpr double kFractionOfStep = 1e-3;

const std::filesystem::path& checked(const std::filesystem::path& path, const LasFile& like) {
  std::error_code absent;
  if (std::filesystem::equivalent(like.path(), path, absent))
    throw UsageError(path.string() + ": input and output are the same file");
  return path;
}

bool sameFields(const std::vector<LasExtraField>& a, const std::vector<LasExtraField>& b) {
  return serialiseLasExtraFields(a) == serialiseLasExtraFields(b);
}

}  // namespace

struct LasSelectionWriter::State {
  const LasFile& like;
  LasHeader header;
  detail::LasStatistics counters;
  WaveformCopy waveforms;
  detail::LasOutput output;

  State(const std::filesystem::path& path, const LasFile& file, detail::LasHead head, int threads)
      : like(file),
        header(file.header()),
        waveforms(file, path),
        output(checked(path, file), head, threads) {
    header.record_length = head.header.record_length;
  }
};

LasSelectionWriter::LasSelectionWriter(const std::filesystem::path& path, const LasFile& like,
                                       int threads)
    : LasSelectionWriter(path, like, std::vector<LasExtraField>(), threads) {}

LasSelectionWriter::LasSelectionWriter(const std::filesystem::path& path, const LasFile& like,
                                       const std::vector<LasExtraField>& fields, int threads)
    : state_(std::make_unique<State>(path, like, detail::extendedHead(like, fields), threads)) {}

LasSelectionWriter::~LasSelectionWriter() = default;

void LasSelectionWriter::append(const std::byte* records, std::size_t count) {
  State& s = *state_;
  s.counters.add(records, count, s.header.record_length, s.like.layout());
  s.output.append(records, count);
}

std::uint64_t LasSelectionWriter::pointCount() const {
  return state_->counters.points;
}

void LasSelectionWriter::finish() {
  State& s = *state_;
  detail::copyLasTail(s.like, s.output, s.header.record_length > s.like.header().record_length);
  s.counters.store(s.header);
  s.output.putCounts(s.header);
  s.waveforms.prepare();
  s.waveforms.commit();
  s.output.commit();
}

std::vector<std::string> LasSelectionWriter::remarks() const {
  return detail::remarksOf(state_->like, {}, state_->waveforms);
}

std::array<std::int64_t, 3> stepsBetween(const LasFile& from, const LasFile& to) {
  const LasHeader &a = from.header(), &b = to.header();
  const auto refuse = [&](const char* what) {
    throw InputError(from.path().string() + ": its " + what + " differs from that of " +
                     to.path().string() + ", points of both do not fit into one LAS file");
  };
  if (a.point_format != b.point_format) refuse("point format");
  if (a.record_length != b.record_length) refuse("record length");
  if (a.scale != b.scale) refuse("coordinate scale");
  if (!sameFields(from.extraFields(), to.extraFields())) refuse("description of extra bytes");
  if (((a.global_encoding ^ b.global_encoding) & kLasAdjustedStandardTime) != 0 ||
      a.timeShift() != b.timeShift())
    refuse("kind of GPS time");
  if (from.path() != to.path() && (refersToWaveforms(from) || refersToWaveforms(to)))
    refuse("set of waveforms");
  std::array<std::int64_t, 3> steps{};
  for (int axis = 0; axis < 3; ++axis) {
    const double exact = (a.offset[axis] - b.offset[axis]) / a.scale[axis];
    if (!(std::abs(exact) < 1e18) || std::abs(exact - std::round(exact)) > kFractionOfStep)
      refuse("coordinate offset");
    steps[static_cast<std::size_t>(axis)] = std::llround(exact);
  }
  return steps;
}

void moveRecords(const std::array<std::int64_t, 3>& steps, std::byte* records, std::size_t count,
                 std::size_t record_length, const std::string& name) {
  if (steps == std::array<std::int64_t, 3>{}) return;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::byte* at = records + i * record_length + 4 * axis;
      const std::int64_t moved = loadLas<std::int32_t>(at) + steps[axis];
      if (moved < std::numeric_limits<std::int32_t>::min() ||
          moved > std::numeric_limits<std::int32_t>::max())
        throw InputError(name + ": a point is too far from the offset of the output's coordinates");
      storeLas(at, static_cast<std::int32_t>(moved));
    }
}

}  // namespace pcl_als
