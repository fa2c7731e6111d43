// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/markup.h>
#include <pcl_als/report/html_report.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

std::vector<std::uint8_t> bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

int countOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

// RFC 4648, section 10.
TEST(Base64, TestVectors) {
  EXPECT_EQ(base64({}), "");
  EXPECT_EQ(base64(bytesOf("f")), "Zg==");
  EXPECT_EQ(base64(bytesOf("fo")), "Zm8=");
  EXPECT_EQ(base64(bytesOf("foo")), "Zm9v");
  EXPECT_EQ(base64(bytesOf("foob")), "Zm9vYg==");
  EXPECT_EQ(base64(bytesOf("fooba")), "Zm9vYmE=");
  EXPECT_EQ(base64(bytesOf("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64({0xff, 0xfe, 0x00, 0x80}), "//4AgA==");
}

HtmlReport sample() {
  HtmlReport report("Block <7> & \"more\"", "pcl_als_test 1.2.3");
  report.setVerdict(VerdictGrade::attention, "Strips agree to 2.1 cm.");
  report.addVerdict("Roll is −90.1 ± 0.8 arcsec.");
  report.addSection("Pairs");
  report.addText("a < b");
  report.addList({"one", "two"});
  report.addTable({"pairs", "Fits, m", {"pair", "rms"}, {{"1 : 2", "0.02"}, {"3, \"4\"", "−0.5"}}});
  Canvas picture(4, 3);
  picture.fill({0.0, 0.0, 2.0, 2.0}, {10, 20, 30});
  report.addPicture(picture, "A \"picture\"");
  report.addSetting("range_noise", "0.02");
  report.addInput("/does/not/exist.las");
  return report;
}

TEST(HtmlReport, EscapesAndHoldsEverything) {
  const std::string html = sample().html();
  EXPECT_NE(html.find("<title>Block &lt;7&gt; &amp; &quot;more&quot;</title>"), std::string::npos);
  EXPECT_NE(html.find("<section id=\"verdict\" class=\"attention\">"), std::string::npos);
  EXPECT_NE(html.find("<p>a &lt; b</p>"), std::string::npos);
  EXPECT_NE(html.find("<table id=\"pairs\">"), std::string::npos);
  EXPECT_EQ(countOf(html, "<svg "), 1);
  EXPECT_NE(html.find("width=\"4\" height=\"3\""), std::string::npos);
  EXPECT_NE(html.find("<title>A &quot;picture&quot;</title>"), std::string::npos);
  EXPECT_NE(html.find("<path d=\"M0 0L2 0L2 2L0 2Z\" fill=\"#0a141e\"/>"), std::string::npos);
  EXPECT_NE(html.find("pcl_als_test 1.2.3"), std::string::npos);
  EXPECT_NE(html.find("missing"), std::string::npos);
  // The verdict stands before everything else; nothing asks for a network.
  EXPECT_LT(html.find("Strips agree"), html.find("<h2 "));
  for (const char* banned : {"http", "<script ", "@import", "url(", "file:"}) {
    EXPECT_EQ(html.find(banned), std::string::npos) << banned;
  }
}

TEST(HtmlReport, WritesPageMarkdownAndCsv) {
  const auto folder = pictureFile("report");
  std::filesystem::remove_all(folder);
  sample().write(folder);
  EXPECT_EQ(contentOf(folder / "pairs.csv"), "pair,rms\n1 : 2,0.02\n\"3, \"\"4\"\"\",-0.5\n");
  const std::string markdown = contentOf(folder / "report.md");
  EXPECT_NE(markdown.find("**Strips agree to 2.1 cm.**"), std::string::npos);
  EXPECT_NE(markdown.find("| 1 : 2 | 0.02 |"), std::string::npos);
  EXPECT_NE(contentOf(folder / "report.html").find("</html>"), std::string::npos);
}

TEST(HtmlReport, RowsThatEndEarlyGoAcross) {
  const auto folder = pictureFile("early");
  HtmlReport report("x", "y");
  report.addTable({"t", "", {"pair", "mean", "rms"}, {{"1 : 2", "0.1", "0.2"}, {"1 : 3", "none"}}});
  const std::string html = report.html();
  EXPECT_NE(html.find("1 : 3</td><td colspan=\"2\">none</td></tr>"), std::string::npos);
  // The remark makes no text of the column's numbers.
  EXPECT_NE(html.find("<td class=\"n\">0.1</td>"), std::string::npos);
  report.write(folder);
  EXPECT_EQ(contentOf(folder / "t.csv"), "pair,mean,rms\n1 : 2,0.1,0.2\n1 : 3,none,\n");
}

TEST(HtmlReport, MarksRowsAndTextThatBeginsWithANumberIsText) {
  HtmlReport report("x", "y");
  report.addSection("First & last");
  report.addSection("Second");
  report.addSection("Third");
  report.addTable({"",
                   "",
                   {"pair", "value", "remark"},
                   {{"1 : 2", "0.1 (0.02)", "2.9 standard deviations"}, {"1 : 3", "−0.2", "3 m"}},
                   {1}});
  const std::string html = report.html();
  EXPECT_NE(html.find("<td class=\"n\">0.1 (0.02)</td><td>2.9 standard"), std::string::npos);
  EXPECT_EQ(countOf(html, "<tr class=\"failed\">"), 1);
  EXPECT_NE(html.find("<tr class=\"failed\"><td>1 : 3"), std::string::npos);
  EXPECT_NE(html.find("<a href=\"#sectionFirst___last\">First &amp; last</a>"), std::string::npos);
  EXPECT_NE(html.find("<h2 id=\"sectionFirst___last\">"), std::string::npos);
}

TEST(HtmlReport, RefusesTablesAndFoldersThatCannotBe) {
  HtmlReport report("x", "y");
  EXPECT_THROW(report.addTable({"", "bad", {"a", "b"}, {{"1", "2", "3"}}}), UsageError);
  EXPECT_THROW(report.addTable({"", "bad", {"a", "b"}, {{}}}), UsageError);
  EXPECT_THROW(report.write("/proc/nowhere"), InputError);
}

}  // namespace
}  // namespace pcl_als
