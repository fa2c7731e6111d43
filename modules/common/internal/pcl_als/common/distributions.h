// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als {

// Distributions of statistical tests, by Boost.Math, whose headers only the source of these
// functions includes.
//
// …Tail: the probability that a random value is larger. …Critical: the value that is exceeded with
// this probability, the inverse of …Tail. A two-sided test of level p has the critical value of
// p / 2. Where an argument is outside its range the result is NaN; the critical value of
// probability 0 is infinite.

double normalTail(double value);
double normalCritical(double tail);

/// \param freedom degrees of freedom, more than 0
double chiSquaredTail(double value, double freedom);
double chiSquaredCritical(double tail, double freedom);

/// Student's t distribution.
double studentTail(double value, double freedom);
double studentCritical(double tail, double freedom);

/// Probability of at most \a successes in \a trials, each with the probability \a success.
double binomialUpTo(double successes, double trials, double success);

}  // namespace pcl_als
