#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_packages.sh BUILD_DIR SCRATCH_DIR: manual pages agree with what the tools print, and the Debian
# packages hold libraries, tools and headers apart, with the dependencies that they need.
set -uo pipefail
export LC_ALL=C
build=$1 scratch=$2/packages
sources=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
rm -rf -- "$scratch" && mkdir -p -- "$scratch" && cd -- "$scratch" || exit 1
failures=0
failed() { failures=$((failures + 1)); echo "FAILED: $1"; }

(cd -- "$sources" &&
  awk -f share/doc/doxygen/anchor.awk -f tests/documentation/markdown.awk share/doc/*.md) |
  awk -F '\t' '$1 == "anchor" { print $2 "#" $4 }' >headings.txt
for tool in "$build"/bin/pcl_als_*; do
  name=$(basename -- "$tool") page=$build/man/$(basename -- "$tool").1
  [[ -s $page ]] || { failed "$name has no manual page"; continue; }
  "$tool" -h >help.txt
  sed 's/\\-/-/g' "$page" >page.txt
  for section in NAME SYNOPSIS OPTIONS EXAMPLE "EXIT STATUS" "SEE ALSO"; do
    grep -qx ".SH $section" "$page" || failed "$name.1 has no section $section"
  done
  # Every option is a paragraph of its own.
  while read -r option; do
    grep -qE -- "^\.B -($option|h, -help)( |$)" page.txt || failed "$name.1 lacks -$option"
  done < <(sed -nE 's/^  --([a-z_]+).*/\1/p' help.txt)
  # It names a heading of the manual.
  reference=$(sed -nE 's/^\.I (share\/doc\/[a-z_]+\.md#.*)$/\1/p' page.txt)
  grep -qxF "$reference" headings.txt || failed "$name.1 names no heading of the manual: $reference"
  # Defaults are written as people write them: no digits of the nearest double.
  grep -nE '[0-9]\.[0-9]*(0{6}|9{6})' help.txt && failed "$name -h prints a number with too many digits"
done

if command -v cpack >/dev/null && command -v dpkg-shlibdeps >/dev/null && command -v dpkg-deb >/dev/null; then
  cpack -G DEB --config "$build/CPackConfig.cmake" -B "$PWD" -D CPACK_INSTALL_CMAKE_PROJECTS="$build;pcl_als;ALL;/" \
    -D CPACK_CMAKE_GENERATOR=Ninja >cpack.log 2>&1 || { cat cpack.log; failed "cpack"; }
  holds() {  # PACKAGE PATTERN
    dpkg-deb -c "$1"_*.deb >list.txt && grep -qE "$2" list.txt || failed "package $1 does not hold $2"
  }
  holds libpcl-als0 ' ./usr/lib/.*libpcl_als_io\.so\.0'
  holds pcl-als-tools ' ./usr/bin/pcl_als_calibrate$'
  holds pcl-als-tools ' ./usr/share/man/man1/pcl_als_calibrate\.1\.gz$'
  holds pcl-als-doc ' ./usr/share/doc/pcl_als/share/doc/first_steps\.md$'
  dpkg-deb -x pcl-als-doc_*.deb documentation
  "$sources/tests/documentation/check_links.sh" documentation/usr/share/doc/pcl_als >links.txt ||
    { cat links.txt; failed "the links of the packaged manual"; }
  holds libpcl-als-dev ' ./usr/include/pcl_als/common/point_types\.h$'
  holds libpcl-als-dev ' ./usr/lib/(.*/)?cmake/pcl_als/pcl_als-config\.cmake$'
  if [[ -d $build/python ]]; then
    holds python3-pcl-als ' ./usr/lib/python3[^/]*/dist-packages/pcl_als/_pcl_als\..*\.so$'
    holds python3-pcl-als ' ./usr/lib/python3[^/]*/dist-packages/pcl_als/(__init__\.pyi|py\.typed)$'
    dpkg-deb -f python3-pcl-als_*.deb Depends | grep -q 'libpcl-als0 (= .*python3-numpy' ||
      failed "the Python package does not need libraries and numpy"
    for package in libpcl-als0 python3-pcl-als; do dpkg-deb -x "$package"_*.deb root; done
    PYTHONPATH=$(echo "$PWD"/root/usr/lib/python3*/dist-packages) /usr/bin/python3 -c '
import pcl_als
with open("/proc/self/maps") as maps:
    assert not [line for line in maps if "libpcl_als" in line and "/root/usr/lib/" not in line]' ||
      failed "the Python package does not run with the libraries of the package"
  fi
  for package in *.deb; do
    name=${package%%_*}
    for field in 'Maintainer .+ <[^@]+@[^@]+\..+>' 'Homepage https?://.+' 'Source pcl-als'; do
      dpkg-deb -f "$package" "${field%% *}" | grep -qE "^${field#* }$" || failed "$name: field ${field%% *}"
    done
    # A synopsis of its own and a description.
    dpkg-deb -f "$package" Description | awk 'NR == 1 && /^[a-z].*\(.*\)$/ { n++ } NR > 1 && /^ / { n++ } END { exit n < 3 }' ||
      failed "$name: description"
    holds "$name" " ./usr/share/doc/$name/copyright$"
    holds "$name" " ./usr/share/doc/$name/changelog\.Debian\.gz$"
  done
  if command -v lintian >/dev/null; then
    lintian --allow-root --no-cfg --fail-on error,warning ./*.deb >lintian.txt 2>&1 ||
      { cat lintian.txt; failed "lintian"; }
  else
    echo "SKIPPED: lintian is not installed"
  fi
  dpkg-deb -c libpcl-als0_*.deb >list.txt
  grep -E 'include/|bin/' list.txt && failed "libpcl-als0 holds headers or tools"
  dpkg-deb -f pcl-als-tools_*.deb Depends | grep -q 'libpcl-als0 (= ' || failed "tools do not need the libraries"
  dpkg-deb -f libpcl-als0_*.deb Depends | grep -q libpcl-common || failed "libraries do not need PCL"
else
  echo "SKIPPED: packages need cpack, dpkg-deb and dpkg-shlibdeps"
fi
[[ $failures == 0 ]] && echo "manual pages and packages as expected"
exit $((failures > 0))
