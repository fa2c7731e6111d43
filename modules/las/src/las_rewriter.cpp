// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/las/las_rewriter.h>

#include "las_extension.h"
#include "las_output.h"
#include "las_statistics.h"
#include "las_tail.h"

namespace pcl_als {
namespace {

// Blocks of about 1 MiB stay in the second-level cache from reading to writing.
constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
constexpr std::size_t kBoxBytes = 48;

/// Boxes before and after the edit, merged over blocks; the order does not matter.
struct Boxes {
  std::mutex mutex;
  detail::LasBox before, after;

  void add(const detail::LasBox& b, const detail::LasBox& a) {
    const std::lock_guard<std::mutex> lock(mutex);
    before.add(b);
    after.add(a);
  }
};

bool recordsCorrections(const std::string& user_id, std::uint16_t record_id) {
  return user_id == kLasCorrectionsUser && record_id == kLasCorrectionsRecord;
}

/// The head of the output: fields are added and the record of corrections is replaced.
detail::LasHead headOf(const LasFile& input, const LasExtension& extension) {
  detail::LasHead head = detail::extendedHead(input, extension.fields);
  if (!extension.corrections) return head;
  const std::size_t at = detail::eraseVlrs(head, recordsCorrections);
  if (!extension.corrections->empty())
    detail::insertVlr(head, at, serialiseLasVlr(lasCorrectionsVlr(*extension.corrections)));
  return head;
}

class Rewrite {
 public:
  Rewrite(const LasFile& input, const std::filesystem::path& output, const LasEdit& edit,
          const LasExtension& extension, int threads)
      : input_(input),
        edit_(edit),
        header_(input.header()),
        head_(headOf(input, extension)),
        out_length_(head_.header.record_length),
        per_block_(extension.block_records > 0
                       ? extension.block_records
                       : std::max<std::size_t>(1, kBlockBytes / out_length_)),
        keeps_coordinates_(extension.keeps_coordinates),
        abandon_(extension.abandon),
        threads_(threads),
        waveforms_(input, output),
        output_(output, head_, threads) {}

  LasRewriteResult run() {
    if (header_.compressed || output_.compressed())
      rewriteInOrder();
    else
      parallelFor((header_.point_count + per_block_ - 1) / per_block_, threads_,
                  [this](std::size_t block) {
                    if (!abandoned()) rewriteBlock(block);
                  });
    if (abandoned()) {
      LasRewriteResult none;
      none.complete = false;
      return none;
    }
    detail::copyLasTail(input_, output_, out_length_ > header_.record_length);
    waveforms_.prepare();
    const LasRewriteResult result = finish();
    waveforms_.commit();
    output_.commit();
    return result;
  }

 private:
  bool abandoned() const { return abandon_ && abandon_(); }

  void rewriteBlock(std::size_t block) {
    thread_local std::vector<std::byte> buffer;
    const std::uint64_t first = block * per_block_;
    const std::size_t count = std::min<std::uint64_t>(per_block_, header_.point_count - first);
    buffer.resize(per_block_ * out_length_);
    readBlock(first, count, buffer);
    editBlock({buffer.data(), count, out_length_, first});
    output_.putAt(first, buffer.data(), count);
  }

  /// Compressed points are coded in the order of the file, on several threads within; a block for
  /// each thread is edited between.
  void rewriteInOrder() {
    const std::uint64_t together = per_block_ * threadCount(threads_);
    std::vector<std::byte> buffer;
    for (std::uint64_t first = 0; first < header_.point_count && !abandoned(); first += together) {
      const std::size_t count = std::min<std::uint64_t>(together, header_.point_count - first);
      buffer.resize(count * out_length_);
      readBlock(first, count, buffer);
      parallelFor((count + per_block_ - 1) / per_block_, threads_, [&](std::size_t block) {
        const std::size_t from = block * per_block_;
        editBlock({&buffer[from * out_length_], std::min(per_block_, count - from), out_length_,
                   first + from});
      });
      if (output_.compressed())
        output_.append(buffer.data(), count);
      else
        output_.putAt(first, buffer.data(), count);
    }
  }

  void editBlock(const LasRecordBlock& block) {
    detail::LasBox before, after;
    before.add(block.records, block.count, out_length_);
    edit_(block);
    if (keeps_coordinates_)
      after = before;
    else
      after.add(block.records, block.count, out_length_);
    boxes_.add(before, after);
  }

  /// The input's records, each followed by zeros up to the output's length.
  void readBlock(std::uint64_t first, std::size_t count, std::vector<std::byte>& buffer) const {
    const std::size_t length = header_.record_length;
    if (length == out_length_) return input_.readRecords(first, count, buffer.data());
    thread_local std::vector<std::byte> packed;
    packed.resize(count * length);
    input_.readRecords(first, count, packed.data());
    for (std::size_t i = 0; i < count; ++i) {
      std::byte* record = &buffer[i * out_length_];
      std::memcpy(record, &packed[i * length], length);
      std::memset(record + length, 0, out_length_ - length);
    }
  }

  /// Stores a box that changed or was wrong.
  LasRewriteResult finish() {
    LasRewriteResult result;
    result.points = header_.point_count;
    result.box_changed = !(boxes_.before == boxes_.after);
    const PointFileInfo info = input_.info();
    const std::string wrong_box = headerBoxRemark(info, boxes_.before.inMetres(input_));
    if (result.box_changed || !wrong_box.empty()) storeBox();
    result.remarks = detail::remarksOf(input_, wrong_box, waveforms_);
    return result;
  }

  void storeBox() {
    LasHeader changed = header_;
    boxes_.after.store(changed);
    const std::vector<std::byte> bytes = serialiseLasHeader(changed);
    output_.put(kLasBoxPosition, &bytes[kLasBoxPosition], kBoxBytes);
  }

  const LasFile& input_;
  const LasEdit& edit_;
  const LasHeader header_;
  const detail::LasHead head_;
  const std::size_t out_length_;
  const std::size_t per_block_;
  const bool keeps_coordinates_;
  const std::function<bool()> abandon_;
  const int threads_;
  WaveformCopy waveforms_;
  detail::LasOutput output_;
  Boxes boxes_;
};

}  // namespace

LasRewriteResult rewriteLas(const LasFile& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads) {
  return extendLas(input, output, LasExtension(), edit, threads);
}

LasRewriteResult extendLas(const LasFile& input, const std::filesystem::path& output,
                           const LasExtension& extension, const LasEdit& edit, int threads) {
  std::error_code absent;
  if (std::filesystem::equivalent(input.path(), output, absent))
    throw UsageError(output.string() + ": input and output are the same file");
  return Rewrite(input, output, edit, extension, threads).run();
}

LasRewriteResult rewriteLas(const std::filesystem::path& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads) {
  return rewriteLas(LasFile(input), output, edit, threads);
}

}  // namespace pcl_als
