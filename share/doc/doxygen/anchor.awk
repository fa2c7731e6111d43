# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors

# The anchor that GitHub makes of a heading; for programs that are run with this file before theirs.
function anchor_of(text, link, before, after) {
  gsub(/`/, "", text)
  while (match(text, /\[[^]]*\]\([^)]*\)/)) {  # a link: its text
    link = substr(text, RSTART, RLENGTH)
    before = substr(text, 1, RSTART - 1)
    after = substr(text, RSTART + RLENGTH)
    sub(/\]\(.*/, "", link)
    text = before substr(link, 2) after
  }
  text = tolower(text)
  gsub(/[^a-z0-9 _\200-\377-]/, "", text)
  gsub(/ /, "-", text)
  return text
}
