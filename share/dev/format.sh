#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/format.sh [--check]: clang-format 14 on every C++ file; --check only names those that
# would change and ends with status 1.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
format=$(command -v clang-format-14 || command -v clang-format)
mode=(-i)
[[ ${1:-} != --check ]] || mode=(--dry-run --Werror)
find modules apps tests share \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) -print0 |
  xargs -0 "$format" --style=file "${mode[@]}"
