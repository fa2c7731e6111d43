// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/header_box.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/io/measured_box.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/point_box.h>

#include "test_files.h"
#include "wrong_boxes.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::LasBytes;

LasBytes manyPoints() {
  LasBytes las;
  las.count = 100000;  // several blocks of 1 MiB
  return las;
}

/// The box of the points of LasBytes, which run to the east and south.
Eigen::AlignedBox3d boxOf(const LasBytes& las) {
  const auto at = [&](unsigned i) {
    return Eigen::Vector3d(LasBytes::X(i) * las.scale + las.offset_x,
                           LasBytes::Y(i) * las.scale + las.offset_y,
                           LasBytes::Z(i) * las.scale + las.offset_z);
  };
  Eigen::AlignedBox3d box(at(0));
  box.extend(at(las.count - 1));
  return box;
}

TEST(HeaderBox, IsRightUpToAStep) {
  PointFileInfo info;
  info.minimum = {1.0, 2.0, 3.0}, info.maximum = {4.0, 5.0, 6.0};
  const Eigen::AlignedBox3d points(info.minimum, info.maximum);
  EXPECT_EQ(headerBoxRemark(info, points), "");
  info.minimum.x() += 0.001;  // the resolution
  EXPECT_TRUE(headerBoxIsRight(info, points));
  info.minimum.x() += 0.001;
  EXPECT_FALSE(headerBoxIsRight(info, points));
  EXPECT_FALSE(headerBoxContains(info, points));
  info.minimum.x() = -100.0;
  EXPECT_TRUE(headerBoxContains(info, points));
  EXPECT_EQ(headerBoxRemark(info, points),
            "the header's bounding box is wrong: it says (-100.000 2.000 3.000) to (4.000 5.000 "
            "6.000), the points reach from (1.000 2.000 3.000) to (4.000 5.000 6.000)");
  EXPECT_TRUE(headerBoxIsRight(info, {}));
}

TEST(MeasuredBox, IsThatOfThePointsWhateverTheHeaderSays) {
  const LasBytes las = manyPoints();
  const Eigen::AlignedBox3d box = boxOf(las);
  const auto folder = test::scratch("measured_box");
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    const MeasuredFile measured = measureBox(folder / "in.las", 3);
    EXPECT_EQ(measured.info.minimum, box.min()) << wrong.name;
    EXPECT_EQ(measured.info.maximum, box.max()) << wrong.name;
    EXPECT_EQ(measured.box_remark.find((folder / "in.las").string() + ": the header's"), 0U);
  }
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_EQ(measureBox(folder / "in.las").box_remark, "");
}

TEST(MeasuredBox, OfCompressedPointsIsTheSame) {
  const LasBytes las = manyPoints();
  const auto folder = test::scratch("measured_laz");
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "in.laz", [](const LasRecordBlock&) {});
  for (const int threads : {1, 4}) {
    const Eigen::AlignedBox3d box = pointBox(LasFile(folder / "in.laz", kLazZ), threads);
    EXPECT_EQ(box.min(), boxOf(las).min());
    EXPECT_EQ(box.max(), boxOf(las).max());
  }
}

TEST(MeasuredBox, IsThatOfTheSources) {
  const LasBytes las = manyPoints();
  const auto folder = test::scratch("measured_sources");
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    const PointFileSources sources = surveySources(folder / "in.las");
    EXPECT_EQ(sources.info.minimum, boxOf(las).min()) << wrong.name;
    EXPECT_EQ(sources.info.maximum, boxOf(las).max()) << wrong.name;
    EXPECT_NE(sources.box_remark.find("bounding box is wrong"), std::string::npos) << wrong.name;
  }
}

// The number of points in a window does not depend on what the header says of the others.
TEST(MeasuredBox, WindowsLoseNoPoints) {
  const LasBytes las = manyPoints();
  const Eigen::AlignedBox3d box = boxOf(las);
  const auto folder = test::scratch("measured_window");
  PointWindow window;
  window.bounds.emplace(box.center().head<2>().eval(), box.max().head<2>().eval());
  window.bounds->min().y() = box.min().y();
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    const auto reader = PointReader::open(folder / "in.las", window);
    std::size_t points = 0;
    PointChunk chunk;
    while (reader->read(chunk)) points += chunk.size();
    EXPECT_EQ(points, las.count / 2) << wrong.name;
  }
}

TEST(MeasuredBox, GivesTheCellsOfTheCensus) {
  LasBytes las = manyPoints();
  las.scale = 0.01;  // 7 km times 11 km
  const auto folder = test::scratch("measured_census");
  test::writeBytes(folder / "in.las", las.str());
  const DatasetInventory right = takeInventory({folder / "in.las"});
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    const DatasetInventory inventory = takeInventory({folder / "in.las"});
    EXPECT_EQ(inventory.cell, right.cell) << wrong.name;
    EXPECT_EQ(inventory.strips[0].area, right.strips[0].area) << wrong.name;
    const auto& remarks = inventory.files[0].remarks;
    EXPECT_EQ(std::count_if(remarks.begin(), remarks.end(),
                            [](const Warning& remark) {
                              return remark.text.find("bounding box is wrong") != std::string::npos;
                            }),
              1)
        << wrong.name;
  }
}

// A header of zeros made map coordinates look like degrees, and was in no CRS of a zone.
TEST(MeasuredBox, CoordinatesAreDegreesByThePoints) {
  LasBytes las;
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735,
                            test::Bytes()
                                .u16(1)
                                .u16(1)
                                .u16(0)
                                .u16(2)
                                .u16(1024)
                                .u16(0)
                                .u16(1)
                                .u16(2)
                                .u16(2048)
                                .u16(0)
                                .u16(1)
                                .u16(4326)
                                .str())};
  const auto folder = test::scratch("measured_degrees");
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_EQ(LasFile(folder / "in.las").crsKind(), CrsKind::unknown);
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    EXPECT_EQ(LasFile(folder / "in.las").crsKind(), CrsKind::unknown) << wrong.name;
  }
  LasBytes degrees = las;
  degrees.scale = 1e-7, degrees.offset_x = 11.0, degrees.offset_y = 48.0;
  for (const test::WrongBox& wrong : test::wrongBoxes(degrees)) {
    test::writeBytes(folder / "in.las", wrong.bytes);
    EXPECT_EQ(LasFile(folder / "in.las").crsKind(), CrsKind::geographic) << wrong.name;
  }
}

}  // namespace
}  // namespace pcl_als
