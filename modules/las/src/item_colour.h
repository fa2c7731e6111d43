// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "item_point10.h"

namespace pcl_als::laz {

using Colour = std::array<std::uint16_t, 3>;

/// Red, green and blue by their bytes: green and blue are predicted from the change of red.
template <class Coder>
class ColourCoder {
 public:
  void reset();
  /// \param[in,out] last the colour before; becomes \a now.
  /// \return whether anything was coded but "grey and as before".
  bool code(Coder& coder, Colour now, Colour& last);

 private:
  using Halves = std::array<std::array<std::uint8_t, 3>, 2>;  ///< lower and upper bytes
  static constexpr unsigned kNotGrey = 64;

  static Halves halves(const Colour& colour);
  static unsigned changes(const Halves& now, const Halves& last);
  std::uint8_t codeByte(Coder& coder, unsigned part, unsigned changed, int predicted,
                        std::uint8_t now, std::uint8_t last);
  void codeOthers(Coder& coder, unsigned changed, Halves& now, const Halves& last);

  ModelSet<typename Coder::Model> changes_{1, 128}, corrections_{6, 256};
};

/// Near infrared: the two bytes of one number.
template <class Coder>
class InfraredCoder {
 public:
  void reset();
  bool code(Coder& coder, std::uint16_t now, std::uint16_t& last);

 private:
  ModelSet<typename Coder::Model> changes_{1, 4}, corrections_{2, 256};
};

/// Item RGB12, version 2.
template <class Coder>
class ColourV2 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override {
    last_ = load<Colour>(first);
    colour_.reset();
  }
  void code(Coder& coder, typename Coder::Record item) override {
    colour_.code(coder, Coder::kEncodes ? load<Colour>(item) : Colour(), last_);
    if constexpr (!Coder::kEncodes) store(item, last_);
  }

 private:
  Colour last_{};
  ColourCoder<Coder> colour_;
};

/// Item RGB12, version 1: every byte that changed is predicted by the one before.
template <class Coder>
class ColourV1 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override;
  void code(Coder& coder, typename Coder::Record item) override;

 private:
  static constexpr unsigned kBytes = 6;

  std::array<std::uint8_t, kBytes> last_{};
  ModelSet<typename Coder::Model> changes_{1, 64};
  IntegerPredictor<Coder> bytes_{8, kBytes};
};

}  // namespace pcl_als::laz
