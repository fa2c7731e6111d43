// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/las/laz_point_reader.h>

#include "chunk_table.h"

namespace pcl_als::laz {

/** \brief Decodes the chunks of a damaged file once, on several threads where its chunk table is
 * intact; the others proceed in order up to the first chunk that cannot be decoded.
 *
 * \param table of a file without one, it is completed by the chunks that were found
 */
LazIntact findIntactChunks(const LazSchema& schema, const LazReadAt& read, const LazPoints& points,
                           ChunkTable& table);

}  // namespace pcl_als::laz
