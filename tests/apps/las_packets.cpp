// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// las_packets inside IN.las OUT.las: moves the packets of IN.wdp into the file.
// las_packets extract IN OUT.wdp: the record of packets of a LAS or LAZ file that has them inside.
// By byte positions of the specification, without the library.
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>

#include "file_bytes.h"

namespace {

namespace fs = std::filesystem;
using pcl_als::test::readBytes;
using pcl_als::test::writeBytes;

constexpr std::size_t kEncoding = 6, kVersionMinor = 25;
constexpr std::size_t kWaveformStart = 227, kEvlrStart = 235, kEvlrCount = 243;
constexpr std::size_t kRecordHeader = 60, kRecordBytes = 20;

template <typename T>
T get(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, &bytes.at(at), sizeof value);
  return value;
}
template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(&bytes.at(at), &value, sizeof value);
}

fs::path packetsOf(fs::path las) {
  return las.replace_extension(".wdp");
}

void moveInside(const fs::path& in, const fs::path& out) {
  std::string bytes = readBytes(in);
  const auto encoding = get<std::uint16_t>(bytes, kEncoding);
  put<std::uint16_t>(bytes, kEncoding, static_cast<std::uint16_t>((encoding & ~4U) | 2U));
  put<std::uint64_t>(bytes, kWaveformStart, bytes.size());
  if (bytes[kVersionMinor] >= 4) {
    put<std::uint64_t>(bytes, kEvlrStart, bytes.size());
    put<std::uint32_t>(bytes, kEvlrCount, 1);
  }
  writeBytes(out, bytes + readBytes(packetsOf(in)));
}

void extract(const fs::path& in, const fs::path& out) {
  const std::string bytes = readBytes(in);
  const auto at = get<std::uint64_t>(bytes, kWaveformStart);
  const auto length = get<std::uint64_t>(bytes, at + kRecordBytes);
  writeBytes(out, bytes.substr(at, kRecordHeader + length));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc == 4 ? argv[1] : "";
  if (what == "inside") moveInside(argv[2], argv[3]);
  if (what == "extract") extract(argv[2], argv[3]);
  if (what == "inside" || what == "extract") return 0;
  std::cerr << "las_packets inside|extract IN OUT\n";
  return 1;
}
