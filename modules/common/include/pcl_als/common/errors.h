// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <stdexcept>
#include <string>

namespace pcl_als {

/// Base of every exception of this library. what() is one line that names the file, record or
/// option and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A wrong argument, option or parameter value. Tools end with exit status 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Input that cannot be used: missing, corrupt, without time, without overlap. Tools end with exit
/// status 2.
class InputError : public Error {
 public:
  using Error::Error;
};

// A numerical outcome (too few pairs, rank deficiency, no convergence) is not an exception: it is a
// status with a message in the result. Tools write the result and end with exit status 3.

}  // namespace pcl_als
