// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <pcl_als/common/distributions.h>

namespace pcl_als {
namespace {

namespace bm = boost::math;

// As the functions of <cmath>: NaN or infinity in place of an exception.
using Policy = bm::policies::policy<bm::policies::domain_error<bm::policies::ignore_error>,
                                    bm::policies::overflow_error<bm::policies::ignore_error>>;
using Normal = bm::normal_distribution<double, Policy>;
using ChiSquared = bm::chi_squared_distribution<double, Policy>;
using Student = bm::students_t_distribution<double, Policy>;
using Binomial = bm::binomial_distribution<double, Policy>;

}  // namespace

double normalTail(double value) {
  return bm::cdf(bm::complement(Normal(), value));
}

double normalCritical(double tail) {
  return bm::quantile(bm::complement(Normal(), tail));
}

double chiSquaredTail(double value, double freedom) {
  return bm::cdf(bm::complement(ChiSquared(freedom), value));
}

double chiSquaredCritical(double tail, double freedom) {
  return bm::quantile(bm::complement(ChiSquared(freedom), tail));
}

double studentTail(double value, double freedom) {
  return bm::cdf(bm::complement(Student(freedom), value));
}

double studentCritical(double tail, double freedom) {
  return bm::quantile(bm::complement(Student(freedom), tail));
}

double binomialUpTo(double successes, double trials, double success) {
  return bm::cdf(Binomial(trials, success), successes);
}

}  // namespace pcl_als
