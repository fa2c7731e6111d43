// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "entropy_coder.h"

namespace pcl_als::laz {

/** \brief Codes integers as corrections of predictions.
 *
 * A correction c falls into class k = 0 for c in {0, 1}, else k with -2^k < c <= -2^(k-1) or
 * 2^(k-1) < c <= 2^k. The class has a model per context; the place within the class has one model
 * per class, of its upper 8 bits where it has more, and the bits below follow raw.
 */
template <class Coder>
class IntegerPredictor {
 public:
  using Model = typename Coder::Model;

  IntegerPredictor(unsigned bits, std::size_t contexts)
      : bits_(bits), classes_(contexts, bits + 1) {
    for (unsigned k = 1; k <= bits && k < 32; ++k)
      places_.emplace_back(1, 1U << std::min(k, kModelledBits));
  }

  void reset() {
    classes_.reset();
    unit_.reset();
    for (auto& place : places_) place.reset();
  }

  /// Class of the last correction: how well this was predicted.
  unsigned lastClass() const { return class_; }

  /// The actual value; of fewer than 32 bits, only these are right.
  std::int32_t code(Coder& coder, std::int32_t predicted, std::int32_t actual,
                    std::size_t context = 0) {
    std::uint32_t correction = 0;
    if constexpr (Coder::kEncodes) correction = folded(actual, predicted);
    correction = codeCorrection(coder, correction, classes_[context]);
    if constexpr (Coder::kEncodes) return actual;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(predicted) + correction);
  }

 private:
  static constexpr unsigned kModelledBits = 8;

  /// The difference modulo 2^bits, as the number next to zero.
  std::uint32_t folded(std::int32_t actual, std::int32_t predicted) const {
    const std::uint32_t difference =
        static_cast<std::uint32_t>(actual) - static_cast<std::uint32_t>(predicted);
    const unsigned unused = 32 - bits_;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(difference << unused) >> unused);
  }

  static unsigned classOf(std::uint32_t correction) {
    const bool positive = static_cast<std::int32_t>(correction) > 0;
    return digits(positive ? correction - 1 : 0U - correction);
  }

  std::uint32_t codeCorrection(Coder& coder, std::uint32_t correction, Model& classes) {
    class_ = coder.symbol(classes, Coder::kEncodes ? classOf(correction) : 0);
    if (class_ == 0) return coder.bit(unit_, correction);
    if (class_ == 32) return 1U << 31;
    // Places count from the most negative correction of the class on; the gap in the middle is left
    // out.
    const std::uint32_t shift = (1U << class_) - 1U;
    std::uint32_t place = 0;
    if constexpr (Coder::kEncodes)
      place = static_cast<std::int32_t>(correction) < 0 ? correction + shift : correction - 1;
    place = codePlace(coder, place);
    return place >> (class_ - 1) != 0 ? place + 1 : place - shift;
  }

  std::uint32_t codePlace(Coder& coder, std::uint32_t place) {
    Model& model = places_[class_ - 1][0];
    if (class_ <= kModelledBits) return coder.symbol(model, place);
    const unsigned below = class_ - kModelledBits;
    const std::uint32_t upper = coder.symbol(model, place >> below);
    return upper << below | coder.raw(below, place & ((1U << below) - 1U));
  }

  unsigned bits_;
  unsigned class_ = 0;
  ModelSet<Model> classes_;
  BitModel unit_;
  std::vector<ModelSet<Model>> places_;
};

}  // namespace pcl_als::laz
