// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <sys/types.h>

namespace pcl_als {

/** \brief Provides an X display for drawing during its lifetime.
 *
 * A display that DISPLAY names and that answers is used. Otherwise a private Xvfb is started (which
 * chooses a free number itself, `-displayfd`) with software rendering; DISPLAY is set to it, and it
 * ends with this object or with the process. Several may exist in different processes. InputError
 * that names the package where Xvfb is not installed.
 *
 * Render windows must be destroyed before it.
 */
class PrivateDisplay {
 public:
  PrivateDisplay();
  ~PrivateDisplay();
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay& operator=(const PrivateDisplay&) = delete;

  bool isPrivate() const { return server_ > 0; }
  const std::string& name() const { return name_; }  ///< ":99"

  /// Whether a display of that name can be opened; empty: none.
  static bool answers(const std::string& name);

 private:
  void start();
  void stop();

  pid_t server_ = 0;
  std::string name_;
};

}  // namespace pcl_als
