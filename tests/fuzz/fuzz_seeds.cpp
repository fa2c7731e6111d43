// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_seeds.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_extra.h>

#include "copc_bytes.h"
#include "las_bytes.h"
#include "pulse_waves_bytes.h"

namespace pcl_als::fuzz {
namespace {

using test::Bytes;
using test::LasBytes;

std::string extraFieldsVlr() {
  LasExtraField field;
  field.name = "reflectance";
  field.scale = 0.5;
  field.type = LasExtraType::i16;
  const std::vector<std::byte> payload = serialiseLasExtraFields({field});
  const char* bytes = reinterpret_cast<const char*>(payload.data());
  return LasBytes::vlr("LASF_Spec", 4, std::string(bytes, payload.size()));
}

std::string geoKeysVlr() {
  Bytes keys;
  keys.u16(1).u16(1).u16(0).u16(3).u16(1024).u16(0).u16(1).u16(1);
  keys.u16(2057).u16(34736).u16(1).u16(0).u16(3072).u16(0).u16(1).u16(28992);
  return LasBytes::vlr("LASF_Projection", 34735, keys.str());
}

/// A file of LAS 1.2 or 1.4 with records of the CRS as deliveries in other units have them.
std::string withCrs(bool wkt, const std::string& record, const std::string& doubles = "") {
  LasBytes las;
  las.minor = wkt ? 4 : 2;
  las.format = wkt ? 6 : 1;
  las.encoding = wkt ? 17 : 0;
  las.vlrs = {LasBytes::vlr("LASF_Projection", wkt ? 2112 : 34735, record)};
  if (!doubles.empty()) las.vlrs.push_back(LasBytes::vlr("LASF_Projection", 34736, doubles));
  return las.str();
}

std::vector<std::string> crsSeeds() {
  Bytes feet, own, degrees;
  feet.u16(1).u16(1).u16(0).u16(4).u16(1024).u16(0).u16(1).u16(1);
  feet.u16(3072).u16(0).u16(1).u16(32128).u16(3076).u16(0).u16(1).u16(9003);
  feet.u16(4099).u16(0).u16(1).u16(9002);
  own.u16(1).u16(1).u16(0).u16(3).u16(3076).u16(0).u16(1).u16(32767);
  own.u16(3077).u16(34736).u16(1).u16(0).u16(4096).u16(0).u16(1).u16(6360);
  degrees.u16(1).u16(1).u16(0).u16(2).u16(1024).u16(0).u16(1).u16(2);
  degrees.u16(2048).u16(0).u16(1).u16(4326);
  const std::string compound =
      "COMPD_CS[\"a\",LOCAL_CS[\"b\",UNIT[\"Foot_US\",0.3048006096012192]],VERT_CS[\"c\","
      "VERT_DATUM[\"d\",2005],UNIT[\"foot\",0.3048],AXIS[\"Up\",UP]]]";
  return {withCrs(false, feet.str()), withCrs(false, own.str(), Bytes().f64(0.3048006).str()),
          withCrs(false, degrees.str()), withCrs(true, compound), withCrs(true, "EPSG:2227+6360")};
}

std::string binaryPcd(const std::string& kind, const std::string& data) {
  return "# .PCD v0.7\n# pcl_als strip 7\nVERSION 0.7\nFIELDS x y z gps_time point_source_id\n"
         "SIZE 4 4 4 8 2\nTYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
         "VIEWPOINT 583390 5283100 500 1 0 0 0\nPOINTS 2\nDATA " +
         kind + "\n" + data;
}

}  // namespace

std::vector<std::string> lasSeeds() {
  std::vector<std::string> seeds;
  for (int minor = 2; minor <= 4; ++minor)
    for (const int format : {0, 1, 3, 5, 6, 10}) {
      LasBytes las;
      las.minor = minor;
      las.format = format;
      las.extra = 2;
      las.vlrs = {extraFieldsVlr(), geoKeysVlr(),
                  LasBytes::vlr("LASF_Projection", 2112, "LOCAL_CS[\"m\"]")};
      if (minor == 4) las.evlrs = {LasBytes::evlr("someone", 9, "payload")};
      seeds.push_back(las.str());
    }
  // 2026-11-21, found by fuzz_las: no points gave the decoder a null pointer to add to.
  LasBytes none;
  none.count = 0;
  none.extra = 2;
  none.vlrs = {extraFieldsVlr()};
  seeds.push_back(none.str());
  for (std::string& seed : crsSeeds()) seeds.push_back(std::move(seed));
  return seeds;
}

/// The files of all formats, coders and kinds of chunks that the tests of module las have.
std::vector<std::string> lazSeeds() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(PCL_ALS_LAZ_FILES))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> seeds;
  for (const auto& path : paths) seeds.push_back(test::readBytes(path));
  return seeds;
}

std::vector<std::string> lazChunkSeeds() {
  std::vector<std::string> seeds = lazSeeds();
  const std::size_t files = seeds.size();
  for (std::size_t i = 0; i < files; ++i)
    for (const std::uint32_t size : {1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFEU, 0xFFFFFFFFU}) {
      constexpr std::size_t header = 94, chunk_size = 54 + 12;
      std::string file = seeds[i];
      std::uint16_t vlr = 0;
      std::memcpy(&vlr, &file[header], sizeof vlr);  // that of the compression stands first
      std::memcpy(&file[vlr + chunk_size], &size, sizeof size);
      seeds.push_back(std::move(file));
    }
  return seeds;
}

std::vector<std::string> copcSeeds() {
  test::CopcBytes::Frame shallow;
  shallow.deepest = 1;
  return {test::CopcBytes(test::copcPoints(50), shallow).str(),
          test::CopcBytes(test::copcPoints(2000), {}).str()};
}

std::vector<std::string> pcdSeeds() {
  Bytes records;
  for (int i = 0; i < 2; ++i)
    records.f32(1.0F).f32(2.0F).f32(static_cast<float>(i)).f64(230038.25).u16(7);
  // The same 44 bytes as LZF: two runs of literals, their fields side by side.
  Bytes columns;
  columns.f32(1.0F).f32(1.0F).f32(2.0F).f32(2.0F).f32(0.0F).f32(1.0F);
  columns.f64(230038.25).f64(230038.25).u16(7).u16(7);
  const std::string& c = columns.str();
  const std::string packed = Bytes().u8(31).raw(c.substr(0, 32)).u8(11).raw(c.substr(32)).str();
  const std::string sizes = Bytes().u32(packed.size()).u32(c.size()).str();
  return {binaryPcd("ascii", "1 2 3 230038.25 7\n4.5 nan 6e0 230039 8\n"),
          // 2026-11-21, found by fuzz_pcd: no points gave the decoder a null pointer to add to.
          "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA binary\n",
          binaryPcd("binary", records.str()), binaryPcd("binary_compressed", sizes + packed)};
}

std::vector<std::string> plySeeds() {
  const std::string properties =
      "comment pcl_als strip 7\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nproperty double gps_time\nproperty float intensity\n"
      "property ushort point_source_id\nproperty uchar red\n";
  Bytes records;
  for (int i = 0; i < 2; ++i)
    records.f64(583390.0).f64(5283100.0).f64(i).f64(230038.25).f32(7.0F).u16(7).u8(9);
  const std::string camera = "element camera 2\nproperty short a\nproperty uint8 b\n";
  return {"ply\nformat binary_little_endian 1.0\n" + properties + "end_header\n" + records.str(),
          "ply\nformat ascii 1.0\n" + properties +
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "1 2 3 230038.25 7 1 2\n4.5 nan 6e0 230039 8 1 2\n3 0 1 0\n",
          "ply\nformat binary_little_endian 1.0\n" + camera + properties + "end_header\nabcdef" +
              records.str()};
}

std::vector<std::string> xyzSeeds() {
  return {"x y z gps_time intensity point_source_id\n1 2 3 230038.25 7 1\n4.5 nan 6e0 230039 8 1\n",
          "# pcl_als strip 7\n//X,Y,Z,Class\n583390.125,5283100.5,3,2\n", "1 2 3\n\n4 5 6",
          "x;y;z;user_data;skip\r\n1;2;3;255;word\r\n"};
}

std::vector<std::string> pulseWavesSeeds() {
  std::vector<std::string> seeds;
  for (const unsigned attributes : {0U, 1U, 2U}) {
    test::SimulatedPulses pulses;
    pulses.echoes.resize(3);
    test::PulseWavesBytes& file = pulses.bytes;
    file.attributes = attributes;
    file.extra_bytes = 4 * attributes;
    file.appended_count = static_cast<int>(attributes) - 1;
    file.vlrs = {test::PulseWavesBytes::vlr(2112, "LOCAL_CS[\"x\"]", "PulseWaves_Proj")};
    if (attributes != 1)
      file.appended = {test::PulseWavesBytes::avlr(
          300001, test::PulseWavesBytes::tableBytes({0.0F, 1.0F, 2.5F}))};
    pulses.make();
    const std::string pls = file.pls();
    seeds.push_back(Bytes().u32(pls.size()).str() + pls + file.wvs());
  }
  return seeds;
}

std::vector<std::string> trajectorySeeds() {
  return {
      "time,x,y,z,roll,pitch,heading\n1.0,583394.5,5283100,1150,0.1,-0.2,359\n"
      "1.005,583394.8,5283100,1150.01,,,\n",
      "\xEF\xBB\xBFz; Time; x; y\r\n# comment\r\n5;1;2;3\r\n", "x y z time\n1 2 3 4\n2 3 4 5\n"};
}

std::vector<std::string> sbetSeeds() {
  Bytes records;
  for (int i = 0; i < 3; ++i) {
    records.f64(400825.0 + 0.005 * i).f64(0.6592).f64(-2.0773).f64(3000.0);
    records.f64(0).f64(0).f64(0).f64(0.01).f64(-0.02).f64(1.0).f64(0.25);
    for (int k = 0; k < 6; ++k) records.f64(0);
  }
  return {records.str()};
}

std::vector<std::string> controlSeeds() {
  return {"id,x,y,z,sigma\nP1,583394.5,5283100,498.25,0.01\n\"P 2\",583395,5283101,498,\n",
          "x\ty\tz\tid\n1\t2\t3\tA\n"};
}

std::vector<std::string> calibrationSeeds() {
  CalibrationResult result;
  result[SystemParameter::boresight_roll] = {4e-4, 2e-6, 1e-6, ParameterStatus::estimated, ""};
  result.correlation_order = {SystemParameter::boresight_roll};
  result.correlation = Eigen::MatrixXd::Identity(1, 1);
  result.iterations = {{1000, 2.5, 0.75}};
  result.pairs = {{"1", "2", 500, 0.5, 0.02, -0.1, 1e-4}};
  result.control = {{"1", 37, 0.1, 0.2, 0.3, 0.4}};
  const auto path = std::filesystem::temp_directory_path() /
                    ("pcl_als_fuzz_seed." + std::to_string(getpid()) + ".json");
  writeCalibration(path, result);
  const std::string text = test::readBytes(path);
  std::filesystem::remove(path);
  return {text};
}

}  // namespace pcl_als::fuzz
