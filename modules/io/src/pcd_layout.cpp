// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pcd_layout.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "pcd_header.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kLongestCount = 20;  ///< digits of 2^64

/// A comment must stay one line.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// " VALUE" once for every column.
std::string repeated(const char* value, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text.append(" ").append(value);
  return text;
}

/// A count, followed by blanks where another one may have to take its place.
std::string grouped(std::uint64_t count, bool later) {
  std::string text = std::to_string(count);
  if (later) text.resize(kLongestCount, ' ');
  return text;
}

template <typename T>
void put(char*& at, const T& value) {
  std::memcpy(at, &value, sizeof value);
  at += sizeof value;
}

}  // namespace

std::string pcdHeaderText(const PcdDescription& d) {
  const Eigen::Vector3d& origin = d.frame.origin;
  const std::size_t more = d.columns.size();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "# .PCD v0.7 - Point Cloud Data file format\n" << kPcdFrameComment << '\n';
  if (!d.strip_id.empty()) text << kPcdStripComment << oneLine(d.strip_id) << '\n';
  if (!d.frame.crs.empty()) text << kPcdCrsComment << oneLine(d.frame.crs) << '\n';
  if (!d.corrections.empty()) text << kPcdCorrectionsComment << oneLine(d.corrections) << '\n';
  text << "VERSION 0.7\n"
          "FIELDS x y z gps_time intensity scan_angle point_source_id return_number "
          "number_of_returns classification flags user_data";
  for (const std::string& column : d.columns) text << ' ' << column;
  text << "\nSIZE 4 4 4 8 4 4 2 1 1 1 1 1" << repeated("4", more)
       << "\nTYPE F F F F F F U U U U U U" << repeated("F", more)
       << "\nCOUNT 1 1 1 1 1 1 1 1 1 1 1 1" << repeated("1", more) << "\nWIDTH "
       << grouped(d.width, d.counts_later) << "\nHEIGHT " << d.height << "\nVIEWPOINT "
       << origin.x() << ' ' << origin.y() << ' ' << origin.z() << " 1 0 0 0\nPOINTS "
       << grouped(d.width * d.height, d.counts_later) << "\nDATA binary\n";
  return text.str();
}

void putPcdPoint(const PointLidar& p, char* at) {
  put(at, p.x), put(at, p.y), put(at, p.z);
  put(at, p.gps_time);
  put(at, p.intensity), put(at, p.scan_angle);
  put(at, p.point_source_id);
  put(at, p.return_number), put(at, p.number_of_returns);
  put(at, p.classification), put(at, p.flags), put(at, p.user_data);
}

}  // namespace pcl_als::detail
