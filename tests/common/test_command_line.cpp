// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

CommandLine example() {
  CommandLine line("pcl_als_example", "shows options.", "FILE… -output OUT",
                   "pcl_als_example a.las");
  line.add<double>("threshold", "a length, m", 0.5);
  line.add<std::string>("model", "a name", "simple");
  line.addOptional("control", "a file");
  line.addFlag("invert", "a flag");
  return line;
}

bool parse(CommandLine& line, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "pcl_als_example");
  return line.parse(static_cast<int>(arguments.size()), arguments.data());
}

std::string refusal(std::vector<const char*> arguments) {
  CommandLine line = example();
  try {
    parse(line, std::move(arguments));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CommandLine, OneDashAndTwoAreTheSame) {
  for (const char* option : {"-threshold", "--threshold"}) {
    CommandLine line = example();
    ASSERT_TRUE(parse(line, {"a.las", option, "0.25", "b.las"}));
    EXPECT_EQ(line.get<double>("threshold"), 0.25);
    EXPECT_EQ(line.inputs(2, 2), (std::vector<std::string>{"a.las", "b.las"}));
  }
}

TEST(CommandLine, DefaultsHoldUntilGiven) {
  CommandLine line = example();
  ASSERT_TRUE(parse(line, {}));
  EXPECT_EQ(line.get<double>("threshold"), 0.5);
  EXPECT_EQ(line.text("model"), "simple");
  EXPECT_FALSE(line.has("control"));
  EXPECT_FALSE(line.has("invert"));
  EXPECT_FALSE(line.quiet());
  EXPECT_EQ(line.threads(), 0);
}

TEST(CommandLine, ValuesMayBeNegativeOrFollowAnEqualsSign) {
  CommandLine line = example();
  ASSERT_TRUE(parse(line, {"-threshold", "-3", "--model=full", "-invert"}));
  EXPECT_EQ(line.get<double>("threshold"), -3.0);
  EXPECT_EQ(line.text("model"), "full");
  EXPECT_TRUE(line.has("invert"));
}

TEST(CommandLine, RefusalsNameTheOption) {
  EXPECT_NE(refusal({"-treshold", "1"}).find("treshold"), std::string::npos);
  EXPECT_NE(refusal({"-threshold"}).find("threshold"), std::string::npos);
  EXPECT_NE(refusal({"-threshold", "wide"}).find("threshold"), std::string::npos);
  EXPECT_NE(refusal({"-thresh", "1"}).find("thresh"), std::string::npos);  // no abbreviations
  EXPECT_NE(refusal({"-threads", "-1"}).find("threads"), std::string::npos);
  EXPECT_EQ(refusal({"-threads", "2"}), "accepted");
}

TEST(CommandLine, NumbersAreCheckedAgainstTheirRange) {
  for (const char* value : {"-1", "11", "nan", "inf"}) {
    CommandLine line = example();
    ASSERT_TRUE(parse(line, {"-threshold", value}));
    try {
      line.number("threshold", 0.0, 10.0, "m");
      FAIL() << "accepted " << value;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("-threshold"), std::string::npos);
    }
  }
}

TEST(CommandLine, NumberOfInputsIsChecked) {
  CommandLine line = example();
  ASSERT_TRUE(parse(line, {"a.las"}));
  EXPECT_THROW(line.inputs(2, 3), UsageError);
  EXPECT_THROW(line.inputs(0, 0), UsageError);
}

TEST(CommandLine, HelpHasEveryOptionWithItsDefault) {
  for (const char* option : {"-h", "-help", "--help"}) {
    CommandLine line = example();
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse(line, {option}));
    const std::string help = testing::internal::GetCapturedStdout();
    for (const char* part : {"shows options.", "threshold", "0.5", "simple", "control", "invert",
                             "threads", "Example", "Exit status"})
      EXPECT_NE(help.find(part), std::string::npos) << part;
  }
}

TEST(Run, TurnsExceptionsIntoOneLineAndAStatus) {
  const auto status = [](const auto& error) {
    testing::internal::CaptureStderr();
    const int result = run("pcl_als_example", [&]() -> int { throw error; });
    return std::make_pair(result, testing::internal::GetCapturedStderr());
  };
  EXPECT_EQ(status(UsageError("option -x")),
            std::make_pair(1, std::string("pcl_als_example: option -x\n")));
  EXPECT_EQ(status(InputError("a.las: empty")),
            std::make_pair(2, std::string("pcl_als_example: a.las: empty\n")));
  EXPECT_EQ(status(std::bad_alloc()).first, 2);
  EXPECT_EQ(status(std::runtime_error("other")).first, 2);
  EXPECT_EQ(run("pcl_als_example", [] { return 3; }), 3);
}

TEST(SplitList, TrimsAndDropsEmptyParts) {
  EXPECT_EQ(splitList(" a, b\t,,c "), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(splitList("").empty());
}

TEST(Grouped, ThousandsApart) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1843200), "1 843 200");
}

}  // namespace
}  // namespace pcl_als::app
