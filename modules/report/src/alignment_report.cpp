// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>

#include <pcl_als/common/fields.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/report/alignment_report.h>

namespace pcl_als {
namespace {

using namespace field;
using Result = PatchAlignmentResult;

/// One of the six parameters, in m and degrees.
struct Component {
  const Result* result;
  int index;

  const Result::Parameter& state() const {
    return result->parameters[static_cast<std::size_t>(index)];
  }
  bool known() const { return state().determined; }
  bool unknown() const { return !known(); }
  const char* unit() const { return index < 3 ? "m" : "deg"; }
  double factor() const { return index < 3 ? 1.0 : kRadiansPerDegree; }
  double value() const {
    const RigidMotion& motion = result->motion;
    return (index < 3 ? motion.shift[index] : motion.rotation[index - 3]) / factor();
  }
  double std() const { return result->standardDeviation(index) / factor(); }
  double formal() const { return result->formalStandardDeviation(index) / factor(); }
};

const Fields<Result>& componentFields() {
  using C = Component;
  static const Fields<C> component(
      "parameter", "A parameter of the movement.",
      {{"value", &C::value, "Value", knownIf(&C::known)},
       {"std", &C::std, "Standard deviation", knownIf(&C::known)},
       {"std_formal", &C::formal, "The same with independent pairs", knownIf(&C::known)},
       {"unit", &C::unit, "Unit of its values", oneOf({"m", "deg"})},
       {"status", [](const C& c) { return c.known() ? "estimated" : "not_determined"; },
        "Whether it was estimated", oneOf({"estimated", "not_determined"})},
       {"reason", [](const C& c) { return c.state().reason; }, "Why it is not determined",
        onlyIf(&C::unknown)}});
  static const Fields<Result> scale(
      "scale", "Scale of the movement.",
      {{"value", [](const Result& r) { return r.motion.scale; }, "Value"},
       {"std", &Result::scale_std, "Standard deviation"},
       {"unit", [](const Result&) { return "1"; }, "Unit", oneOf({"1"})},
       {"status", [](const Result& r) { return r.scale_std > 0.0 ? "estimated" : "fixed"; },
        "Whether it was estimated", oneOf({"estimated", "fixed"})}});
  static const Fields<Result> fields("parameters", "Parameters of the movement.", [] {
    std::vector<Field<Result>> rows;
    for (int p = 0; p < Result::kParameters; ++p)
      rows.emplace_back(
          Result::name(p),
          [p](const Result& r) {
            return Component{&r, p};
          },
          component, "");
    rows.emplace_back("scale", kSameObject, scale, "");
    return rows;
  }());
  return fields;
}

/// A covariance, in m and degrees.
Field<Result> movementCovariance(const char* name, Result::Matrix6d Result::*member,
                                 const char* what) {
  return {name,
          [member](const Result& r) -> Eigen::MatrixXd {
            Eigen::Matrix<double, 6, 1> unit;
            unit << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(kRadiansPerDegree);
            return (r.*member).cwiseQuotient(unit * unit.transpose());
          },
          what};
}

const Fields<Result>& movementCovarianceFields() {
  using Names = std::vector<std::string>;
  static const Fields<Result> fields(
      "covariance", "Covariances of the parameters.",
      {{"order", [](const Result&) { return Names{"XT", "YT", "ZT", "omega", "phi", "kappa"}; },
        "The parameters"},
       {"units", [](const Result&) { return Names{"m", "m", "m", "deg", "deg", "deg"}; },
        "Their units"},
       movementCovariance("matrix", &Result::covariance,
                          "Covariances that the standard deviations are of"),
       movementCovariance("formal", &Result::covariance_formal, "With independent pairs"),
       movementCovariance("jackknife", &Result::covariance_jackknife,
                          "Of the jackknife over areas"),
       {"jackknife_groups", &Result::jackknife_groups, "Number of groups of pairs"}});
  return fields;
}

/// About the centroid: at map coordinates a matrix would lose millimetres in six digits.
const Fields<RigidMotion>& transformationFields() {
  using M = RigidMotion;
  static const Fields<M> fields(
      "transformation", "The movement as a matrix.",
      {{"origin", &M::centroid, "Origin of the coordinates"},
       Field<M>::constant("meaning", "target - origin = matrix (source - origin)", ""),
       {"matrix",
        [](const M& m) -> Eigen::MatrixXd {
          return m.transformation(m.centroid, m.centroid).matrix();
        },
        "The matrix, four rows"}});
  return fields;
}

/// The content of a file.
struct AlignmentReport {
  const Result* result;
  const AlignedStrips* strips;
};

/// Distances of some pairs.
struct Distances {
  std::size_t pairs;
  DistanceSummary before, after;
};

const Fields<Distances>& distanceFields() {
  using D = Distances;
  static const Fields<D> fields(
      "distances", "Distances of source and target.",
      {{"pairs", &D::pairs, "Number of pairs"},
       {"mean_before_m", [](const D& d) { return d.before.mean; }, "Mean before"},
       {"rms_before_m", [](const D& d) { return d.before.rms; }, "RMS before"},
       {"mean_after_m", [](const D& d) { return d.after.mean; }, "Mean after"},
       {"rms_after_m", [](const D& d) { return d.after.rms; }, "RMS after"}});
  return fields;
}

const Fields<Result>& movementFields() {
  using Status = Result::Status;
  const auto normal = [](const Result& r) {
    return Distances{r.pairs, r.normal_before, r.normal_after};
  };
  const auto vertical = [](const Result& r) {
    return Distances{r.vertical_pairs, r.vertical_before, r.vertical_after};
  };
  const auto motion = [](const Result& r) -> const auto& {
    return r.motion;
  };
  static const Fields<Result> fields(
      "result", "The movement of the source onto the target.",
      {{"status", &Result::status,
        FieldNames<Status>(toString, {Status::converged, Status::not_converged,
                                      Status::too_few_pairs, Status::no_overlap}),
        "Whether it was found"},
       {"message", &Result::message, "Why not, or what is not determined"},
       {"centroid", [](const Result& r) { return r.motion.centroid; },
        "Point that the movement is about: east, north, up", of("m")},
       Field<Result>::constant(
           "rotation",
           "target = centroid + shift + scale Rx(omega) Ry(phi) Rz(kappa) (source - centroid)", ""),
       {"parameters", kSameObject, componentFields(), "Parameters of the movement"},
       {"covariance", kSameObject, movementCovarianceFields(), "Their covariances"},
       {"transformation", motion, transformationFields(), "The movement as a matrix"},
       {"sigma0_m", &Result::sigma0, "Standard deviation of a coordinate along a normal"},
       {"redundancy", &Result::redundancy, "Redundancy"},
       {"pairs", &Result::pairs, "Pairs of a point and a patch"},
       {"iterations", &Result::iterations, "Iterations of the fine stage"},
       {"coarse_iterations", &Result::coarse_iterations, "Iterations of the coarse stage"},
       {"overlap_area_m2", &Result::overlap_area, "Area that both cover"},
       {"radius_m", &Result::radius, "RMS distance of the pairs from the centroid in plan"},
       {"normal_distance", normal, distanceFields(), "Along normals"},
       {"vertical_distance", vertical, distanceFields(), "Vertical, of level patches"}});
  return fields;
}

}  // namespace

std::string alignmentTable(const Result& result) {
  std::string table = "  parameter  unit         value          std   std formal\n";
  char line[400];
  for (int p = 0; p < Result::kParameters; ++p) {
    const int digits = p < 3 ? 4 : 6;
    const Component c{&result, p};
    if (c.known()) {
      std::snprintf(line, sizeof line, "  %-9s  %-4s  %12.*f %12.*f %12.*f\n", Result::name(p),
                    c.unit(), digits, c.value(), digits, c.std(), digits, c.formal());
    } else {
      std::snprintf(line, sizeof line, "  %-9s  %-4s  not determined: %s\n", Result::name(p),
                    c.unit(), c.state().reason.c_str());
    }
    table += line;
  }
  if (result.scale_std > 0.0) {
    std::snprintf(line, sizeof line, "  scale      1     %12.7f %12.7f\n", result.motion.scale,
                  result.scale_std);
    table += line;
  }
  const auto& c = result.motion.centroid;
  std::snprintf(line, sizeof line,
                "  about the overlap's centroid %.3f %.3f %.3f m (%.0f m2, radius %.0f m)\n"
                "  normal distance   mean %.4f, RMS %.4f m before; mean %.4f, RMS %.4f m after\n"
                "  vertical distance mean %.4f m before, %.4f m after\n"
                "  sigma0 %.4f m, %zu pairs, redundancy %zu, %d iterations\n",
                c.x(), c.y(), c.z(), result.overlap_area, result.radius, result.normal_before.mean,
                result.normal_before.rms, result.normal_after.mean, result.normal_after.rms,
                result.vertical_before.mean, result.vertical_after.mean, result.sigma0,
                result.pairs, result.redundancy, result.iterations);
  return table + line;
}

const FieldTable& icpatchFields() {
  using A = AlignedStrips;
  using F = Field<AlignmentReport>;
  const auto strips = [](const AlignmentReport& r) -> const A& { return *r.strips; };
  static const Fields<A> source("source", "The strip that is moved.",
                                {{"name", &A::source, "Its file or name"},
                                 {"points", &A::source_points, "Points in the common area"}});
  static const Fields<A> target("target", "The strip that it is moved onto.",
                                {{"name", &A::target, "Its file or name"},
                                 {"points", &A::target_points, "Points in the common area"}});
  static const Fields<AlignmentReport> fields(
      "icpatch", "Result of `pcl_als_icpatch`.",
      {F::constant("format", "pcl_als icpatch", ""),
       F::constant("version", 1, ""),
       {"source", strips, source, "The strip that is moved"},
       {"target", strips, target, "The strip that it is moved onto"},
       {"left_out", [](const AlignmentReport& r) { return r.strips->excluded; }, excludedFields(),
        "Points that took no part"},
       F::all(
           [](const AlignmentReport& r) -> const auto& { return *r.result; }, movementFields()),
       toolVersionField<AlignmentReport>()});
  return fields;
}

std::string alignmentJson(const Result& result, const AlignedStrips& strips) {
  const AlignmentReport report{&result, &strips};
  return jsonText(icpatchFields().write(&report));
}

}  // namespace pcl_als
