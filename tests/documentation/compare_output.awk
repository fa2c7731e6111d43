# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -f compare_output.awk N.expected N.out: every line that a page shows was printed, in that
# order. Blanks do not count, a line that ends with … is the beginning of one, times in ms may
# differ, and numbers by 5 % and a unit of their last digit: compilers round differently, standard
# deviations change by some per cent with another sample of the points, and the manual states
# figures, not bits.
function words(line) {
  gsub(/[0-9.]+ ms/, "# ms", line)
  gsub(/[|,;:()=]/, " & ", line)
  sub(/^ +/, "", line)
  sub(/ +$/, "", line)
  gsub(/[ \t]+/, " ", line)
  return line
}
function is_number(word) { return word ~ /^[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?$/ }
function near(a, b, digits) {
  if (a == b) return 1
  if (!is_number(a) || !is_number(b)) return 0
  digits = a ~ /\./ && a !~ /e/ ? length(a) - index(a, ".") : 0
  difference = a - b
  if (difference < 0) difference = -difference
  size = a < 0 ? -a : a
  return difference <= 0.05 * size + 1.001 * 10 ^ -digits
}
function same(a, b, i, n, m, left, right) {
  if (a == b) return 1
  n = split(a, left, " ")
  m = split(b, right, " ")
  if (n > 1 && left[n] == "…") m = --n > m ? -1 : n
  if (n != m) return 0
  for (i = 1; i <= n; ++i) if (!near(left[i], right[i])) return 0
  return 1
}
FNR == NR {
  if (FNR == 1) place = $0
  else if (NF) wanted[++total] = words($0)
  next
}
{ printed[FNR] = words($0); lines = FNR }
END {
  at = 0
  for (i = 1; i <= total; ++i) {
    for (j = at + 1; j <= lines; ++j) if (same(wanted[i], printed[j])) break
    if (j > lines) {
      print place ": shows what was not printed: " wanted[i]
      wrong = 1
    } else at = j
  }
  exit wrong
}
