// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "item_point10.h"

namespace pcl_als::laz {

/** \brief Times as numbers of 64 bits (the pattern of the double): up to four interleaved
 * sequences.
 *
 * Within a sequence the step from time to time is predicted as a multiple of an earlier step. Steps
 * that 32 bits do not hold start a new sequence or return to an earlier one.
 *
 * \tparam kCodesSame there is a symbol for "the same time again" (items GPSTIME11); POINT14 says it
 *         elsewhere.
 */
template <class Coder, bool kCodesSame>
class TimeSequences {
 public:
  void start(std::int64_t first);
  std::int64_t code(Coder& coder, std::int64_t now);

 private:
  static constexpr unsigned kSequences = 4, kShift = kCodesSame ? 0 : 1;
  // Symbols where the step before was zero, with kCodesSame; without, all are one less.
  enum First : unsigned { same_again = 0, short_step = 1, new_sequence = 2, other_sequence = 2 };
  // Symbols else: the multiple 0 … 500, 500 + m for -m of -1 … -10, and these.
  static constexpr std::int32_t kLargestMultiple = 500, kLeast = -10;
  static constexpr unsigned kSame = 511, kNew = 512;

  struct Sequence {
    std::int64_t time = 0;
    std::int32_t step = 0;
    unsigned surprises = 0;  ///< steps that no multiple describes, one after the other
  };

  unsigned chooseFirst(std::int64_t now) const;
  unsigned chooseMultiple(std::int64_t now) const;
  unsigned otherSequence(std::int64_t now) const;
  bool codeFirst(Coder& coder, std::int64_t now);
  bool codeMultiple(Coder& coder, std::int64_t now);
  void codeStep(Coder& coder, std::int64_t now, unsigned symbol);
  void codeNewSequence(Coder& coder, std::int64_t now);
  void changeTo(unsigned offset) { active_ = (active_ + offset) % kSequences; }

  std::array<Sequence, kSequences> sequences_;
  unsigned active_ = 0, newest_ = 0;
  ModelSet<typename Coder::Model> firsts_{1, 6 - kShift}, multiples_{1, 516 - kShift};
  IntegerPredictor<Coder> steps_{32, 9};
};

/// Item GPSTIME11, version 2.
template <class Coder>
class GpsTimeV2 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override { times_.start(load<std::int64_t>(first)); }
  void code(Coder& coder, typename Coder::Record item) override {
    const std::int64_t now =
        times_.code(coder, Coder::kEncodes ? load<std::int64_t>(item) : std::int64_t{0});
    if constexpr (!Coder::kEncodes) store(item, now);
  }

 private:
  TimeSequences<Coder, true> times_;
};

/// Item GPSTIME11, version 1: one sequence, multiples without sign.
template <class Coder>
class GpsTimeV1 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override;
  void code(Coder& coder, typename Coder::Record item) override;

 private:
  static constexpr unsigned kLargestMultiple = 509, kWhole = 510, kSame = 511;

  unsigned chooseMultiple(std::int64_t now) const;
  void codeFirst(Coder& coder, std::int64_t now);
  void codeMultiple(Coder& coder, std::int64_t now);
  void codeStep(Coder& coder, std::int64_t now, unsigned multiple);
  void codeWhole(Coder& coder, std::int64_t now);

  std::int64_t time_ = 0;
  std::int32_t step_ = 0;
  unsigned surprises_ = 0;
  ModelSet<typename Coder::Model> firsts_{1, 3}, multiples_{1, 512};
  IntegerPredictor<Coder> steps_{32, 6};
};

}  // namespace pcl_als::laz
