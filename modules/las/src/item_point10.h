// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "integer_predictor.h"
#include "point_context.h"

namespace pcl_als::laz {

/// An item of pointwise compression: all items of a point follow each other in one stream.
template <class Coder>
class PointwiseItem {
 public:
  virtual ~PointwiseItem() = default;
  /// Begins a chunk behind its first point, which is stored as it is.
  virtual void start(const std::uint8_t* first) = 0;
  /// Passes the item of the next point through the coder.
  virtual void code(Coder& coder, typename Coder::Record item) = 0;
};

/// The 20 bytes that point formats 0 to 5 have in common.
struct LegacyPoint {
  std::int32_t x, y, z;
  std::uint16_t intensity;
  std::uint8_t bits, classification, angle, user;
  std::uint16_t source;

  unsigned number() const { return bits & 7U; }
  unsigned returns() const { return bits >> 3U & 7U; }
  unsigned direction() const { return bits >> 6U & 1U; }
};
static_assert(sizeof(LegacyPoint) == 20, "lies in memory as in the file");

/// The fields of which every value has a model of its own for the next value.
template <class Coder>
class ByteAfterByte {
 public:
  void reset() { models_.reset(); }
  std::uint8_t code(Coder& coder, std::uint8_t last, std::uint8_t now) {
    return static_cast<std::uint8_t>(coder.symbol(models_[last], now));
  }

 private:
  ModelSet<typename Coder::Model> models_{256, 256};
};

/// Item POINT10, version 2.
template <class Coder>
class Point10V2 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override;
  void code(Coder& coder, typename Coder::Record item) override;

 private:
  static constexpr std::size_t kGroups = 16, kLevels = 8;
  enum Change : unsigned { source = 1, user = 2, angle = 4, type = 8, intensity = 16, bits = 32 };

  unsigned changes(const LegacyPoint& now) const;
  void codeAttributes(Coder& coder, LegacyPoint& now);
  void codeCoordinates(Coder& coder, LegacyPoint& now);

  LegacyPoint last_{};
  std::array<RunningMedian, kGroups> dx_median_, dy_median_;
  std::array<std::uint16_t, kGroups> last_intensity_{};
  std::array<std::int32_t, kLevels> last_z_{};
  ModelSet<typename Coder::Model> changes_{1, 64}, angles_{2, 256};
  ByteAfterByte<Coder> bits_, classifications_, users_;
  IntegerPredictor<Coder> intensity_{16, 4}, source_{16, 1}, dx_{32, 2}, dy_{32, 22}, z_{32, 20};
};

/// Item POINT10, version 1 (LASzip before 1.4).
template <class Coder>
class Point10V1 : public PointwiseItem<Coder> {
 public:
  void start(const std::uint8_t* first) override;
  void code(Coder& coder, typename Coder::Record item) override;

 private:
  enum Change : unsigned { source = 1, user = 2, angle = 4, type = 8, bits = 16, intensity = 32 };

  unsigned changes(const LegacyPoint& now) const;
  unsigned codeCoordinates(Coder& coder, LegacyPoint& now);
  void codeAttributes(Coder& coder, LegacyPoint& now, unsigned precision);

  LegacyPoint last_{};
  std::array<std::int32_t, 3> dx_last_{}, dy_last_{};
  unsigned oldest_ = 0;
  ModelSet<typename Coder::Model> changes_{1, 64};
  ByteAfterByte<Coder> bits_, classifications_, users_;
  IntegerPredictor<Coder> dx_{32, 1}, dy_{32, 20}, z_{32, 20}, intensity_{16, 1}, angle_{8, 2},
      source_{16, 1};
};

}  // namespace pcl_als::laz
