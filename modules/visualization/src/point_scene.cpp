// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>

#include <dlfcn.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/point_scene.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace pcl_als {

struct PointScene::Scene {
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPolyDataMapper> mapper;
  int width = 800, height = 600;
  double radius = 1.0;  ///< of all points about the camera's centre, metres
  Eigen::Vector3d to_camera = Eigen::Vector3d::UnitZ();

  /// VTK cuts off everything behind the camera, also in a parallel projection: it is placed further
  /// back.
  void standBack() {
    const Eigen::Vector3d position = (2.0 * radius + 1.0) * to_camera;
    renderer->GetActiveCamera()->SetPosition(position.x(), position.y(), position.z());
    if (points->GetNumberOfPoints() > 0) renderer->ResetCameraClippingRange();
  }
};

PointScene::PointScene() {
  vtkObject::GlobalWarningDisplayOff();  // a library does not print
  scene_ = std::make_unique<Scene>();
  scene_->window->AddRenderer(scene_->renderer);
  scene_->mapper->SetInputData(scene_->points);
  scene_->mapper->SetColorModeToDirectScalars();
  scene_->actor->SetMapper(scene_->mapper);
  scene_->actor->GetProperty()->SetRepresentationToPoints();
  scene_->actor->GetProperty()->LightingOff();
  scene_->renderer->AddActor(scene_->actor);
  scene_->renderer->GetActiveCamera()->ParallelProjectionOn();
}

PointScene::~PointScene() {
  scene_->window->Finalize();
}

void PointScene::setPoints(const std::vector<Eigen::Vector3f>& positions,
                           const std::vector<Color>& colors) {
  if (positions.size() != colors.size()) throw UsageError("a scene needs one colour per point");
  const auto count = static_cast<vtkIdType>(positions.size());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  if (count > 0) {
    std::memcpy(coordinates->GetPointer(0), positions.data(), positions.size() * 3 * sizeof(float));
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetNumberOfComponents(3);
  rgb->SetNumberOfTuples(count);
  vtkNew<vtkTypeInt64Array> offsets, connectivity;
  offsets->SetNumberOfValues(count > 0 ? 2 : 1);
  connectivity->SetNumberOfValues(count);
  offsets->SetValue(0, 0);
  if (count > 0) offsets->SetValue(1, count);
  for (vtkIdType i = 0; i < count; ++i) {
    const Color& color = colors[static_cast<std::size_t>(i)];
    rgb->SetTypedComponent(i, 0, color.r);
    rgb->SetTypedComponent(i, 1, color.g);
    rgb->SetTypedComponent(i, 2, color.b);
    connectivity->SetValue(i, i);
  }
  vtkNew<vtkCellArray> vertices;  // one cell of all points
  vertices->SetData(offsets, connectivity);
  scene_->radius = 1.0;
  for (const Eigen::Vector3f& position : positions) {
    scene_->radius = std::max<double>(scene_->radius, position.norm());
  }
  scene_->points->SetPoints(points);
  scene_->points->SetVerts(vertices);
  scene_->points->GetPointData()->SetScalars(rgb);
}

void PointScene::setPointSize(double pixels) {
  scene_->actor->GetProperty()->SetPointSize(static_cast<float>(pixels));
}

void PointScene::setBackground(const Color& color) {
  scene_->renderer->SetBackground(color.r / 255.0, color.g / 255.0, color.b / 255.0);
}

void PointScene::setCamera(const OrthographicCamera& camera) {
  scene_->width = camera.width();
  scene_->height = camera.height();
  vtkCamera* vtk_camera = scene_->renderer->GetActiveCamera();
  scene_->to_camera = camera.toCamera();
  vtk_camera->SetFocalPoint(0.0, 0.0, 0.0);
  vtk_camera->SetViewUp(camera.up().x(), camera.up().y(), camera.up().z());
  vtk_camera->SetParallelScale(0.5 * camera.height() * camera.metresPerPixel());
}

std::shared_ptr<void> PointScene::connectToDisplay() {
  // VTK brings libX11 but ends the process where a display does not answer: ask before it does.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return nullptr;
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  const auto open_display = reinterpret_cast<Open>(dlsym(library, "XOpenDisplay"));
  const auto close_display = reinterpret_cast<Close>(dlsym(library, "XCloseDisplay"));
  if (open_display == nullptr || close_display == nullptr) return nullptr;
  void* display = open_display(nullptr);  // that which DISPLAY names
  if (display == nullptr) return nullptr;
  return {display, [close_display](void* connection) { close_display(connection); }};
}

void PointScene::show(const std::string& title) {
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  scene_->window->SetSize(scene_->width, scene_->height);
  scene_->window->SetWindowName(title.c_str());
  scene_->standBack();
  interactor->SetRenderWindow(scene_->window);
  interactor->SetInteractorStyle(style);
  scene_->window->Render();
  interactor->Start();
}

vtkRenderer* PointScene::renderer() {
  return scene_->renderer;
}

}  // namespace pcl_als
