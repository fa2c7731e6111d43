// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/filters/impl/waveform_decomposition.hpp>

template class pcl_als::WaveformDecomposition<pcl_als::PointLidar>;
