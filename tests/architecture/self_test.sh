#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# self_test.sh SCRATCH_DIR: check.sh finds every kind of breach in a tree made for it, and passes the
# same tree without them.
set -euo pipefail
export LC_ALL=C
check=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)/check.sh
rm -rf -- "$1" && mkdir -p -- "$1" && cd -- "$1"
failures=0

make_tree() {
  rm -rf modules apps tests share
  mkdir -p modules/{common,tin,simulation}/{src,include/pcl_als/x} apps tests share
  local module
  for module in common tin simulation; do
    printf '## %s\n' Purpose Usage Method Limits Constants >"modules/$module/README.md"
    echo '// SPDX-License-Identifier: BSD-3-Clause' >"modules/$module/src/a.cpp"
  done
  echo 'als_add_module(NAME common SOURCES src/a.cpp)' >modules/common/CMakeLists.txt
  echo 'als_add_module(NAME tin SOURCES src/a.cpp MODULES common)' >modules/tin/CMakeLists.txt
  echo 'als_add_module(NAME simulation SOURCES src/a.cpp MODULES common)' >modules/simulation/CMakeLists.txt
  echo '#include <pcl_als/common/errors.h>' >>modules/tin/src/a.cpp
}

expect() {  # status, text; the tree as it stands
  local output status=0
  output=$("$check" . 2>&1) || status=$?
  if [[ $status != "$1" || $output != *"$2"* ]]; then
    echo "expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}

make_tree; expect 0 "keep to the architecture"
make_tree; echo '#include <pcl_als/tin/tin.h>' >>modules/simulation/src/a.cpp; expect 1 "does not declare module tin"
make_tree; sed -i 's/MODULES common/MODULES common tin/' modules/simulation/CMakeLists.txt; expect 1 "must not use module tin"
make_tree; sed -i 's/)/ MODULES simulation)/' modules/common/CMakeLists.txt; expect 1 "must not use module simulation"
make_tree; sed -i 's/)/ PRIVATE pcl_als::io)/' modules/tin/CMakeLists.txt; expect 1 "without MODULES"
make_tree; echo '#include "../../apps/x.h"' >>modules/tin/src/a.cpp; expect 1 "across folders"
make_tree; echo '#include "command_line.h"' >>modules/tin/src/a.cpp; expect 1 "not beside it"
make_tree; echo '# include <vtkActor.h>' >>modules/tin/src/a.cpp; expect 1 "only visualization uses VTK"
make_tree; echo 'void f() { std::cout << 1; }' >>modules/tin/src/a.cpp; expect 1 "prints"
make_tree; echo 'void f() { char b[9]; std::snprintf(b, 9, ""); }' >>modules/tin/src/a.cpp; expect 0 "keep to"
make_tree; echo 'const char* s = "too far apart; see -max_distance";' >>modules/tin/src/a.cpp; expect 1 "names an option"
make_tree; echo 'const char* s = "from 1 -", *t = "x" /* -y */;  // "-crs"' >>modules/tin/src/a.cpp; expect 0 "keep to"
make_tree; echo 'int whole = sharing;' >>modules/tin/src/a.cpp; expect 1 "uses the name sharing instead of variance_inflation"
make_tree; printf '/* sharing\n sharing */ const char* s = "sharing";  // sharing\n' >>modules/tin/src/a.cpp; expect 0 "keep to"
make_tree; echo 'int x;' >modules/tin/src/a.cpp; expect 1 "no SPDX line"
make_tree; printf '%.0s<' {1..7} >>modules/tin/README.md; echo ' HEAD' >>modules/tin/README.md; expect 1 "unfinished merge"
make_tree; echo 'project(pcl_als VERSION 1.2.3)' >CMakeLists.txt; echo 'version: 1.2.2' >CITATION.cff
expect 1 "CITATION.cff: does not name the version 1.2.3"
rm CMakeLists.txt CITATION.cff
make_tree; printf '//\n%.0s' {1..400} >>modules/tin/src/a.cpp; expect 1 "more than 400"
make_tree; cp modules/tin/src/a.cpp modules/tin/src/forgotten.cpp; expect 1 "is not listed"
make_tree; cp modules/tin/src/a.cpp modules/tin/src/more_a.cpp; sed -i s/a.cpp/more_a.cpp/ modules/tin/CMakeLists.txt
expect 1 "src/a.cpp: is not listed"
make_tree; mkdir modules/extra; expect 1 "unknown module"
make_tree; for i in {1..61}; do echo '// SPDX-License-Identifier: BSD-3-Clause' >modules/tin/include/pcl_als/x/h$i.h; done; expect 1 "installs 61 headers for users"
make_tree; mkdir -p modules/tin/internal/pcl_als/tin; for i in {0..101}; do
  { echo '// SPDX-License-Identifier: BSD-3-Clause'; echo "#include <pcl_als/tin/h$((i + 1)).h>"; } >modules/tin/internal/pcl_als/tin/h$i.h
done
{ echo '// SPDX-License-Identifier: BSD-3-Clause'; echo '#include <pcl_als/tin/h1.h>'; } >modules/tin/include/pcl_als/x/a.h; expect 1 "include 101 others"
make_tree; rm modules/tin/README.md; expect 1 "has no README.md"
make_tree; sed -i '/Limits/d' modules/tin/README.md; expect 1 "has no section Limits"
make_tree; printf '| term |\n|---|\n' >share/GLOSSARY.md; expect 1 "has a table without"
make_tree; printf 'x%.0s' {1..100} >share/a.md; expect 1 "100 characters or more"
make_tree; { printf '|'; printf 'x%.0s' {1..120}; } >share/a.md; expect 0 "keep to"
make_tree; { echo 'X::X() : a_{1}, b_(2) {'; printf '  f("}");\n%.0s' {1..56}; echo '}'; } >>modules/tin/src/a.cpp
expect 1 "a function of 58 lines"
sed -i '$d;4d' modules/tin/src/a.cpp; echo '}' >>modules/tin/src/a.cpp; expect 0 "keep to"
((failures == 0)) || exit 1
echo "All breaches were found."
