// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "exact_orientation.h"

#include <array>

namespace pcl_als::tin {
namespace {

/// A sum of doubles of increasing magnitude that do not overlap: the last nonzero one has its sign.
class Expansion {
 public:
  void add(double value) {
    for (int i = 0; i < size_; ++i) {
      const double sum = value + part_[i];
      const double back = sum - value;
      part_[i] = (value - (sum - back)) + (part_[i] - back);
      value = sum;
    }
    part_[size_++] = value;
  }
  void addProduct(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  double leading() const {
    for (int i = size_ - 1; i >= 0; --i)
      if (part_[i] != 0.0) return part_[i];
    return 0.0;
  }

 private:
  std::array<double, 16> part_{};
  int size_ = 0;
};

/// a - b as a sum of two doubles, without error.
struct Difference {
  double high, low;
  Difference(double a, double b) : high(a - b) {
    const double back = a - high, forth = high + back;
    low = (a - forth) + (back - b);
  }
};

void addProduct(Expansion& sum, const Difference& a, const Difference& b, double sign) {
  sum.addProduct(sign * a.low, b.low);
  sum.addProduct(sign * a.low, b.high);
  sum.addProduct(sign * a.high, b.low);
  sum.addProduct(sign * a.high, b.high);
}

}  // namespace

double orientationExact(double ax, double ay, double bx, double by, double qx, double qy) {
  Expansion sum;
  addProduct(sum, Difference(ax, qx), Difference(by, qy), 1.0);
  addProduct(sum, Difference(ay, qy), Difference(bx, qx), -1.0);
  return sum.leading();
}

}  // namespace pcl_als::tin
