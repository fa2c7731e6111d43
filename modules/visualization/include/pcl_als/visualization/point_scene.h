// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/visualization/image.h>
#include <pcl_als/visualization/orthographic_camera.h>

class vtkRenderer;

namespace pcl_als {

/** \brief Coloured points in a VTK scene, to an image or in a window.
 *
 * Needs a display during its lifetime: make a PrivateDisplay first. Pictures are drawn without
 * antialiasing, so that a point has exactly its colour.
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

  /// The scene at the camera's size.
  Image render();
  /// Opens a window and returns when it is closed (or q is pressed). Mouse: turn, shift, zoom.
  void show(const std::string& title);

  vtkRenderer* renderer();  ///< for further actors

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace pcl_als
