// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// las_in_feet IN OUT EPSG: a copy of a LAS file whose coordinates count in US survey feet. The raw
// integers stay; scale, offset and bounding box of the header are divided by the length of the
// foot, and GeoTIFF keys state the CRS (3072) and the unit of plan and heights (3076, 4099). Each
// point is where it was, to rounding of a double.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kEncoding = 6, kHeaderSize = 94, kOffsetToPoints = 96, kVlrCount = 100;
constexpr std::size_t kScale = 131, kEvlrStart = 235, kVlrHeader = 54;
constexpr double kSurveyFoot = 12.0 / 39.37;

template <typename T>
T load(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}
template <typename T>
void store(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

std::string keyRecord(std::uint16_t epsg) {
  const std::uint16_t keys[] = {1, 1,    0,    4, 1024, 0,    1,    1, 3072, 0,
                                1, epsg, 3076, 0, 1,    9003, 4099, 0, 1,    9003};
  std::string record(kVlrHeader, '\0');
  record.replace(2, 15, "LASF_Projection");
  store(record, 18, std::uint16_t{34735});
  store(record, 20, static_cast<std::uint16_t>(sizeof keys));
  return record.append(reinterpret_cast<const char*>(keys), sizeof keys);
}

/// The VLRs without those of the CRS.
std::string otherRecords(const std::string& bytes, std::uint32_t& kept) {
  std::string records;
  std::size_t at = load<std::uint16_t>(bytes, kHeaderSize);
  for (std::uint32_t left = load<std::uint32_t>(bytes, kVlrCount); left > 0; --left) {
    const std::size_t size = kVlrHeader + load<std::uint16_t>(bytes, at + 20);
    if (bytes.compare(at + 2, 15, "LASF_Projection") != 0) {
      records += bytes.substr(at, size);
      ++kept;
    }
    at += size;
  }
  return records;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return EXIT_FAILURE;
  std::ifstream in(argv[1], std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < 227 || bytes.compare(0, 4, "LASF") != 0) {
    std::cerr << "las_in_feet: " << argv[1] << " is no LAS file\n";
    return EXIT_FAILURE;
  }
  const std::size_t header_size = load<std::uint16_t>(bytes, kHeaderSize);
  const std::size_t points = load<std::uint32_t>(bytes, kOffsetToPoints);
  for (std::size_t at = kScale; at < kScale + 12 * 8; at += 8)  // scale, offset, box
    store(bytes, at, load<double>(bytes, at) / kSurveyFoot);
  std::uint32_t records = 1;
  const std::string vlrs =
      keyRecord(static_cast<std::uint16_t>(std::atoi(argv[3]))) + otherRecords(bytes, records);
  const std::size_t new_points = header_size + vlrs.size();
  store(bytes, kVlrCount, records);
  store(bytes, kOffsetToPoints, static_cast<std::uint32_t>(new_points));
  store(bytes, kEncoding, static_cast<std::uint16_t>(load<std::uint16_t>(bytes, kEncoding) & ~16U));
  if (bytes[25] >= 4 && load<std::uint64_t>(bytes, kEvlrStart) != 0)
    store(bytes, kEvlrStart, load<std::uint64_t>(bytes, kEvlrStart) + new_points - points);
  std::ofstream out(argv[2], std::ios::binary);
  out << bytes.substr(0, header_size) << vlrs << bytes.substr(points);
  return out ? EXIT_SUCCESS : EXIT_FAILURE;
}
