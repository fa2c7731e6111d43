// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/io/raster_io.h>

#include "gdal_handle.h"

namespace pcl_als::detail {

/// Places, CRS, names, colours and no-data of the bands of a new dataset.
void describeDataset(GDALDatasetH dataset, const RasterLayout& layout, const GdalReports& reports);

/// The same of a dataset that was opened.
RasterLayout layoutOf(GDALDatasetH dataset, const GdalReports& reports);

/// UsageError for a window that is not within the grid, or a band that the layout does not have.
void checkWindow(const RasterLayout& layout, std::size_t band, const RasterWindow& window);

}  // namespace pcl_als::detail
