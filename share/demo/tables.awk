# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Prints the records of summary.cmake as tables.
BEGIN { FS = "\t" }

function digits(unit) { return unit == "arcsec" ? "%.2f" : unit == "1" ? "%.7f" : "%.4f" }
function heading(which) {
  if (section == which) return
  section = which
  if (which == "parameter") {
    print "\nSystem biases (assumed - true)"
    printf "  %-19s %-7s %12s %12s %12s %12s\n", "parameter", "unit", "estimated", "true", "difference", "std"
  } else if (which == "pair") {
    print "\nNormal distances between overlapping strips, m"
    printf "  %-19s %10s %10s %12s %12s\n", "pair", "RMS before", "RMS after", "mean before", "mean after"
  } else {
    print "\nHeight differences strip - control, m"
    printf "  %-19s %10s %10s %12s %12s\n", "strip (points)", "RMS before", "RMS after", "mean before", "mean after"
  }
}

$1 == "parameter" {
  heading($1)
  form = digits($3)
  if ($4 == "estimated") {
    printf "  %-19s %-7s %12s %12s %12s %12s\n", $2, $3, sprintf(form, $5), sprintf(form, $7), \
      sprintf(form, $5 - $7), sprintf(form, $6)
  } else {
    label = $4
    gsub(/_/, " ", label)
    printf "  %-19s %-7s %12s %12s\n", $2, $3, label, sprintf(form, $7)
  }
}
$1 == "pair" || $1 == "control" {
  heading($1)
  name = $1 == "pair" ? $2 " & " $3 : $2 " (" $3 ")"
  printf "  %-19s %10.4f %10.4f %12.4f %12.4f\n", name, $4, $5, $6, $7
}
