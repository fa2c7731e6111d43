# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -f anchor.awk -f markdown.awk PAGE.md …, with share/doc/doxygen/anchor.awk: the headings and
# links of Markdown pages, one in a line, with tabs:
#   anchor  PAGE  LINE  ANCHOR   as GitHub makes it from the heading
#   link    PAGE  LINE  TARGET   inline or by reference; targets with a scheme are left out
# Code is left out.
function report_link(target) {
  sub(/^</, "", target)
  sub(/[> ].*$/, "", target)  # a title may follow
  if (target !~ /^[a-z][a-z0-9+.-]*:/) print "link\t" FILENAME "\t" FNR "\t" target
}
FNR == 1 { fence = ""; blank = 1; split("", seen) }
# Fenced code ends with the characters it began with.
match($0, /^ *(```+|~~~+)/) {
  mark = substr($0, RSTART, RLENGTH)
  sub(/^ */, "", mark)
  if (fence == "") { fence = mark; next }
  if (substr(mark, 1, 1) == substr(fence, 1, 1) && length(mark) >= length(fence)) { fence = ""; next }
}
fence != "" { next }
# Indented code follows an empty line or other indented code, outside of lists.
/^ *$/ { blank = 1; next }
/^    / && blank && !list { next }
{
  if ($0 ~ /^ *([-*+]|[0-9]+\.) /) list = 1
  else if (blank && $0 !~ /^ /) list = 0
  blank = 0
}
/^#+ / {
  text = $0
  sub(/^#+ +/, "", text)
  sub(/ +#* *$/, "", text)
  anchor = anchor_of(text)
  count = seen[anchor]++
  print "anchor\t" FILENAME "\t" FNR "\t" anchor (count ? "-" count : "")
}
{
  rest = $0
  gsub(/``[^`]*``/, "", rest)
  gsub(/`[^`]*`/, "", rest)
  if (match(rest, /^ *\[[^]]+\]: +[^ ]+/)) {
    target = substr(rest, RSTART, RLENGTH)
    sub(/^[^:]*: +/, "", target)
    report_link(target)
    next
  }
  while (match(rest, /\]\([^()]*(\([^()]*\)[^()]*)*\)/)) {
    report_link(substr(rest, RSTART + 2, RLENGTH - 3))
    rest = substr(rest, RSTART + RLENGTH)
  }
}
