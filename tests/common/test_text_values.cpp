// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {
namespace {

using Names = std::vector<std::string>;
using Pair = std::pair<std::string, std::string>;

TEST(TextValues, NumbersAreWholeTexts) {
  EXPECT_EQ(valueIn<double>("+1.5"), 1.5);
  EXPECT_EQ(valueIn<int>("-7"), -7);
  for (const char* text : {"", "+", "+-1", "1.5 ", " 1", "1,5", "0x10", "1e400"})
    EXPECT_FALSE(valueIn<double>(text)) << text;
  EXPECT_FALSE(valueIn<std::uint8_t>("256"));
  EXPECT_FALSE(valueIn<std::uint64_t>("-1"));
  EXPECT_TRUE(std::isnan(valueIn<double>("nan").value()));
  EXPECT_FALSE(finiteNumber("nan"));
  EXPECT_FALSE(finiteNumber("inf"));
}

TEST(TextValues, ListsLoseBlanksAndEmptyParts) {
  EXPECT_EQ(splitList(" a, b\t,,c d "), (Names{"a", "b", "c d"}));
  EXPECT_TRUE(splitList(" , ").empty());
  EXPECT_EQ(joined({"a", "b"}), "a, b");
  EXPECT_EQ(fileNames({"x/a.las", "b.las", "c.las", "d.las", "e.las"}),
            "a.las, b.las, c.las and 2 more");
  EXPECT_EQ(numbersIn("1x-2.5", 'x'), (std::vector<double>{1.0, -2.5}));
  EXPECT_TRUE(numbersIn("1x", 'x').size() == 1 && numbersIn("1xa", 'x').empty());
}

TEST(TextValues, PairsAndAssignments) {
  EXPECT_EQ(assignmentIn("a=b=3"), Pair("a=b", "3"));
  EXPECT_FALSE(assignmentIn("=3"));
  EXPECT_FALSE(assignmentIn("a"));
  EXPECT_EQ(pairsIn("1:2, a:b"), (std::vector<Pair>{{"1", "2"}, {"a", "b"}}));
  for (const char* text : {"", ":2", "1:", "1"}) EXPECT_THROW(pairsIn(text), UsageError) << text;
  const auto values = stripValuesIn("3=0.8,4=1.5", 0.1, 2.0);
  EXPECT_EQ(values.at("3"), 0.8);
  EXPECT_EQ(values.size(), 2U);
  for (const char* text : {"", "3", "3=x", "3=0", "3=1,3=1", "3=nan"})
    EXPECT_THROW(stripValuesIn(text, 0.1, 2.0), UsageError) << text;
}

TEST(TextValues, BiasesAndParametersByName) {
  const SystemVector biases = biasesIn("range_bias=0.1,boresight_roll=-90");
  EXPECT_EQ(biases[indexOf(SystemParameter::range_bias)], 0.1);
  EXPECT_NEAR(biases[indexOf(SystemParameter::boresight_roll)], -90.0 * kRadiansPerArcsec, 1e-18);
  EXPECT_THROW(biasesIn(" ,"), UsageError);
  EXPECT_THROW(biasesIn("range_bias=1000"), UsageError);
  EXPECT_EQ(systemParametersIn("range_bias,range_bias").size(), 1U);
  EXPECT_THROW(systemParametersIn("range"), UsageError);
  EXPECT_THROW(systemParametersIn(""), UsageError);
}

}  // namespace
}  // namespace pcl_als
