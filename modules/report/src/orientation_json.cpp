// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/fields.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/report/orientation_report.h>

namespace pcl_als {
namespace {

using namespace field;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// An item of the result, with whether the standard deviations of the block are reliable.
template <typename Item>
struct Rated {
  const Item* item;
  bool reliable;

  /// Unknown values without a reliable block.
  Vector known(const Vector& values) const {
    return reliable ? values : Vector::Constant(values.size(), std::nan(""));
  }
};

template <typename Item>
std::vector<Rated<Item>> rated(const std::vector<Item>& items, const BundleResult& bundle) {
  std::vector<Rated<Item>> all;
  for (const Item& item : items) all.push_back({&item, bundle.reliable()});
  return all;
}

Vector deviations(const Matrix& covariance) {
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

/// The covariance is in m and degrees, as the values.
Matrix covarianceOf(const OrientedImage& image) {
  Eigen::Matrix<double, 6, 1> unit;
  unit << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1.0 / kRadiansPerDegree);
  return unit.asDiagonal() * image.covariance * unit.asDiagonal();
}

const Fields<Rated<OrientedImage>>& imageFields() {
  using R = Rated<OrientedImage>;
  static const Fields<R> fields(
      "image", "Orientation of an image.",
      {{"image", [](const R& r) { return r.item->orientation.id; }, "Name of the image"},
       {"position_m", [](const R& r) { return r.item->orientation.position; },
        "Position of the camera: easting, northing, height"},
       {"omega_phi_kappa_deg", [](const R& r) { return r.item->orientation.angles; },
        "Rotation of the image", in(kRadiansPerDegree)},
       {"std_position_m",
        [](const R& r) -> Vector { return r.known(deviations(covarianceOf(*r.item)).head(3)); },
        "Standard deviations of the position"},
       {"std_omega_phi_kappa_deg",
        [](const R& r) -> Vector { return r.known(deviations(covarianceOf(*r.item)).tail(3)); },
        "Standard deviations of the rotation"},
       {"covariance", [](const R& r) { return covarianceOf(*r.item); },
        "Covariance of position and rotation, m and degrees", knownIf(&R::reliable)},
       {"points", [](const R& r) { return r.item->points; }, "Points that were measured in it"},
       {"places_on_lines", [](const R& r) { return r.item->lines; }, "Places on lines"},
       {"rms_mm", [](const R& r) { return r.item->rms; }, "RMS of the residuals in the image"}});
  return fields;
}

const Fields<Rated<GroundPoint>>& pointFields() {
  using R = Rated<GroundPoint>;
  static const Fields<R> fields(
      "point", "A point that was measured in images.",
      {{"point", [](const R& r) { return r.item->id; }, "Name of the point"},
       {"position_m", [](const R& r) { return r.item->position; }, "Its position"},
       {"std_m", [](const R& r) { return r.known(deviations(r.item->covariance)); },
        "Standard deviations"},
       {"covariance_m2", [](const R& r) -> Matrix { return r.item->covariance; },
        "Covariance of the position", knownIf(&R::reliable)},
       {"rays", [](const R& r) { return r.item->rays; }, "Number of images"}});
  return fields;
}

const Fields<Rated<AdjustedLine>>& lineFields() {
  using R = Rated<AdjustedLine>;
  static const Fields<R> fields(
      "line", "A control line.",
      {{"line", [](const R& r) { return r.item->line.id; }, "Name of the line"},
       {"used", [](const R& r) { return r.item->used; }, "Whether it was used"},
       {"start_m", [](const R& r) { return r.item->line.start; }, "Its start"},
       {"end_m", [](const R& r) { return r.item->line.end; }, "Its end"},
       {"shift_m", [](const R& r) -> Vector { return r.item->shift; }, "Shift by the adjustment"},
       {"std_m", [](const R& r) { return r.known(deviations(r.item->line.covariance)); },
        "Standard deviations"},
       {"redundancy", [](const R& r) { return r.item->redundancy; }, "Redundancy number"},
       {"standardised", [](const R& r) { return r.item->misfit; }, "Standardised misfit"},
       {"places", [](const R& r) { return r.item->places; }, "Places in images"}});
  return fields;
}

const Fields<Blunder>& blunderFields() {
  using B = Blunder;
  const auto kind = [](const B& b) {
    return b.image.empty() ? "control line" : b.line ? "line" : "point";
  };
  static const Fields<B> fields(
      "blunder", "A measurement that was excluded.",
      {{"kind", kind, "What was measured", oneOf({"control line", "line", "point"})},
       {"feature", &B::feature, "Name of the line or point"},
       {"image", &B::image, "The image; null of a control line",
        knownIf([](const B& b) { return !b.image.empty(); })},
       {"localised", &B::localised, "Whether it was told from its neighbours"},
       {"standardised", &B::standardised, "Standardised residual"}});
  return fields;
}

const Fields<ImageOrientationResult>& checkFields() {
  using R = ImageOrientationResult;
  using P = Rated<ImageCheckPoint>;
  static const Fields<P> points(
      "check_point", "A point whose position is known and was not used.",
      {{"point", [](const P& p) { return p.item->id; }, "Name of the point"},
       {"difference_m", [](const P& p) -> Vector { return p.item->difference; }, "Image - known"},
       {"std_m", [](const P& p) { return p.known(p.item->std); }, "Standard deviations"},
       {"rays", [](const P& p) { return p.item->rays; }, "Number of images"}});
  static const Fields<CheckSummary> summary(
      "check_summary", "Differences of all check points.",
      {{"mean_m", &CheckSummary::mean, "Mean: easting, northing, height"},
       {"std_m", &CheckSummary::std, "Standard deviations"},
       {"rmse_m", &CheckSummary::rmse, "RMSE"},
       {"rmse_total_m", &CheckSummary::total, "RMSE of the distance"}});
  static const Fields<R> fields(
      "check_points", "Check points.",
      {{"count", [](const R& r) { return r.check_points.size(); }, "Number of check points"},
       Field<R>::all([](const R& r) { return summaryOf(r.check_points); }, summary),
       {"points", [](const R& r) { return rated(r.check_points, r.bundle); }, points, "The points"},
       {"not_in_the_images", &R::missing_points, "Points that no image has"}});
  return fields;
}

/// A residual with its measurement.
struct ResidualOf {
  const ImageResidual* residual;
  const ImageMeasurement* measurement;
  bool line() const { return measurement->kind == ImageMeasurement::Kind::line; }
};

std::vector<ResidualOf> residualsOf(const ImageOrientationResult& result) {
  std::vector<ResidualOf> all;
  for (const ImageResidual& residual : result.bundle.residuals)
    all.push_back({&residual, &result.block.measurements[residual.measurement]});
  return all;
}

const Fields<ResidualOf>& residualFields() {
  using R = ResidualOf;
  static const Fields<R> fields(
      "residual", "Residual of a measurement.",
      {{"image", [](const R& r) { return r.measurement->image; }, "Image"},
       {"kind", [](const R& r) { return r.line() ? "line" : "point"; }, "What was measured",
        oneOf({"line", "point"})},
       {"feature", [](const R& r) { return r.measurement->feature; }, "Name of line or point"},
       {"residual_mm",
        [](const R& r) -> Vector { return r.residual->residual.head(r.line() ? 1 : 2); },
        "Across the line, or x and y"},
       {"redundancy", [](const R& r) { return r.residual->redundancy; }, "Redundancy number"},
       {"standardised", [](const R& r) { return r.residual->standardised; },
        "Standardised residual"},
       {"used", [](const R& r) { return r.residual->used; }, "Whether it was used"}});
  return fields;
}

const Fields<BundleResult>& bundleFields() {
  using B = BundleResult;
  using Status = B::Status;
  static const Fields<B> worst(
      "determined_worst", "The unknown that is determined worst.",
      {{"name", &B::weakest, "Its name"}, {"std_m", &B::weakest_std, "Its effect on the ground"}});
  static const Fields<B> fields(
      "adjustment", "The bundle adjustment.",
      {{"status", &B::status,
        FieldNames<Status>({{Status::converged, "converged"},
                            {Status::not_converged, "not_converged"},
                            {Status::not_determined, "not_determined"}}),
        "Whether there is a result"},
       {"message", &B::message, "Why there is none"},
       {"sigma0", &B::sigma0, "A posteriori standard deviation of unit weight"},
       {"redundancy", &B::redundancy, "Redundancy"},
       {"determined_worst", kSameObject, worst, "The unknown that is determined worst",
        onlyIf([](const B& b) { return !b.weakest.empty(); })},
       {"observations", &B::observations, "Number of observations"},
       {"unknowns", &B::unknowns, "Number of unknowns"},
       {"iterations", &B::iterations, "Number of iterations"}});
  return fields;
}

const Fields<BundleResult>& cameraTestFields() {
  using B = BundleResult;
  const auto order = [](const B&) {
    return std::vector<std::string>{"focal_length", "principal_point_x", "principal_point_y"};
  };
  static const Fields<B> fields(
      "camera_test", "Corrections of the camera that the images indicate; they are not applied.",
      {{"order", order, "Order of the values"},
       {"indicated_correction_mm", [](const B& b) -> Vector { return b.interior; }, "Corrections"},
       {"std_mm", [](const B& b) -> Vector { return b.interior_std; }, "Standard deviations"}});
  return fields;
}

const Fields<LineAssignment>& assignmentFields() {
  using A = LineAssignment;
  static const Fields<A> fields("assignment", "A line of an image and its control line.",
                                {{"image_line", &A::image_line, "Line in the images"},
                                 {"control_line", &A::object_line, "Control line"},
                                 {"distance_m", &A::distance, "Distance of both"}});
  return fields;
}

}  // namespace

const FieldTable& orientationFields() {
  using R = ImageOrientationResult;
  using F = Field<R>;
  static const Fields<R> fields(
      "orientation", "Result of `pcl_als_orient`.",
      {F::constant("format", "pcl_als orientation", ""),
       F::constant("version", 1, ""),
       F::constant("rotation",
                   "ground = position + s Rx(omega) Ry(phi) Rz(kappa) (x, y, minus the focal "
                   "length), image x to the right, y up",
                   "Convention of the rotations"),
       F::all(&R::bundle, bundleFields()),
       {"camera", [](const R& r) { return r.block.camera.name; }, "Name of the camera"},
       {"camera_test", &R::bundle, cameraTestFields(), "Test of the camera"},
       {"images", [](const R& r) { return rated(r.bundle.images, r.bundle); }, imageFields(),
        "Images"},
       {"points", [](const R& r) { return rated(r.bundle.points, r.bundle); }, pointFields(),
        "Points"},
       {"lines", [](const R& r) { return rated(r.bundle.lines, r.bundle); }, lineFields(),
        "Control lines"},
       {"blunders", [](const R& r) { return r.bundle.blunders; }, blunderFields(), "Blunders"},
       {"assigned_lines", &R::assignments, assignmentFields(), "Lines of images and control"},
       {"lines_without_control", &R::unknown_lines, "Lines of the images without a control line"},
       {"check_points", kSameObject, checkFields(), "Check points"},
       {"residuals", residualsOf, residualFields(), "Residuals"},
       {"warnings", [](const R& r) { return r.bundle.warnings; }, "What a user should know"},
       toolVersionField<R>()});
  return fields;
}

std::string orientationJson(const ImageOrientationResult& result) {
  return jsonText(orientationFields().write(&result));
}

}  // namespace pcl_als
