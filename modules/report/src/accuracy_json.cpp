// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/fields.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/report/accuracy_report.h>

namespace pcl_als {
namespace {

using namespace field;

const Fields<Proportion>& proportionFields() {
  using P = Proportion;
  static const Fields<P> fields("proportion", "An estimate with its 95 % confidence interval.",
                                {{"value", &P::value, "Estimate"},
                                 {"low_95", &P::low, "Lower limit"},
                                 {"high_95", &P::high, "Upper limit"}});
  return fields;
}

const Fields<AccuracyResult>& resultFields() {
  using C = ClassAccuracy;
  using R = AccuracyResult;
  static const Fields<C> classes(
      "class", "Accuracy of one class.",
      {{"name", &C::name, "Name"},
       {"classified", &C::classified, "Points classified as this class"},
       {"reference", &C::reference, "Points of this class"},
       {"correct", &C::correct, "Points of both"},
       {"users_accuracy", &C::users, proportionFields(), "Share of the classified points"},
       {"producers_accuracy", &C::producers, proportionFields(),
        "Share of the points of the class"},
       {"conditional_kappa", &C::kappa, "Kappa of the class, by row"},
       {"conditional_kappa_std", &C::kappa_std, "Its standard deviation"}});
  static const Fields<R> kappa("kappa", "Cohen's kappa.",
                               {Field<R>::all(&R::kappa_interval, proportionFields()),
                                {"std", &R::kappa_std, "Standard deviation"}});
  static const Fields<R> fields(
      "accuracy_result", "Accuracy of one classification.",
      {{"points", &R::points, "Check points"},
       {"correct", &R::correct, "Check points whose class is right"},
       {"overall_accuracy", &R::overall, proportionFields(), "Share of them"},
       {"kappa", kSameObject, kappa, "Agreement beyond chance"},
       {"classes", &R::classes, classes, "Accuracy by class"}});
  return fields;
}

const Fields<AccuracyReport>& comparisonFields() {
  using C = AccuracyComparison;
  using R = AccuracyReport;
  static const Fields<C> mcnemar(
      "mcnemar", "McNemar's test.",
      {{"only_this_right", &C::only_first_right, "Points right only in this classification"},
       {"only_other_right", &C::only_second_right, "Points right only in the other one"},
       {"chi_squared", &C::mcnemar_chi_sq, "With Edwards' correction"},
       {"p_exact", &C::mcnemar_p, "Exact probability, two-sided"}});
  static const Fields<C> difference(
      "difference", "This classification minus the other one.",
      {{"overall_difference", &C::overall_difference, "Of the overall accuracy"},
       {"kappa_difference", &C::kappa_difference, "Of kappa"},
       {"kappa_difference_std", &C::kappa_difference_std, "Its standard deviation"},
       {"z", &C::kappa_z, "Their ratio"},
       {"p_two_sided", &C::kappa_p, "Probability of a larger one by chance"},
       {"same_check_points", &C::same_points, "Whether both have the same check points"},
       {"mcnemar", kSameObject, mcnemar, "McNemar's test", onlyIf(&C::same_points)}});
  static const Fields<R> fields(
      "comparison", "Comparison with another classification.",
      {Field<R>::all([](const R& r) -> const C& { return *r.comparison; }, difference),
       {"with", &R::compared_with, "File of the other classification"},
       {"other", &R::other, resultFields(), "Its accuracy"}});
  return fields;
}

std::vector<std::vector<std::int64_t>> countsOf(const ConfusionMatrix& matrix) {
  std::vector<std::vector<std::int64_t>> rows;
  for (Eigen::Index i = 0; i < matrix.counts.rows(); ++i) {
    auto& row = rows.emplace_back();
    for (Eigen::Index j = 0; j < matrix.counts.cols(); ++j) row.push_back(matrix.counts(i, j));
  }
  return rows;
}

std::vector<std::string> remarksOf(const AccuracyReport& report) {
  std::vector<std::string> remarks = report.result.remarks;
  remarks.insert(remarks.end(), report.remarks.begin(), report.remarks.end());
  return remarks;
}

}  // namespace

const FieldTable& accuracyFields() {
  using R = AccuracyReport;
  using F = Field<R>;
  static const Fields<ConfusionMatrix> confusion(
      "confusion", "Check points by class.",
      {{"classes", &ConfusionMatrix::classes, "Names of the classes"},
       {"matrix", countsOf, "Counts: rows classified as, columns reference"}});
  static const Fields<R> fields(
      "accuracy", "Result of `pcl_als_accuracy`, and of `pcl_als_classify` with check points.",
      {F::constant("format", "pcl_als accuracy", ""),
       F::constant("version", 1, ""),
       F::all(&R::result, resultFields()),
       {"confusion", &R::matrix, confusion, "Confusion matrix"},
       {"comparison", kSameObject, comparisonFields(), "Comparison with another classification",
        onlyIf([](const R& r) { return r.comparison.has_value(); })},
       {"warnings", remarksOf, "What a user should know"},
       {"left_out", &R::excluded, excludedFields(), "Points that took no part", unlessEmpty},
       {"inputs", &R::inputs, "Files that were compared"},
       toolVersionField<R>()});
  return fields;
}

std::string accuracyJson(const AccuracyReport& report) {
  return jsonText(accuracyFields().write(&report));
}

}  // namespace pcl_als
