// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/photogrammetry/bundle_adjustment.h>

#include "bundle_problem.h"
#include "synthetic_block.h"

namespace pcl_als {
namespace {

using test::noisy;
using test::SyntheticBlock;
using Status = BundleResult::Status;

BundleSettings settingsOf(LineFormulation formulation) {
  BundleSettings settings;
  settings.formulation = formulation;
  return settings;
}

/// Position and angles of an image, estimated - true.
Eigen::Matrix<double, 6, 1> errorOf(const SyntheticBlock& truth, const BundleResult& result,
                                    std::size_t image) {
  Eigen::Matrix<double, 6, 1> error;
  const ImageOrientation& found = result.images[image].orientation;
  error << found.position - truth.images[image].position, found.angles - truth.images[image].angles;
  return error;
}

class BothFormulations : public testing::TestWithParam<LineFormulation> {};

TEST_P(BothFormulations, ExactDataGiveTheExactOrientation) {
  SyntheticBlock::Options options;
  options.origin = {500.0, 400.0, 200.0};  // at map coordinates the data are exact to 1e-9 m only
  const SyntheticBlock truth(options);
  const BundleResult result = adjustBundle(truth.block, settingsOf(GetParam()));
  ASSERT_EQ(result.status, Status::converged) << result.message;
  EXPECT_GT((truth.block.images[0].position - truth.images[0].position).norm(), 0.1);  // the start
  for (std::size_t i = 0; i < truth.images.size(); ++i) {
    // 1e-8 m at a distance of 1000 m from the origin: 1e-11, the rounding of the sums.
    EXPECT_LT(errorOf(truth, result, i).head<3>().norm(), 1e-8);
    EXPECT_LT(errorOf(truth, result, i).tail<3>().norm(), 1e-10);
  }
  EXPECT_TRUE(result.blunders.empty());
  EXPECT_LT(result.sigma0, 1e-5);
}

TEST_P(BothFormulations, DerivativesAreThoseOfDifferences) {
  SyntheticBlock truth(noisy(11));
  for (std::size_t i = 0; i < 3; ++i) {
    truth.block.images[i].position_sigma = 0.1;
    truth.block.images[i].angle_sigma = 1e-4;
  }
  const photogrammetry::BundleProblem problem(truth.block, GetParam());
  using photogrammetry::Observation;
  std::size_t priors = 0, controls = 0, places = 0;
  for (const Observation& o : problem.observations) {
    ++(o.isPrior() ? priors : o.isControl() ? controls : places);
    Eigen::VectorXd image = Eigen::VectorXd::Zero(6), feature = Eigen::VectorXd::Zero(1);
    if (o.image != Observation::kNone) image = problem.images[o.image];
    if (o.feature != Observation::kNone) feature = problem.features[o.feature].unknown;
    const Observation::Linear linear = o.linearised(image.data(), feature.data());
    const auto compare = [&](Eigen::VectorXd& values, const Eigen::MatrixXd& derivative) {
      for (Eigen::Index i = 0; i < derivative.cols(); ++i) {
        const bool angle = &values == &image && i > 2;
        const double step = angle ? 1e-6 : 1e-3, at = values[i];
        values[i] = at + step;
        const Eigen::VectorXd high = o.linearised(image.data(), feature.data()).residual;
        values[i] = at - step;
        const Eigen::VectorXd low = o.linearised(image.data(), feature.data()).residual;
        values[i] = at;
        const Eigen::VectorXd difference = (high - low) / (2.0 * step);
        // Residuals of up to 1e4 have 1e-12, over a step of 1e-6 m or rad 1e-6 of the largest.
        EXPECT_LT((difference - derivative.col(i)).cwiseAbs().maxCoeff(),
                  1e-6 * (1.0 + derivative.cwiseAbs().maxCoeff()));
      }
    };
    if (o.image != Observation::kNone) compare(image, linear.image);
    if (o.feature != Observation::kNone) compare(feature, linear.feature);
  }
  EXPECT_EQ(priors, 3U);
  EXPECT_EQ(controls, truth.lines.size());
  EXPECT_GT(places, 500U);
}

TEST_P(BothFormulations, ErrorsOfHundredBlocksHaveTheirCovariance) {
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Vector3d point_squares = Eigen::Vector3d::Zero();
  double count = 0.0, points = 0.0, sigma0 = 0.0, false_blunders = 0.0;
  constexpr int kSeeds = 100;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const SyntheticBlock truth(noisy(seed));
    const BundleResult result = adjustBundle(truth.block, settingsOf(GetParam()));
    ASSERT_EQ(result.status, Status::converged) << result.message;
    sigma0 += result.sigma0 / kSeeds;
    false_blunders += static_cast<double>(result.blunders.size());
    for (std::size_t i = 0; i < truth.images.size(); ++i) {
      squares += errorOf(truth, result, i)
                     .cwiseQuotient(result.images[i].covariance.diagonal().cwiseSqrt())
                     .cwiseAbs2();
      count += 1.0;
    }
    for (const GroundPoint& point : result.points) {
      const Eigen::Vector3d error =
          point.position - truth.points[static_cast<std::size_t>(std::stoi(point.id.substr(1)))];
      point_squares += error.cwiseQuotient(point.covariance.diagonal().cwiseSqrt()).cwiseAbs2();
      points += 1.0;
    }
  }
  // Images of one block share the errors of its lines: about 7 independent values of 100 blocks,
  // so that the RMS has a standard deviation of at most 0.04.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(std::sqrt(squares[i] / count), 1.0, 0.15) << i;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(point_squares[i] / points), 1.0, 0.15) << i;
  EXPECT_NEAR(sigma0, 1.0, 0.02);
  EXPECT_LT(false_blunders / kSeeds, 0.2);  // of 2000 observations, seven in a million
}

INSTANTIATE_TEST_SUITE_P(Lines, BothFormulations,
                         testing::Values(LineFormulation::coplanarity,
                                         LineFormulation::expanded_covariance));

TEST(BundleAdjustment, FormulationsAgree) {
  const SyntheticBlock truth(noisy(7));
  const BundleResult a = adjustBundle(truth.block, settingsOf(LineFormulation::coplanarity));
  const BundleResult b =
      adjustBundle(truth.block, settingsOf(LineFormulation::expanded_covariance));
  ASSERT_TRUE(a.reliable() && b.reliable());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    const Eigen::Vector3d std = a.images[i].covariance.diagonal().head<3>().cwiseSqrt();
    const Eigen::Vector3d difference =
        a.images[i].orientation.position - b.images[i].orientation.position;
    // They differ in second order only: the direction across the image of the line is held.
    EXPECT_LT(difference.cwiseQuotient(std).cwiseAbs().maxCoeff(), 0.02);
    const Eigen::Vector3d other = b.images[i].covariance.diagonal().head<3>().cwiseSqrt();
    EXPECT_LT((other - std).cwiseQuotient(std).cwiseAbs().maxCoeff(), 0.01);
  }
  EXPECT_NEAR(a.redundancy, b.redundancy, 1e-9);
}

TEST(BundleAdjustment, RedundancyNumbersSumToTheRedundancy) {
  const SyntheticBlock truth(noisy(3));
  const BundleResult result = adjustBundle(truth.block);
  double sum = 0.0;
  for (const ImageResidual& residual : result.residuals) sum += residual.redundancy;
  for (const AdjustedLine& line : result.lines) sum += line.redundancy;
  EXPECT_NEAR(sum, result.redundancy, 1e-6 * result.redundancy);
}

TEST(BundleAdjustment, BlundersAreNamedAndDoNotBiasTheResult) {
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  double count = 0.0, wrong = 0.0, found = 0.0, alarms = 0.0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SyntheticBlock::Options options = noisy(seed);
    options.points = 320;  // some 50 in an image, in three images or more
    options.base = 130.0;
    options.rows = 6;
    options.columns = 4;
    SyntheticBlock truth(options);
    std::set<std::pair<std::string, std::string>> blunders;
    for (ImageMeasurement& m : truth.block.measurements) {
      if (truth.uniform(0.0, 1.0) > 0.05) continue;
      // 50 to 2000 standard deviations; along a line a displacement does no harm.
      m.position += Eigen::Vector2d(truth.uniform(0.1, 4.0), truth.uniform(0.1, 4.0));
      blunders.emplace(m.image, m.feature);
    }
    const BundleResult result = adjustBundle(truth.block);
    ASSERT_EQ(result.status, Status::converged) << result.message;
    std::set<std::pair<std::string, std::string>> named;
    std::set<std::string> features, wrong_features;
    for (const auto& blunder : blunders) wrong_features.insert(blunder.second);
    for (const Blunder& blunder : result.blunders) {
      named.emplace(blunder.image, blunder.feature);
      if (!blunder.localised || blunder.image.empty()) features.insert(blunder.feature);
    }
    wrong += static_cast<double>(blunders.size());
    for (const auto& blunder : blunders)
      if (named.count(blunder) > 0 || features.count(blunder.second) > 0) found += 1.0;
    for (const auto& name : named)
      if (wrong_features.count(name.second) == 0) alarms += 1.0;
    for (std::size_t i = 0; i < truth.images.size(); ++i) {
      squares += errorOf(truth, result, i)
                     .cwiseQuotient(result.images[i].covariance.diagonal().cwiseSqrt())
                     .cwiseAbs2();
      count += 1.0;
    }
  }
  EXPECT_GT(found / wrong, 0.95) << found << " of " << wrong;  // some lie along their line
  EXPECT_LT(alarms / wrong, 0.03) << alarms << " of " << wrong;
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(std::sqrt(squares[i] / count), 1.0, 0.25) << i;
}

TEST(BundleAdjustment, ALineOfAnotherRidgeIsNamed) {
  SyntheticBlock truth(noisy(5));
  const Eigen::Vector3d beside(14.0, 9.0, 1.0);
  truth.block.lines[10].start += beside;
  truth.block.lines[10].end += beside;
  const BundleResult result = adjustBundle(truth.block);
  ASSERT_EQ(result.status, Status::converged) << result.message;
  ASSERT_FALSE(result.blunders.empty());
  EXPECT_EQ(result.blunders.front().feature, "L10");
  EXPECT_TRUE(result.blunders.front().image.empty());
  const auto line = std::find_if(result.lines.begin(), result.lines.end(),
                                 [](const AdjustedLine& l) { return l.line.id == "L10"; });
  ASSERT_NE(line, result.lines.end());
  EXPECT_FALSE(line->used);
}

/// Dense least squares with derivatives by differences: distances in the image from the line
/// through the images of both ends, unknowns of images, points and ends across.
class DenseBlock {
 public:
  DenseBlock(const SyntheticBlock& truth) : truth_(truth), block_(truth.block) {
    for (const ImageOrientation& image : block_.images) append(image.position, image.angles);
    for (const Eigen::Vector3d& point : truth.points) append(point);
    points_ = 6 * block_.images.size();
    lines_ = points_ + 3 * truth.points.size();
    unknown_.resize(lines_ + 4 * block_.lines.size(), 0.0);
    x_ = Eigen::Map<Eigen::VectorXd>(unknown_.data(), static_cast<Eigen::Index>(unknown_.size()));
  }
  void solve() {
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Eigen::VectorXd residual = residuals(x_);
      Eigen::MatrixXd jacobian(residual.size(), x_.size());
      for (Eigen::Index i = 0; i < x_.size(); ++i) {
        const double step = i < static_cast<Eigen::Index>(points_) && i % 6 > 2 ? 1e-6 : 1e-3;
        Eigen::VectorXd high = x_, low = x_;
        high[i] += step;
        low[i] -= step;
        jacobian.col(i) = (residuals(high) - residuals(low)) / (2.0 * step);
      }
      const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
      x_ -= normal.ldlt().solve(jacobian.transpose() * residual);
      covariance_ = normal.inverse();
    }
  }
  Eigen::VectorXd image(std::size_t i) const {
    return x_.segment<6>(static_cast<Eigen::Index>(6 * i));
  }
  Eigen::Matrix<double, 6, 1> imageStd(std::size_t i) const {
    return covariance_.diagonal().segment<6>(static_cast<Eigen::Index>(6 * i)).cwiseSqrt();
  }
  double sumOfSquares() const { return residuals(x_).squaredNorm(); }

 private:
  template <typename... Vectors>
  void append(const Vectors&... vectors) {
    (unknown_.insert(unknown_.end(), vectors.data(), vectors.data() + 3), ...);
  }
  Eigen::VectorXd residuals(const Eigen::VectorXd& x) const {
    std::vector<double> all;
    for (const ImageMeasurement& m : block_.measurements) {
      ImageOrientation image;
      const auto i = static_cast<Eigen::Index>(6 * (std::stoul(m.image.substr(1)) - 1));
      image.position = x.segment<3>(i);
      image.angles = x.segment<3>(i + 3);
      const auto feature = static_cast<std::size_t>(std::stoul(m.feature.substr(1)));
      if (m.kind == ImageMeasurement::Kind::point) {
        const Eigen::Vector2d v =
            m.position -
            truth_.imageOf(image, x.segment<3>(static_cast<Eigen::Index>(points_ + 3 * feature)));
        all.push_back(v.x() / m.sigma);
        all.push_back(v.y() / m.sigma);
        continue;
      }
      const ObjectLine& line = block_.lines[feature];
      const Eigen::Matrix<double, 3, 2> across = acrossLine(line.end - line.start);
      const auto u = static_cast<Eigen::Index>(lines_ + 4 * feature);
      const Eigen::Vector2d a = truth_.imageOf(image, line.start + across * x.segment<2>(u));
      const Eigen::Vector2d b = truth_.imageOf(image, line.end + across * x.segment<2>(u + 2));
      const Eigen::Vector2d along = (b - a).normalized(), from = m.position - a;
      all.push_back((along.x() * from.y() - along.y() * from.x()) / m.sigma);
    }
    for (std::size_t l = 0; l < block_.lines.size(); ++l) {
      const double sigma = std::sqrt(block_.lines[l].covariance(0, 0));
      for (std::size_t k = 0; k < 4; ++k)
        all.push_back(x[static_cast<Eigen::Index>(lines_ + 4 * l + k)] / sigma);
    }
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  const SyntheticBlock& truth_;
  const ImageBlock& block_;
  std::vector<double> unknown_;
  std::size_t points_ = 0, lines_ = 0;
  Eigen::VectorXd x_;
  Eigen::MatrixXd covariance_;
};

TEST(BundleAdjustment, AgreesWithDenseLeastSquares) {
  SyntheticBlock::Options options = noisy(2);
  options.columns = 2;
  options.rows = 2;
  options.points = 25;
  options.lines = 20;
  const SyntheticBlock truth(options);
  BundleSettings settings;
  settings.robust = false;
  const BundleResult result = adjustBundle(truth.block, settings);
  ASSERT_EQ(result.status, Status::converged) << result.message;
  DenseBlock dense(truth);
  dense.solve();
  const double factor = std::max(1.0, result.sigma0);
  for (std::size_t i = 0; i < truth.images.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> std = dense.imageStd(i);
    Eigen::Matrix<double, 6, 1> difference = dense.image(i);
    difference.head<3>() -= result.images[i].orientation.position;
    difference.tail<3>() -= result.images[i].orientation.angles;
    // Coordinates of 5.4e6 m in the dense solution have 1e-9 m, differences of 1e-3 m then 1e-6.
    EXPECT_LT(difference.cwiseQuotient(std).cwiseAbs().maxCoeff(), 1e-3);
    const Eigen::Matrix<double, 6, 1> ours =
        result.images[i].covariance.diagonal().cwiseSqrt() / factor;
    EXPECT_LT((ours - std).cwiseQuotient(std).cwiseAbs().maxCoeff(), 1e-3);
  }
  EXPECT_NEAR(result.sigma0 * result.sigma0 * result.redundancy, dense.sumOfSquares(),
              1e-4 * dense.sumOfSquares());
}

}  // namespace
}  // namespace pcl_als
