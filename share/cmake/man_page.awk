# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -v tool=pcl_als_info -v version=0.2.0 -v manual=share/doc/PAGE.md -f man_page.awk: a manual page
# (section 1) from what `pcl_als_info -h` prints, with the page of the manual that shows its use.
function escaped(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  if (text ~ /^[.']/) text = "\\\&" text
  return text
}
# An option's text begins two blanks after it or in the next line; it is collected over its lines and
# printed when the next option begins.
function finish_option() {
  if (option == "") return
  print ".TP\n.B " escaped(option) "\n" escaped(description)
  option = description = ""
}
BEGIN {
  print ".TH " toupper(tool) " 1 \"\" \"pcl_als " version "\" \"pcl_als manual\""
}
NR == 1 {
  sub(/^[^:]*: /, "")
  sub(/\.$/, "")
  print ".SH NAME\n" escaped(tool) " \\- " escaped($0)
  next
}
/^Usage: / {
  sub(/^Usage: /, "")
  print ".SH SYNOPSIS\n" escaped($0)
  if (more != "") print ".SH DESCRIPTION\n" more
  part = "text"
  next
}
/^Options/ { print ".SH OPTIONS\nOptions are accepted with one dash or with two."; part = "options"; next }
/^Example:/ { finish_option(); print ".SH EXAMPLE\n.nf"; part = "example"; next }
/^Exit status:/ {
  finish_option()
  if (part == "example") print ".fi"
  sub(/^Exit status: /, "")
  print ".SH EXIT STATUS\n" escaped($0)
  part = "text"
  next
}
part == "options" && /^[A-Z].*:$/ {
  finish_option()
  print ".SS " escaped(substr($0, 1, length($0) - 1))
  next
}
part == "options" && /^  -/ {
  finish_option()
  option = $0
  sub(/^  /, "", option)
  if (match(option, /  +/)) {
    description = substr(option, RSTART + RLENGTH)
    option = substr(option, 1, RSTART - 1)
  }
  sub(/ +$/, "", option)
  sub(/^--/, "-", option)
  next
}
part == "options" && NF > 0 {
  sub(/^ +/, "")
  description = description (description == "" ? "" : " ") $0
  next
}
NF > 0 {
  sub(/^  /, "")
  if (part == "") more = more (more == "" ? "" : "\n.br\n") escaped($0)
  else print escaped($0)
}
END {
  finish_option()
  print ".SH SEE ALSO"
  print "The manual of pcl_als, installed in share/doc/pcl_als (Debian package pcl\\-als\\-doc):"
  print ".I " escaped(manual)
}
