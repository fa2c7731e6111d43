// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// direct_maxlik GRIDS.tif TRAINING.csv BAND,… MAP.tif [POSTERIOR.tif]: the map of pcl_als_classify
// computed again, cell for cell, by other means: statistics by two passes and inverses by Gauss and
// Jordan's elimination in extended precision; nothing of module classification. Equal priors,
// training points only, no rejection, and classes that need no regularisation. Ends with 1 where a
// class differs, or a posterior by more than a float's rounding.
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/io/raster_io.h>

namespace {

using Number = long double;
using Vector = std::vector<Number>;

struct Statistics {
  Vector mean;
  std::vector<Vector> inverse;
  Number log_determinant = 0;
};

/// Turns a matrix into its inverse; returns ln of its determinant.
Number invert(std::vector<Vector>& a) {
  const std::size_t n = a.size();
  std::vector<Vector> inverse(n, Vector(n, 0));
  for (std::size_t i = 0; i < n; ++i) inverse[i][i] = 1;
  Number log_determinant = 0;
  for (std::size_t column = 0; column < n; ++column) {
    const Number pivot = a[column][column];  // positive: the matrix is a covariance
    log_determinant += std::log(pivot);
    for (std::size_t k = 0; k < n; ++k) a[column][k] /= pivot, inverse[column][k] /= pivot;
    for (std::size_t row = 0; row < n; ++row) {
      if (row == column) continue;
      const Number factor = a[row][column];
      for (std::size_t k = 0; k < n; ++k) {
        a[row][k] -= factor * a[column][k];
        inverse[row][k] -= factor * inverse[column][k];
      }
    }
  }
  a = inverse;
  return log_determinant;
}

Statistics statisticsOf(const std::vector<Vector>& samples) {
  const std::size_t bands = samples.front().size();
  const auto n = static_cast<Number>(samples.size());
  Statistics s{Vector(bands, 0), std::vector<Vector>(bands, Vector(bands, 0)), 0};
  for (const Vector& x : samples)
    for (std::size_t i = 0; i < bands; ++i) s.mean[i] += x[i] / n;
  for (const Vector& x : samples)
    for (std::size_t i = 0; i < bands; ++i)
      for (std::size_t j = 0; j < bands; ++j)
        s.inverse[i][j] += (x[i] - s.mean[i]) * (x[j] - s.mean[j]) / (n - 1);
  s.log_determinant = invert(s.inverse);
  return s;
}

/// ln of the density but for what all classes share.
Number logDensity(const Statistics& s, const Vector& x) {
  Number distance = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      distance += (x[i] - s.mean[i]) * s.inverse[i][j] * (x[j] - s.mean[j]);
  return -(s.log_determinant + distance) / 2;
}

/// The bands of a cell; empty where one has no value.
Vector cellOf(const std::vector<const std::vector<float>*>& bands, std::size_t cell) {
  Vector x;
  for (const std::vector<float>* band : bands) {
    if (std::isnan((*band)[cell])) return {};
    x.push_back(static_cast<Number>((*band)[cell]));
  }
  return x;
}

std::map<std::string, Statistics> train(const std::string& path, const pcl_als::RasterGrid& grid,
                                        const std::vector<const std::vector<float>*>& bands) {
  std::map<std::string, std::vector<Vector>> samples;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);  // x,y,class
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string x, y, name;
    std::getline(std::getline(std::getline(fields, x, ','), y, ','), name);
    const double column = std::floor((std::stod(x) - grid.west) / grid.cell),
                 row = std::floor((grid.north - std::stod(y)) / grid.cell);
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) continue;
    Vector values = cellOf(bands, static_cast<std::size_t>(row * grid.columns + column));
    if (!values.empty()) samples[name].push_back(std::move(values));
  }
  std::map<std::string, Statistics> classes;
  for (const auto& [name, values] : samples) classes[name] = statisticsOf(values);
  return classes;
}

struct Difference {
  std::size_t cells = 0, classes = 0;
  Number posterior = 0;
};

Difference compare(const std::map<std::string, Statistics>& classes,
                   const std::vector<const std::vector<float>*>& bands,
                   const pcl_als::CodeRaster& map, const std::vector<float>& posterior) {
  std::map<std::string, int> codes;
  for (const pcl_als::CodeMeaning& entry : map.legend) codes[entry.name] = entry.value;
  Difference result;
  for (std::size_t cell = 0; cell < map.values.size(); ++cell) {
    const Vector x = cellOf(bands, cell);
    int code = 0;
    Number best = 0, sum = 0;
    for (const auto& [name, statistics] : classes) {
      if (x.empty()) break;
      const Number score = logDensity(statistics, x);
      if (code == 0 || score > best) {
        sum = code == 0 ? 1 : sum * std::exp(best - score) + 1;
        best = score;
        code = codes.at(name);
      } else {
        sum += std::exp(score - best);
      }
    }
    result.cells += code != 0;
    result.classes += code != map.values[cell];
    if (code != 0 && !posterior.empty())
      result.posterior =
          std::max(result.posterior, std::abs(1 / sum - static_cast<Number>(posterior[cell])));
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "direct_maxlik GRIDS.tif TRAINING.csv BAND,… MAP.tif [POSTERIOR.tif]\n";
    return 2;
  }
  const pcl_als::Raster grids = pcl_als::readRaster(argv[1]);
  std::vector<const std::vector<float>*> bands;
  std::istringstream names(argv[3]);
  for (std::string name; std::getline(names, name, ',');) bands.push_back(&grids.band(name).values);
  std::vector<float> posterior;
  if (argc > 5) posterior = pcl_als::readRaster(argv[5]).bands.at(0).values;
  const Difference difference = compare(train(argv[2], grids.grid, bands), bands,
                                        pcl_als::readCodeRaster(argv[4]), posterior);
  std::cout << difference.cells << " cells classified, " << difference.classes
            << " differ; largest difference of a posterior "
            << static_cast<double>(difference.posterior) << "\n";
  // Half a unit in the last place of a float under 1 is 3e-8; twice that for the double before it.
  return difference.cells > 0 && difference.classes == 0 && difference.posterior < 6e-8L ? 0 : 1;
}
