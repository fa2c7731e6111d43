// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// PROGRAM [SOURCE] [options of GoogleTest]: runs the tests of a program, or those of one of its
// sources:
//   io_tests test_control
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

std::string nameOf(const testing::TestInfo& test) {
  return std::string(test.test_suite_name()) + '.' + test.name();
}

/// Calls a function with every test of the program.
template <typename Function>
void forEachTest(Function function) {
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *program.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) function(*suite.GetTestInfo(k));
  }
}

/// What keeps the tests of a program from being selected by their sources; empty if nothing does: a
/// test of another file than test_X.cpp, which no test of ctest would run, or two of one name,
/// which those of both sources would run.
std::string selectionProblem() {
  std::string problem;
  std::set<std::string> names;
  forEachTest([&](const testing::TestInfo& test) {
    const std::filesystem::path file = std::filesystem::path(test.file()).filename();
    const std::string name = nameOf(test);
    if (file.extension() != ".cpp" || file.string().rfind("test_", 0) != 0)
      problem = name + " is in " + file.string() + "; tests belong into sources test_X.cpp";
    if (!names.insert(name).second) problem = "two tests have the name " + name;
  });
  return problem;
}

/// The filter that selects the tests of a source, which is given without folder and extension.
std::string filterOf(const std::string& source) {
  std::string filter;
  forEachTest([&](const testing::TestInfo& test) {
    if (std::filesystem::path(test.file()).stem() != source) return;
    if (!filter.empty()) filter += ':';
    filter += nameOf(test);
  });
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string problem = selectionProblem();
  if (!problem.empty()) {
    std::fprintf(stderr, "%s: %s\n", argv[0], problem.c_str());
    return 1;
  }
  if (argc > 2) {
    std::fprintf(stderr, "usage: %s [SOURCE] [options of GoogleTest]\n", argv[0]);
    return 1;
  }
  if (argc == 2) {
    const std::string filter = filterOf(argv[1]);
    if (filter.empty()) {
      std::fprintf(stderr, "%s: no test is in a source %s\n", argv[0], argv[1]);
      return 1;
    }
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
