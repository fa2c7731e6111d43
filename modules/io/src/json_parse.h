// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace pcl_als::detail {

/// Parses the text of the file \a name. InputError for what is not JSON, and for an object with the
/// same key twice: it would be a matter of the parser which of them counts.
nlohmann::json parseJson(const std::string& text, const std::string& name);

}  // namespace pcl_als::detail
