// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <sys/types.h>

namespace pcl_als {

/** \brief Makes sure that there is an X display to draw to while it lives.
 *
 * Where DISPLAY names a display that answers, that one is used. Otherwise a private Xvfb is started
 * (which picks a free number itself, `-displayfd`) with software rendering; DISPLAY points to it,
 * and it ends with this object or with the process, whichever is first. Several may live in
 * different processes. InputError that names the package where Xvfb is not installed.
 *
 * Render windows must be gone before it is.
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
