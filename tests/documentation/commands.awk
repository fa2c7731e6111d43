# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -v output=FOLDER -v kinds=" sh " -f commands.awk PAGE.md …: the commands of Markdown pages as
# one shell script on standard output. Blocks of the given kinds (```sh) are copied; what each one
# prints goes to FOLDER/N.out, and the blocks ```text that follow it, which show it, to
# FOLDER/N.expected with their place.
BEGIN { print "set -euo pipefail\nexec 3>&2" }
FNR == 1 { shown = 0 }
/^```/ && !code {
  kind = substr($0, 4)
  code = 1
  if (index(kinds, " " kind " ")) {
    run = 1
    name = output "/" ++count
    print "trap 'echo \"" FILENAME ":" FNR ": a command of this block failed\" >&3' ERR"
    print "exec >'" name ".out' 2>&1"
    shown = count
  } else if (kind == "text" && shown) {
    expected = output "/" shown ".expected"
    if (expected != begun) print FILENAME ":" FNR > expected
    begun = expected
  }
  next
}
/^```$/ {
  code = run = 0
  expected = ""
  next
}
run { print }
expected != "" { print > expected }
/^#/ && !code { shown = 0 }
