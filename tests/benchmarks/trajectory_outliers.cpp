// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// trajectory_outliers SEEDS FILE…: outliers that screenTrajectory() finds in trajectories as they
// are, and in trajectories with one wrong sample each. Prints the tables of trajectory_outliers.md.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/trajectory/trajectory_screening.h>

namespace {

using Samples = std::vector<pcl_als::TrajectorySample>;

Samples everyNth(const Samples& samples, std::size_t n) {
  Samples some;
  for (std::size_t i = 0; i < samples.size(); i += n) some.push_back(samples[i]);
  return some;
}

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

Samples withRounding(Samples samples, double metres, double degrees, double seconds) {
  const double angle = degrees * pcl_als::kRadiansPerDegree;
  for (pcl_als::TrajectorySample& s : samples) {
    s.time = rounded(s.time, seconds);
    for (int axis = 0; axis < 3; ++axis) s.position[axis] = rounded(s.position[axis], metres);
    s.roll = rounded(s.roll, angle), s.pitch = rounded(s.pitch, angle);
    s.heading = rounded(s.heading, angle);
  }
  return samples;
}

struct Error {
  std::string name;
  double size;
  void (*apply)(pcl_als::TrajectorySample& sample, double size, std::mt19937& random);
};

void shift(pcl_als::TrajectorySample& sample, double size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector3d direction(normal(random), normal(random), normal(random));
  sample.position += size * direction.normalized();
}

void turnHeading(pcl_als::TrajectorySample& sample, double size, std::mt19937&) {
  sample.heading += size * pcl_als::kRadiansPerDegree;
}

void turnRoll(pcl_als::TrajectorySample& sample, double size, std::mt19937&) {
  sample.roll += size * pcl_als::kRadiansPerDegree;
}

void delay(pcl_als::TrajectorySample& sample, double size, std::mt19937&) {
  sample.time += size;
}

const std::vector<Error>& errors() {
  static const std::vector<Error> all = {{"position 0.3 m", 0.3, shift},
                                         {"position 1 m", 1.0, shift},
                                         {"position 3 m", 3.0, shift},
                                         {"position 10 m", 10.0, shift},
                                         {"position 100 m", 100.0, shift},
                                         {"position 10 km", 1e4, shift},
                                         {"position 1000 km", 1e6, shift},
                                         {"heading 5 deg", 5.0, turnHeading},
                                         {"heading 20 deg", 20.0, turnHeading},
                                         {"heading 90 deg", 90.0, turnHeading},
                                         {"heading 180 deg", 180.0, turnHeading},
                                         {"roll 5 deg", 5.0, turnRoll},
                                         {"roll 30 deg", 30.0, turnRoll},
                                         {"time 3 s", 3.0, delay}};
  return all;
}

struct Rate {
  std::size_t tried = 0, found = 0, others = 0;
};

void inject(const Samples& samples, const Error& error, int seeds, unsigned first, Rate& rate) {
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(first + static_cast<unsigned>(seed));
    // A part of the flight, because only the neighbours matter.
    const std::size_t length = std::min<std::size_t>(1000, samples.size());
    const std::size_t from = random() % (samples.size() - length + 1);
    Samples part(samples.begin() + static_cast<std::ptrdiff_t>(from),
                 samples.begin() + static_cast<std::ptrdiff_t>(from + length));
    const std::size_t wrong = random() % length;
    const double end = part.back().time;
    error.apply(part[wrong], error.size, random);
    // Behind the end of the part there is nothing to compare it with.
    if (part[wrong].time > end) continue;
    const pcl_als::TrajectoryScreening screening = pcl_als::screenTrajectory(part);
    ++rate.tried;
    bool found = false;
    for (const std::size_t i : screening.indices()) {
      if (i == wrong)
        found = true;
      else
        ++rate.others;
    }
    rate.found += found || !screening.objection().empty();
  }
}

void countFalse(const std::string& name, const Samples& samples) {
  const auto begin = std::chrono::steady_clock::now();
  const pcl_als::TrajectoryScreening screening = pcl_als::screenTrajectory(samples);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::printf("| %s | %zu | %zu | %.3f |%s%s\n", name.c_str(), samples.size(),
              screening.outlierCount(), taken.count(), screening.describe().c_str(),
              screening.objection().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 0;
  std::vector<std::vector<Rate>> rates(3, std::vector<Rate>(errors().size()));
  std::puts("| trajectory | samples | left out | s |\n|---|---|---|---|");
  for (int arg = 2; arg < argc; ++arg) {
    const Samples samples = pcl_als::readTrajectory(argv[arg], "EPSG:32611");
    const double step = samples[1].time - samples[0].time;
    const std::string name = argv[arg];
    countFalse(name, samples);
    const double cases[][3] = {
        {0.01, 1e-3, 1e-6}, {0.1, 0.01, 1e-3}, {1.0, 1.0, 1e-6}, {1e-4, 1e-6, 0.01}};
    for (const auto& c : cases)
      countFalse(name + ", rounded", withRounding(samples, c[0], c[1], c[2]));
    const double frequencies[] = {0.0, 10.0, 1.0};
    for (std::size_t f = 0; f < 3; ++f) {
      const auto every = static_cast<std::size_t>(
          frequencies[f] == 0.0 ? 1.0 : std::max(1.0, std::round(1.0 / (frequencies[f] * step))));
      const Samples some = everyNth(samples, every);
      if (every > 1) {
        countFalse(name + (f == 1 ? ", 10 Hz" : ", 1 Hz"), some);
        countFalse(name + (f == 1 ? ", 10 Hz" : ", 1 Hz") + ", rounded",
                   withRounding(some, 0.01, 1e-3, 1e-6));
      }
      if (some.size() < 30) continue;
      for (std::size_t e = 0; e < errors().size(); ++e)
        inject(some, errors()[e], seeds, static_cast<unsigned>(arg) * 100000u, rates[f][e]);
    }
  }
  if (seeds == 0) return 0;
  std::puts(
      "\n| error of one sample | as recorded | others | 10 Hz | others | 1 Hz | others |\n"
      "|---|---|---|---|---|---|---|");
  for (std::size_t e = 0; e < errors().size(); ++e) {
    std::printf("| %s |", errors()[e].name.c_str());
    for (const std::vector<Rate>& of : rates)
      std::printf(" %zu of %zu | %zu |", of[e].found, of[e].tried, of[e].others);
    std::puts("");
  }
  return 0;
}
