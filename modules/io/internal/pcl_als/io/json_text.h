// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/field_value.h>

namespace pcl_als {

/// The text of a JSON file. Fields keep their order; numbers have the fewest digits (at most 17)
/// that read back to the same double, and are null where they are not finite. Bytes that are no
/// UTF-8, which a file name may hold, are replaced.
std::string jsonText(const FieldValue& value);

/// Parses the text of the file \a name. InputError for what is not JSON, and for an object with the
/// same key twice: it would be a matter of the parser which of them counts.
FieldValue parseJson(const std::string& text, const std::string& name);

}  // namespace pcl_als
