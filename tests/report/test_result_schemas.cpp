// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// The schemas in share/schema and the page share/doc/results.md are those of the tables of fields.
// With PCL_ALS_UPDATE=1 in the environment, the program writes them.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/field_table.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/report/accuracy_report.h>
#include <pcl_als/report/alignment_report.h>
#include <pcl_als/report/history_report.h>
#include <pcl_als/report/intensity_report.h>
#include <pcl_als/report/inventory_report.h>
#include <pcl_als/report/mounting_report.h>
#include <pcl_als/report/plan_report.h>
#include <pcl_als/report/quality_report.h>
#include <pcl_als/report/waveform_report.h>

#include "file_bytes.h"
#ifdef PCL_ALS_HAVE_CERES
#include <pcl_als/report/orientation_report.h>
#endif

namespace pcl_als {
namespace {

const std::vector<FieldTable>& results() {
  static const std::vector<FieldTable> all = {
      calibrationFields(), qualityFields(),  accuracyFields(),       intensityFields(),
      icpatchFields(),     planFields(),     mountingReportFields(), historyFields(),
      inventoryFields(),   waveformFields(),
#ifdef PCL_ALS_HAVE_CERES
      orientationFields()
#endif
  };
  return all;
}

/// Compares a file of share/ with what it should be, or writes it.
void expectFile(const std::filesystem::path& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(PCL_ALS_SHARE) / name;
  if (std::getenv("PCL_ALS_UPDATE") != nullptr) {
    std::filesystem::create_directories(path.parent_path());
    writeFile(path, text);
  }
  ASSERT_TRUE(std::filesystem::exists(path)) << path;
  EXPECT_TRUE(test::readBytes(path) == text) << path
                                             << " is not that of the tables of fields: run "
                                                "PCL_ALS_UPDATE=1 report_tests test_result_schemas";
}

TEST(ResultSchemas, AreThoseOfTheFields) {
  for (const FieldTable& table : results())
    expectFile("schema/" + table.name() + ".schema.json",
               jsonText(schemaOf(table, table.name() + ".json")));
}

TEST(ResultSchemas, ReferenceIsThatOfTheFields) {
#ifndef PCL_ALS_HAVE_CERES
  GTEST_SKIP() << "the page has the orientation of images, which needs Ceres Solver";
#endif
  std::string page =
      "# Reference of the result files\n\n"
      "The keys of the JSON files that the tools write. Each file has a JSON Schema (draft\n"
      "2020-12) in `share/schema`. A key with \"optional\" is omitted where it does not apply;\n"
      "other values that are not known are null. Programs should ignore keys that they do not\n"
      "know: later versions may add some. A test compares this page and the schemas with the\n"
      "tables in the sources that the files are written from.\n\n";
  for (const FieldTable& table : results()) page += referenceOf(table, table.name());
  page.pop_back();
  expectFile("doc/results.md", page);
}

}  // namespace
}  // namespace pcl_als
