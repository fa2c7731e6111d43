// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/color.h>
#include <pcl_als/drawing/pixel_thinning.h>

class vtkRenderer;

namespace pcl_als {

/** \brief Coloured points in a window with VTK.
 *
 * Needs an X display: without one, Debian's VTK ends the process. Ask connectToDisplay() first.
 */
class PointScene {
 public:
  PointScene();
  ~PointScene();
  PointScene(const PointScene&) = delete;
  PointScene& operator=(const PointScene&) = delete;

  /// Positions relative to the camera's centre, metres; one colour each (alpha is not used).
  void setPoints(const std::vector<Eigen::Vector3f>& positions, const std::vector<Color>& colors);
  void setPointSize(double pixels);
  void setBackground(const Color& color);
  void setCamera(const OrthographicCamera& camera);

  /// Opens a window and returns when it is closed (or q is pressed). Mouse: turn, shift, zoom.
  void show(const std::string& title);

  /** A connection to the display that DISPLAY names, or null where none answers. It is to be kept
   * while a window is open: an X server without `-noreset` starts anew when its last connection is
   * closed, and refuses others meanwhile. */
  static std::shared_ptr<void> connectToDisplay();

  vtkRenderer* renderer();  ///< for further actors

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace pcl_als
