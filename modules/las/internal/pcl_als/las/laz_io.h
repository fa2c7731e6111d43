// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace pcl_als {

/// Reads bytes of a file from a position; throws where it cannot. Called by several threads at
/// once.
using LazReadAt = std::function<void(std::uint64_t position, std::size_t bytes, void* out)>;

/// Writes bytes of a file at a position; throws where it cannot. Called by one thread at a time.
using LazWriteAt = std::function<void(std::uint64_t position, std::size_t bytes, const void* data)>;

/** \brief Fields of a point record that a reader wants, as bits.
 *
 * Point formats 6 to 10 are compressed in layers: fields that are not wanted are neither read from
 * the file nor decoded, and have the value of the first point of their chunk. Formats 0 to 5 are
 * always decoded completely.
 */
enum LazField : unsigned {
  kLazZ = 1U << 0,
  kLazClassification = 1U << 1,
  kLazFlags = 1U << 2,
  kLazIntensity = 1U << 3,
  kLazScanAngle = 1U << 4,
  kLazUserData = 1U << 5,
  kLazPointSource = 1U << 6,
  kLazGpsTime = 1U << 7,
  kLazColour = 1U << 8,
  kLazInfrared = 1U << 9,
  kLazWavePacket = 1U << 10,
  kLazExtraBytes = 1U << 11,
  kLazAllFields = (1U << 12) - 1
};

}  // namespace pcl_als
