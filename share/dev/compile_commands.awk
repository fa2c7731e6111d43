# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -f compile_commands.awk compile_commands.json: one line for each object that is compiled from a
# source: its path in the build folder, a tabulator, and the command.
/^  "command": / {
  sub(/^  "command": "/, "")
  sub(/",$/, "")
  gsub(/\\"/, "\"")
  gsub(/\\\\/, "\\")
  if (/cmake_pch\.hxx\.cxx$/ || !match($0, / -o [^ ]+/)) next
  print substr($0, RSTART + 4, RLENGTH - 4) "\t" $0
}
