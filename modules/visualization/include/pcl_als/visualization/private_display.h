// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
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

  /** A connection to the display of that name, or nothing where it does not answer or the name is
   * empty. Keep it while drawing: an X server without `-noreset` starts anew when its last
   * connection is closed, and refuses others meanwhile. */
  static std::shared_ptr<void> connect(const std::string& name);

  /// connect() to the display that DISPLAY names.
  static std::shared_ptr<void> connectToCurrent();

 private:
  void start();
  void stop();

  pid_t server_ = 0;
  std::string name_;
  std::shared_ptr<void> connection_;  ///< to a display that was there before
};

}  // namespace pcl_als
