#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# self_test.sh SCRATCH_DIR: check_links.sh finds every kind of broken link and run_commands.sh every
# kind of wrong page in a tree made for it, and both pass the same tree without them.
set -euo pipefail
export LC_ALL=C
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
rm -rf -- "$1/self" && mkdir -p -- "$1/self" && cd -- "$1/self"
failures=0

make_tree() {
  rm -rf share README.md
  mkdir -p share/doc
  printf '# Title\n\nSee [the manual](share/doc/README.md#the-first-page).\n' >README.md
  printf '# The first page\n\n- [second](second.md), [again](second.md#again-1)\n' >share/doc/README.md
  printf '# Second\n\n## Again\n\n## Again\n\n`[code](none.md)` and [up](../../README.md#title).\n' >share/doc/second.md
  printf '\n```sh\necho 100.0 mm in 3 ms > x\ncat x; false || true\n```\n\n```text\n100.1 mm in 12 ms\n```\n' >>share/doc/second.md
  printf '\n```sh\ntest -e x\n```\n\n```cpp\nf[i](none.md);\n```\n' >>share/doc/second.md
}
expect() {  # status, text, command
  local output status=0
  output=$("${@:3}" 2>&1) || status=$?
  if [[ $status != "$1" || $output != *"$2"* ]]; then
    echo "expected status $1 and '$2', got $status and: $output"
    failures=$((failures + 1))
  fi
}
links() { expect "$1" "$2" "$here/check_links.sh" .; }
commands() { expect "$1" "$2" "$here/run_commands.sh" . /usr/bin "$PWD/scratch"; }
page=share/doc/second.md

make_tree; links 0 "4 links in 3 pages"
make_tree; echo '[a](third.md)' >>$page; links 1 "$page:25: third.md: there is no share/doc/third.md"
make_tree; echo '![a](../picture.png "Title")' >>$page; links 1 "there is no share/picture.png"
make_tree; printf '\n[a]: third.md\n' >>$page; links 1 "there is no share/doc/third.md"
make_tree; echo '[a](#nowhere)' >>$page; links 1 "has no heading with the anchor nowhere"
make_tree; echo '[a](README.md#the-first-page-1)' >>$page; links 1 "has no heading"
make_tree; echo '[a](../../../x)' >>$page; links 1 "outside of the project"
make_tree; echo '[a](/tmp)' >>$page; links 1 "is relative"
make_tree; echo '[a](https://example.org/x)' >>$page; links 0 "4 links"
make_tree; echo '# Alone' >share/doc/alone.md; links 1 "share/doc/alone.md: is not linked"

make_tree; commands 0 "2 blocks of commands, the output of 1 compared, 0 failed"
make_tree; sed -i 's/^100.1/107.0/' $page; commands 1 "second.md:14: shows what was not printed: 107.0 mm"
make_tree; sed -i 's/^100.1 mm/100.1 cm/' $page; commands 1 "shows what was not printed"
make_tree; sed -i 's/^100.1 mm.*/100 …/' $page; commands 0 "0 failed"
make_tree; sed -i 's/^100.1 mm.*/100.0 mm in 3 ms x …/' $page; commands 1 "shows what was not printed"
make_tree; sed -i 's/test -e x/test -e y/' $page; commands 1 "second.md:18: a command of this block failed"
make_tree; sed -i 's/```sh/```c/' $page; commands 1 "the manual has no commands"
((failures == 0)) || exit 1
echo "All faults were found."
