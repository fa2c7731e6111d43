// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <dlfcn.h>

#include <pcl_als/common/errors.h>

#include "intensity_page.h"

namespace pcl_als::app {

std::unique_ptr<IntensityPage> loadIntensityPage(const IntensityRun& run,
                                                 IntensityOutcome& outcome) {
  void* library = dlopen("libpcl_als_intensity_page.so", RTLD_NOW);  // stays: so do its pictures
  void* make = library == nullptr ? nullptr : dlsym(library, "pcl_als_make_intensity_page");
  if (make == nullptr)
    throw InputError(std::string("option -report: cannot load what draws the report: ") +
                     dlerror());
  using Make = IntensityPage*(const IntensityRun&, IntensityOutcome&);
  return std::unique_ptr<IntensityPage>(reinterpret_cast<Make*>(make)(run, outcome));
}

}  // namespace pcl_als::app
