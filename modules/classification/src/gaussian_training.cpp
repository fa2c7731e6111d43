// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>

#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

constexpr double kSamplesPerBand = 10.0;  // a covariance of fewer is reported
constexpr double kLeastVariance = 1e-6;   // of any direction, relative to the common variances

struct Moments {
  std::size_t n = 0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd squares;  ///< sums of products of deviations from the mean
};

Moments momentsOf(const TrainingClass& training, Eigen::Index bands) {
  Moments m{0, Eigen::VectorXd::Zero(bands), Eigen::MatrixXd::Zero(bands, bands)};
  for (const Eigen::VectorXd& sample : training.samples) {
    if (sample.size() != bands)
      throw UsageError("class " + training.name + ": a sample needs one value per band");
    if (!sample.allFinite()) continue;
    ++m.n;
    const Eigen::VectorXd before = sample - m.mean;
    m.mean += before / static_cast<double>(m.n);
    m.squares += before * (sample - m.mean).transpose();
  }
  return m;
}

/// Variances within classes, pooled; where a band never varies within a class, what it varies
/// between them, or 1.
Eigen::VectorXd commonVariances(const std::vector<Moments>& classes, Eigen::Index bands) {
  Eigen::VectorXd within = Eigen::VectorXd::Zero(bands), between = within, centre = within;
  double freedom = 0.0, total = 0.0;
  for (const Moments& m : classes) {
    within += m.squares.diagonal();
    freedom += static_cast<double>(m.n) - 1.0;
    centre += static_cast<double>(m.n) * m.mean;
    total += static_cast<double>(m.n);
  }
  centre /= total;
  for (const Moments& m : classes)
    between += static_cast<double>(m.n) / total * (m.mean - centre).cwiseAbs2();
  Eigen::VectorXd variances(bands);
  for (Eigen::Index k = 0; k < bands; ++k) {
    variances[k] = freedom > 0.0 ? within[k] / freedom : 0.0;
    if (!(variances[k] > kLeastVariance * between[k])) variances[k] = kLeastVariance * between[k];
    if (!(variances[k] > 0.0)) variances[k] = 1.0;
  }
  return variances;
}

double leastEigenvalue(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& variances) {
  const Eigen::VectorXd scale = variances.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  return symmetricEigenvalues(scaled)[0];
}

std::string text(const char* pattern, double value) {
  char buffer[60];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

GaussianClass classOf(const std::string& name, const Moments& m, const Eigen::VectorXd& variances,
                      std::vector<std::string>& remarks) {
  const auto bands = static_cast<double>(m.mean.size()), n = static_cast<double>(m.n);
  GaussianClass result;
  result.name = name;
  result.mean = m.mean;
  result.samples = m.n;
  Eigen::MatrixXd own = m.squares;
  if (m.n > 1) own /= n - 1.0;
  const bool thin = n < kSamplesPerBand * bands;
  double weight = thin ? (bands + 1.0) / (bands + n) : 0.0;
  const auto mixed = [&] {
    return Eigen::MatrixXd((1.0 - weight) * own + weight * Eigen::MatrixXd(variances.asDiagonal()));
  };
  result.covariance = mixed();
  const bool singular = leastEigenvalue(result.covariance, variances) < kLeastVariance;
  for (double least = 1e-4; weight < 1.0; least *= 10.0) {
    if (leastEigenvalue(result.covariance, variances) >= kLeastVariance) break;
    weight = std::min(1.0, std::max(weight, least));
    result.covariance = mixed();
  }
  result.shrinkage = weight;
  if (weight > 0.0)
    remarks.push_back("class " + name + ": covariance from " + std::to_string(m.n) +
                      (m.n == 1 ? " sample" : " samples") + " regularised with " +
                      text("%.3g", 100.0 * weight) + " % of the common variances (" +
                      (thin ? text("fewer than %.0f samples", kSamplesPerBand * bands)
                            : std::string(singular ? "singular" : "nearly singular")) +
                      ")");
  return result;
}

}  // namespace

TrainingResult trainGaussianModel(const std::vector<std::string>& bands,
                                  const std::vector<TrainingClass>& training) {
  const auto size = static_cast<Eigen::Index>(bands.size());
  if (size == 0) throw UsageError("a classification needs at least one band");
  TrainingResult result;
  result.model.bands = bands;
  std::vector<Moments> moments;
  std::vector<std::string> names;
  for (const TrainingClass& entry : training) {
    Moments m = momentsOf(entry, size);
    if (m.n == 0) {
      result.remarks.push_back("class " + entry.name + ": no training sample; excluded");
      continue;
    }
    moments.push_back(std::move(m));
    names.push_back(entry.name);
  }
  if (moments.size() < 2)
    throw UsageError("a classification needs training samples of at least two classes, not " +
                     std::to_string(moments.size()));
  const Eigen::VectorXd variances = commonVariances(moments, size);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    result.model.classes.push_back(classOf(names[i], moments[i], variances, result.remarks));
    result.model.classes.back().prior = 1.0 / static_cast<double>(moments.size());
  }
  return result;
}

void setPriors(const std::vector<std::pair<std::string, double>>& priors, GaussianModel& model) {
  std::vector<bool> given(model.classes.size(), false);
  double sum = 0.0;
  for (const auto& [name, prior] : priors) {
    if (!(prior > 0.0) || prior > 1.0)
      throw UsageError("prior of class " + name + ": must be greater than 0 and at most 1");
    std::size_t i = 0;
    while (i < model.classes.size() && model.classes[i].name != name) ++i;
    if (i == model.classes.size()) throw UsageError("prior of class " + name + ": no such class");
    given[i] = true;
    model.classes[i].prior = prior;
    sum += prior;
  }
  std::size_t others = 0;
  for (const bool known : given) others += known ? 0 : 1;
  if (sum > 1.0 + 1e-9 || (others == 0 && std::abs(sum - 1.0) > 1e-6) ||
      (others > 0 && sum > 1.0 - 1e-9))
    throw UsageError(text("priors: sum up to %.6g; all classes together have 1", sum));
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i]) model.classes[i].prior = (1.0 - sum) / static_cast<double>(others);
}

}  // namespace pcl_als
