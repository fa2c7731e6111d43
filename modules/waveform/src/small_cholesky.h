// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

namespace pcl_als::detail {

/** \brief Cholesky factor L of a positive definite n x n matrix, row by row, in its lower part,
 * with the reciprocals of its diagonal.
 *
 * For the few parameters of a waveform, where calls of a general library cost more than the
 * arithmetic. \return false if a pivot is not positive or is lost to rounding
 */
inline bool factorise(double* m, int n) {
  constexpr double kLeastPivot = 1e-13;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      double sum = m[i * n + j];
      for (int k = 0; k < j; ++k) sum -= m[i * n + k] * m[j * n + k];
      m[i * n + j] = sum * m[j * n + j];
    }
    const double diagonal = m[i * n + i];
    double pivot = diagonal;
    for (int k = 0; k < i; ++k) pivot -= m[i * n + k] * m[i * n + k];
    if (!(pivot > kLeastPivot * diagonal)) return false;
    m[i * n + i] = 1.0 / std::sqrt(pivot);
  }
  return true;
}

/// Solves with the factor, in place.
inline void solve(const double* m, int n, double* x) {
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= m[i * n + k] * x[k];
    x[i] *= m[i * n + i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= m[k * n + i] * x[k];
    x[i] *= m[i * n + i];
  }
}

/// The inverse of the matrix whose factor is given, n x n, symmetric.
inline void invertFactorised(const double* m, int n, double* inverse) {
  for (int j = 0; j < n; ++j) {
    double* column = inverse + j * n;  // row and column are the same
    for (int i = 0; i < n; ++i) column[i] = i == j ? 1.0 : 0.0;
    solve(m, n, column);
  }
}

}  // namespace pcl_als::detail
