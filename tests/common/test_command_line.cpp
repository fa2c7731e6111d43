// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

CommandLine exampleLine() {
  CommandLine line("pcl_als_example", "shows options.", "FILE… -output OUT",
                   "pcl_als_example a.las");
  line.setArguments({{"", 0, Arguments::kAnyNumber}});
  line.addNumber("threshold", "a length", 0.5, {-10.0, 10.0, "m"});
  line.addChoice("model", "a name", {"simple", "full"}, "simple");
  line.addInputFile("control", "a file");
  line.addInputFiles("flight", "files");
  line.addOutputFile("output", "a result", {".json"});
  line.addOutputFolder("report", "a report", always({"report.html", "part*.csv"}));
  line.addFlag("invert", "a flag");
  return line;
}

bool parse(CommandLine& line, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "pcl_als_example");
  return line.parse(static_cast<int>(arguments.size()), arguments.data());
}

std::string refusalOfArguments(std::vector<const char*> arguments) {
  CommandLine line = exampleLine();
  try {
    parse(line, std::move(arguments));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CommandLine, OneDashAndTwoAreTheSame) {
  for (const char* option : {"-threshold", "--threshold"}) {
    CommandLine line = exampleLine();
    ASSERT_TRUE(parse(line, {"a.las", option, "0.25", "b.las"}));
    EXPECT_EQ(line.number("threshold"), 0.25);
    EXPECT_EQ(line.inputs(), (std::vector<std::string>{"a.las", "b.las"}));
  }
}

TEST(CommandLine, DefaultsHoldUntilGiven) {
  CommandLine line = exampleLine();
  ASSERT_TRUE(parse(line, {}));
  EXPECT_EQ(line.number("threshold"), 0.5);
  EXPECT_EQ(line.text("model"), "simple");
  EXPECT_FALSE(line.has("control"));
  EXPECT_FALSE(line.has("invert"));
  EXPECT_FALSE(line.quiet());
  EXPECT_EQ(line.threads(), 0);
}

TEST(CommandLine, ValuesMayBeNegativeOrFollowAnEqualsSign) {
  CommandLine line = exampleLine();
  ASSERT_TRUE(parse(line, {"-threshold", "-3", "--model=full", "-invert"}));
  EXPECT_EQ(line.number("threshold"), -3.0);
  EXPECT_EQ(line.text("model"), "full");
  EXPECT_TRUE(line.has("invert"));
}

TEST(CommandLine, RefusalsNameTheOption) {
  EXPECT_NE(refusalOfArguments({"-treshold", "1"}).find("treshold"), std::string::npos);
  EXPECT_NE(refusalOfArguments({"-threshold"}).find("threshold"), std::string::npos);
  EXPECT_NE(refusalOfArguments({"-threshold", "wide"}).find("threshold"), std::string::npos);
  EXPECT_NE(refusalOfArguments({"-thresh", "1"}).find("thresh"),
            std::string::npos);  // no abbreviations
  EXPECT_NE(refusalOfArguments({"-threads", "-1"}).find("threads"), std::string::npos);
  EXPECT_NE(refusalOfArguments({"-model", "half"}).find("'half' is none of simple, full"),
            std::string::npos);
  EXPECT_NE(refusalOfArguments({"-invert=1"}).find("invert"), std::string::npos);
  EXPECT_NE(refusalOfArguments({"-model", "full", "-model", "full"}).find("twice"),
            std::string::npos);
  EXPECT_NE(refusalOfArguments({"-control", "-invert"}).find("control"), std::string::npos);
  EXPECT_EQ(refusalOfArguments({"-threads", "2"}), "accepted");
}

TEST(CommandLine, NumbersAreCheckedAgainstTheirRange) {
  for (const char* value : {"-11", "11", "nan", "inf", "1e3", ""})
    EXPECT_NE(refusalOfArguments({"-threshold", value}).find("-threshold"), std::string::npos)
        << value;
  EXPECT_NE(refusalOfArguments({"-threshold", "11"}).find("is not a number from -10 to 10 m"),
            std::string::npos);
}

TEST(CommandLine, NumberOfInputsIsChecked) {
  const auto parsed = [](std::vector<Arguments> forms, std::vector<const char*> arguments) {
    CommandLine line = exampleLine();
    line.setArguments(std::move(forms));
    return parse(line, std::move(arguments));
  };
  EXPECT_THROW(parsed({{"", 2, 3}}, {"a.las"}), UsageError);
  EXPECT_THROW(parsed({{"", 0, 0}}, {"a.las"}), UsageError);
  EXPECT_THROW(parsed({{"", 1, 1, {".las"}}}, {"a.las"}), UsageError);
  EXPECT_TRUE(parsed({{"", 1, 1, {".las"}}}, {"a.las", "b.las"}));
  EXPECT_TRUE(parsed({{"report", 1, 3}, {"", 1, 1, {".las"}}}, {"a.las", "-report", "r"}));
}

TEST(CommandLine, AListEndsAtOptionsAndPointFiles) {
  CommandLine line = exampleLine();
  ASSERT_TRUE(parse(line, {"-flight", "a.las", "b.csv", "c.las", "-flight=d.csv", "-invert"}));
  EXPECT_EQ(line.list("flight"), (std::vector<std::string>{"a.las", "b.csv", "d.csv"}));
  EXPECT_EQ(line.text("flight"), "a.las,b.csv,d.csv");
  EXPECT_EQ(line.inputs(), std::vector<std::string>{"c.las"});
}

TEST(CommandLine, ReadingAnAbsentOptionIsWrongUsage) {
  CommandLine line = exampleLine();
  ASSERT_TRUE(parse(line, {}));
  try {
    line.text("control");
    FAIL() << "has a value";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("option -control is needed"), std::string::npos);
  }
  EXPECT_TRUE(line.list("flight").empty());
}

TEST(CommandLine, RelationsOfOptionsAreChecked) {
  const auto parsed = [](std::vector<const char*> arguments) {
    CommandLine line = exampleLine();
    line.exclude({"control", "flight"}, true);
    line.makeDependent("invert", "control");
    return parse(line, std::move(arguments));
  };
  EXPECT_TRUE(parsed({"-control", "x", "-invert"}));
  EXPECT_THROW(parsed({}), UsageError);
  EXPECT_THROW(parsed({"-control", "x", "-flight", "y"}), UsageError);
  EXPECT_THROW(parsed({"-flight", "y", "-invert"}), UsageError);
}

/// A folder with the files of names, which say their name.
std::filesystem::path folderWith(const std::vector<std::string>& names) {
  const std::filesystem::path folder = std::filesystem::path(PCL_ALS_TEST_SCRATCH) / "command_line";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  for (const std::string& name : names) std::ofstream(folder / name) << name;
  return folder;
}

TEST(CommandLine, AnOutputIsNoInputAndNoOtherOutput) {
  const std::filesystem::path folder = folderWith({"control.json", "part.csv", "report.html"});
  std::filesystem::create_symlink("control.json", folder / "link.json");
  std::filesystem::create_hard_link(folder / "control.json", folder / "twin.json");
  const std::string control = folder / "control.json", part = folder / "part.csv";
  for (const char* name : {"control.json", "./control.json", "link.json", "twin.json",
                           "../command_line/control.json"}) {
    const std::string output = (folder / name).string();
    EXPECT_NE(refusalOfArguments({"-control", control.c_str(), "-output", output.c_str()})
                  .find("is also an input (-control)"),
              std::string::npos)
        << name;
    EXPECT_NE(
        refusalOfArguments({control.c_str(), "-output", output.c_str()}).find("is also an input"),
        std::string::npos);
  }
  const std::string inside = folder / "part.csv";
  const std::string here = folder.string(), html = folder / "x.json";
  EXPECT_NE(refusalOfArguments({"-control", inside.c_str(), "-report", here.c_str()})
                .find("is also an input"),
            std::string::npos);
  EXPECT_EQ(refusalOfArguments({"-output", html.c_str()}), "accepted");
  EXPECT_NE(
      refusalOfArguments({"-output", (folder / "x.txt").c_str()}).find("does not end in .json"),
      std::string::npos);
  EXPECT_NE(refusalOfArguments({"-output", here.c_str()}).find(".json"), std::string::npos);
}

TEST(CommandLine, AReportReplacesNoFileOfTheUser) {
  const std::filesystem::path folder = folderWith({"part7.csv", "other.csv"});
  const std::string here = folder.string();
  EXPECT_NE(refusalOfArguments({"-report", here.c_str()}).find("part7.csv: would be replaced"),
            std::string::npos);
  std::filesystem::remove(folder / "part7.csv");
  EXPECT_EQ(refusalOfArguments({"-report", here.c_str()}), "accepted");
}

TEST(CommandLine, WhatTheCommandReadsStaysProtected) {
  const std::filesystem::path folder = folderWith({"control.csv"});
  const std::string control = folder / "control.csv";
  {
    CommandLine line = exampleLine();
    ASSERT_TRUE(parse(line, {"-control", control.c_str()}));
    EXPECT_THROW(writeFile(control, "new"), UsageError);
  }
  writeFile(control, "new");
}

TEST(CommandLine, HelpHasEveryOptionWithItsDefault) {
  for (const char* option : {"-h", "-help", "--help"}) {
    CommandLine line = exampleLine();
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse(line, {option}));
    const std::string help = testing::internal::GetCapturedStdout();
    for (const char* part : {"shows options.", "threshold", "0.5", "simple", "control", "invert",
                             "threads", "-10 to 10", "simple|full", "Example", "Exit status"})
      EXPECT_NE(help.find(part), std::string::npos) << part;
  }
}

TEST(CommandLine, HelpListsNeededOptionsFirstInEachGroup) {
  CommandLine line = exampleLine();
  {
    const OptionGroup group(line, Group::priors);
    line.addNumber("sigma", "a standard deviation", {}, {0.0, 1.0, "m"});
  }
  line.addFlag("later", "a flag");
  line.addText("title", "a text").in(Group::output);
  line.addOutputFile("result", "a file", {".txt"}).needed();
  testing::internal::CaptureStdout();
  EXPECT_FALSE(parse(line, {"-h"}));
  const std::string help = testing::internal::GetCapturedStdout();
  std::size_t before = 0;
  for (const char* part :
       {"\nInputs:\n", "--control", "--flight", "\nPriors and assumed errors:\n", "--sigma",
        "\nOutput:\n", "--result", "--output", "--report", "--title", "\nFurther options:\n",
        "--threshold", "--model", "--invert", "--later", "--threads", "Example:"}) {
    const std::size_t at = help.find(part, before);
    ASSERT_NE(at, std::string::npos) << part << " is not after the others:\n" << help;
    before = at + 1;
  }
  EXPECT_EQ(help.find("Strips:"), std::string::npos);
}

/// An option that has had two names, one of them with another unit.
CommandLine renamed() {
  CommandLine line = exampleLine();
  line.addNumber("count", "a number", {}, {0.0, 100.0, "thousands"})
      .formerly("number", 1e-3)
      .formerly("amount");
  return line;
}

TEST(CommandLine, FormerNamesAreAcceptedWithARemark) {
  const auto given = [](std::vector<const char*> arguments) {
    CommandLine line = renamed();
    testing::internal::CaptureStderr();
    EXPECT_TRUE(parse(line, std::move(arguments)));
    return std::make_pair(line.number("count"), testing::internal::GetCapturedStderr());
  };
  EXPECT_EQ(given({"-count", "5"}), std::make_pair(5.0, std::string()));
  EXPECT_EQ(given({"--amount=5"}),
            std::make_pair(5.0, std::string("pcl_als_example: option -amount is now called -count; "
                                            "the next release does not accept the former name\n")));
  EXPECT_EQ(given({"-number", "5000"}).first, 5.0);
  EXPECT_EQ(given({"-number", "5000", "-quiet"}), std::make_pair(5.0, std::string()));
}

TEST(CommandLine, FormerNamesAreOptionsLikeOthers) {
  const auto refused = [](std::vector<const char*> arguments) {
    CommandLine line = renamed();
    testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      parse(line, std::move(arguments));
    } catch (const UsageError& error) {
      message = error.what();
    }
    testing::internal::GetCapturedStderr();
    return message;
  };
  EXPECT_EQ(refused({"-count", "1", "-amount", "1"}), "option -count: is given twice");
  EXPECT_NE(refused({"-number", "500000"}).find("-count: '500' is not a number from 0 to 100"),
            std::string::npos);
  EXPECT_NE(refused({"-control", "-amount"}).find("-control: needs a value"), std::string::npos);
}

TEST(Run, TurnsExceptionsIntoOneLineAndAStatus) {
  const auto status = [](const auto& error) {
    testing::internal::CaptureStderr();
    const int result = run(exampleLine(), [&]() -> int { throw error; });
    return std::make_pair(result, testing::internal::GetCapturedStderr());
  };
  EXPECT_EQ(status(UsageError("option -x")),
            std::make_pair(1, std::string("pcl_als_example: option -x\n")));
  EXPECT_EQ(status(InputError("a.las: empty")),
            std::make_pair(2, std::string("pcl_als_example: a.las: empty\n")));
  EXPECT_EQ(status(std::bad_alloc()).first, 2);
  EXPECT_EQ(status(std::runtime_error("other")).first, 2);
  EXPECT_EQ(run(exampleLine(), [] { return 3; }), 3);
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
