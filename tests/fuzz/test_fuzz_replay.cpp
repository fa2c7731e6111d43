// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "fuzz_targets.h"

namespace pcl_als::fuzz {
namespace {

/// Changes inputs at random places, always the same for the same seed.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string bytes, const std::string& other) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes; ++i) change(bytes, other);
    return bytes;
  }

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }

  template <typename T>
  void overwrite(std::string& bytes, T value) {
    if (bytes.size() < sizeof value) return;
    std::memcpy(&bytes[below(bytes.size() - sizeof value + 1)], &value, sizeof value);
  }

  /// Values at which checks go wrong.
  void overwriteNumber(std::string& bytes) {
    static const std::uint64_t numbers[] = {0,          1,
                                            0x7F,       0x80,
                                            0xFF,       0xFFFF,
                                            0x7FFFFFFF, 0x80000000,
                                            0xFFFFFFFF, 0x7FF0000000000000,
                                            ~0ULL,      0x7FFFFFFFFFFFFFFF};
    const std::uint64_t number = numbers[below(std::size(numbers))];
    switch (below(4)) {
      case 0:
        return overwrite(bytes, static_cast<std::uint8_t>(number));
      case 1:
        return overwrite(bytes, static_cast<std::uint16_t>(number));
      case 2:
        return overwrite(bytes, static_cast<std::uint32_t>(number));
      default:
        return overwrite(bytes, number);
    }
  }

  void change(std::string& bytes, const std::string& other) {
    switch (below(7)) {
      case 0:
        bytes.resize(below(bytes.size() + 1));
        break;
      case 1:
        bytes.insert(below(bytes.size() + 1), 1 + below(8), static_cast<char>(random_()));
        break;
      case 2:
        bytes.erase(below(bytes.size() + 1), 1 + below(8));
        break;
      case 3:
        bytes = bytes.substr(0, below(bytes.size() + 1)) + other.substr(below(other.size()));
        break;
      case 4:
        overwrite(bytes, static_cast<std::uint8_t>(1U << below(8)));
        break;
      default:
        overwriteNumber(bytes);
    }
  }

  std::mt19937 random_;
};

class FuzzReplay : public testing::TestWithParam<Target> {};

bool feed(const Target& target, const std::string& bytes) {
  return target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

TEST_P(FuzzReplay, SeedsAreAccepted) {
#ifndef PCL_ALS_HAVE_PROJ
  if (std::string(GetParam().name) == "sbet") GTEST_SKIP() << "this build has no PROJ";
#endif
  // Those of the codec are whole files, and files whose chunk size contradicts their chunks.
  const bool contradictory = std::string(GetParam().name) == "laz_codec";
  const std::vector<std::string> seeds = GetParam().seeds();
  std::size_t accepted = 0;
  for (const std::string& seed : seeds) accepted += feed(GetParam(), seed) ? 1 : 0;
  EXPECT_GE(accepted, contradictory ? seeds.size() / 6 : seeds.size());
}

TEST_P(FuzzReplay, SeedsAndTheirMutationsAreReadOrRefused) {
  const std::vector<std::string> seeds = GetParam().seeds();
  Mutator mutator(20110901);
  // PROJ takes milliseconds to make a CRS of the keys of a GeoTIFF.
  const std::size_t rounds = std::string(GetParam().name) == "geotiff" ? 300 : 1500;
  for (std::size_t i = 0; i < rounds; ++i) {
    const std::string& seed = seeds[i % seeds.size()];
    const std::string bytes =
        i < seeds.size() ? seed : mutator.mutate(seed, seeds[(i * 7 + 3) % seeds.size()]);
    EXPECT_NO_THROW(feed(GetParam(), bytes)) << "round " << i;
  }
}

TEST_P(FuzzReplay, EveryTruncationIsReadOrRefused) {
  const std::string seed = GetParam().seeds()[0];
  for (std::size_t size = 0; size < seed.size(); size += 1 + seed.size() / 300)
    EXPECT_NO_THROW(feed(GetParam(), seed.substr(0, size))) << size << " bytes";
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(readerTargets()),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(LandCover, FuzzReplay, testing::ValuesIn(landCoverTargets()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pcl_als::fuzz
