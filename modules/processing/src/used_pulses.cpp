// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "used_pulses.h"

#include <utility>

namespace pcl_als::detail {

void describePulses(const ResponseChoice& choice,
                    const std::map<unsigned, WaveformDescriptor>& descriptors,
                    const std::string& given, WaveformResult& result) {
  const auto nanoseconds = [&descriptors](unsigned descriptor, double samples) {
    return samples * descriptors.at(descriptor).spacing_ps / kPicosecondsPerNanosecond;
  };
  for (const auto& [index, response] : choice.by_descriptor) {
    UsedPulse used{index, nanoseconds(index, kFwhmOfGaussian * response.width()), given};
    const auto own = choice.estimates.find(index);
    if (own != choice.estimates.end())
      used.origin = describe(own->second);
    else if (!choice.estimates.empty())
      used.origin = "that of descriptor " + std::to_string(choice.usual);
    result.pulses.push_back(std::move(used));
  }
  const unsigned usual =
      choice.estimates.empty() ? choice.by_descriptor.begin()->first : choice.usual;
  const ResponseSamples samples = choice.by_descriptor.at(usual).samples();
  result.pulse = samples.values;
  result.pulse_spacing_ns = nanoseconds(usual, samples.spacing);
  result.pulse_first_ns = nanoseconds(usual, samples.timeOf(0));
}

}  // namespace pcl_als::detail
