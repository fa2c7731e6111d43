// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/pulse_io.h>

#include "csv_table.h"

namespace pcl_als {
namespace {

constexpr std::size_t kFewestSamples = 5;
/// Largest deviation of a time from an even spacing, as share of the spacing.
constexpr double kUneven = 0.01;

}  // namespace

PulseSamples readPulse(const std::filesystem::path& path) {
  detail::CsvTable table(path);
  const std::size_t time = table.required("time_ns"), value = table.required("value");
  std::vector<double> times;
  PulseSamples pulse;
  while (table.next()) {
    times.push_back(table.number(time));
    pulse.values.push_back(table.number(value));
  }
  if (times.size() < kFewestSamples)
    throw InputError(path.string() + ": a pulse needs at least five samples");
  pulse.first_ns = times.front();
  pulse.spacing_ns = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double even = times.front() + pulse.spacing_ns * static_cast<double>(i);
    if (!(pulse.spacing_ns > 0.0) || std::abs(times[i] - even) > kUneven * pulse.spacing_ns)
      throw InputError(path.string() + ": the times of the samples are not evenly spaced");
  }
  return pulse;
}

void writePulse(const std::filesystem::path& path, const PulseSamples& pulse) {
  AtomicFile file(path);
  file.write("time_ns,value\n");
  for (std::size_t i = 0; i < pulse.values.size(); ++i)
    file.write(shortText(pulse.first_ns + pulse.spacing_ns * static_cast<double>(i)) + ',' +
               shortText(pulse.values[i]) + '\n');
  file.commit();
}

}  // namespace pcl_als
