// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/drawing/section.h>
#include <pcl_als/drawing/section_search.h>
#include <pcl_als/processing/picture/picture_source.h>

namespace pcl_als {

/// Places among the chosen strips of files where a misfit shows best; empty where no two strips
/// cover one. \a width: of the sections, metres; 0: by the density of the points.
std::vector<SectionSearch::Place> findSections(const PictureSource& source,
                                               const std::vector<bool>& chosen, std::size_t count,
                                               double width);

/// Points of all sections from one reading of the files. Strips are those of \a names; InputError
/// for another one.
std::vector<SectionPoints> collectSections(const PictureSource& source,
                                           const std::vector<SectionSearch::Place>& places,
                                           const std::vector<std::string>& names,
                                           const std::vector<bool>& chosen);

}  // namespace pcl_als
