// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>
#include <iostream>
#include <new>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/printable.h>

#include "command_line.h"
#include "hint_options.h"
#include "interruption.h"
#include "standard_streams.h"

namespace pcl_als::app {

void addUnitsOption(CommandLine& line, const std::string& of, const std::string& what) {
  const std::string help =
      "unit of the coordinates in " + what + ": metre, international foot or US survey foot";
  line.addChoice(of + "_units", help, {"m", "ft", "us_ft"}, "m").in(Group::inputs);
}

LengthUnit unitOption(const CommandLine& line, const std::string& of) {
  return lengthUnitNamed(line.text(of + "_units"), "option -" + of + "_units");
}

void remark(const CommandLine& line, const std::string& text) {
  if (!text.empty() && !line.quiet()) std::cout << "  " << printable(text) << std::endl;
}

void remarks(const CommandLine& line, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) remark(line, text);
}

int run(int argc, const char* const* argv, CommandLine (*options)(),
        int (*job)(const CommandLine&)) {
  CommandLine line = options();
  return run(line, [&] { return line.parse(argc, argv) ? job(line) : kDone; });
}

int conclude(const CommandLine& line, const std::string& why) {
  if (why.empty()) return kDone;
  std::cerr << line.tool() << ": no reliable answer: " << why << std::endl;
  return kNoReliableAnswer;
}

int reportFailure(const CommandLine& line, const std::exception_ptr& failure) {
  const auto failed = [&line](const std::string& message, int status) {
    std::cerr << line.tool() << ": " << printable(message) << std::endl;
    return status;
  };
  try {
    std::rethrow_exception(failure);
  } catch (const UsageError& error) {
    return failed(withHint(line, error), kWrongUsage);
  } catch (const Error& error) {
    return failed(withHint(line, error), kUnusableInput);
  } catch (const std::bad_alloc&) {
    return failed("not enough memory", kUnusableInput);
  } catch (const std::exception& error) {
    return failed(error.what(), kUnusableInput);
  }
}

int run(const CommandLine& line, const std::function<int()>& body) {
  openStandardStreams();
  removeUnfinishedFilesOnSignals();
  reportAborts(line.tool().c_str());
  const UnchangedInputs unchanged;
  try {
    const int status = body();
    const char* reason = "";
    if (flushStandardOutput(reason) || status != kDone) return status;
    throw InputError(std::string("cannot write to standard output: ") + reason);
  } catch (...) {
    return reportFailure(line, std::current_exception());
  }
}

}  // namespace pcl_als::app
