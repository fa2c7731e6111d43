# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -v page=share/doc/theory.md -v pages=LIST -f anchor.awk -f page.awk
# share/doc/theory.md: the page for Doxygen.
# Headings get identifiers (share_doc_theory, and with the anchor of GitHub share_doc_theory-frames),
# links to the pages of LIST, one in a line, become references to them, and links to other files of the
# project lead to their copies in the folder "files". Code stays as it is.
BEGIN { while ((getline line < pages) > 0) known[line] = 1 }
function identifier(path) {
  sub(/\.md$/, "", path)
  gsub(/[^A-Za-z0-9]/, "_", path)
  return path
}
function resolved(target, parts, out, n, m, i) {
  out = page
  if (!sub(/\/[^\/]*$/, "", out)) out = ""
  n = split((out == "" ? "" : out "/") target, parts, "/")
  m = 0
  for (i = 1; i <= n; ++i) {
    if (parts[i] == "..") --m
    else if (parts[i] != "." && parts[i] != "") stack[++m] = parts[i]
  }
  out = ""
  for (i = 1; i <= m; ++i) out = out (i > 1 ? "/" : "") stack[i]
  return out
}
function reference(target, anchor, file) {
  if (target ~ /^[a-z][a-z0-9+.-]*:/) return target
  anchor = target
  if (!sub(/^[^#]*#/, "", anchor)) anchor = ""
  sub(/#.*$/, "", target)
  file = target == "" ? page : resolved(target)
  if (!(file in known) && (file "/README.md") in known) file = file "/README.md"
  if (file in known) return "@ref " identifier(file) (anchor == "" ? "" : "-" anchor)
  return "files/" file
}
function linked(text, out, target, where) {
  out = ""
  while (match(text, /\]\([^()]*(\([^()]*\)[^()]*)*\)/)) {
    target = reference(substr(text, RSTART + 2, RLENGTH - 3))
    where = substr(text, 1, RSTART - 1)
    if (target ~ /^files\//) {  # as HTML: Doxygen would look for the file among its inputs
      match_start = 0
      for (i = length(where); i > 0; --i) if (substr(where, i, 1) == "[") { match_start = i; break }
      label = substr(where, match_start + 1)
      if (substr(where, match_start - 1, 1) == "!")
        out = out substr(where, 1, match_start - 2) "<img src=\"" target "\" alt=\"" label "\"/>"
      else
        out = out substr(where, 1, match_start - 1) "<a href=\"" target "\">" label "</a>"
    } else {
      out = out where "](" target ")"
    }
    match(text, /\]\([^()]*(\([^()]*\)[^()]*)*\)/)
    text = substr(text, RSTART + RLENGTH)
  }
  return out text
}
# Text outside of `code`: characters that begin commands or quotations of Doxygen are escaped. It
# would take all from one quotation mark to the next, as of 30" and 8", as it stands.
function prose(text) {
  gsub(/\\/, "\\\\", text)
  gsub(/@/, "\\@", text)
  gsub(/"/, "\\&quot;", text)
  return linked(text)
}
# Prints a line of text. Codes are set apart before links are looked for, because a link may have code
# as its text.
function emit(line, code, halves, n, i) {
  n = 0
  while (match(line, /`[^`]*`/)) {
    code[++n] = substr(line, RSTART, RLENGTH)
    line = substr(line, 1, RSTART - 1) "\001" n "\002" substr(line, RSTART + RLENGTH)
  }
  line = prose(line)
  for (i = 1; i <= n; ++i) {
    split(line, halves, "\001" i "\002")
    line = halves[1] code[i] halves[2]
  }
  print line
}
# Whether a link begins in a line and ends in the next one. Doxygen loses the structure of a page with
# such links.
function is_open(line) {
  gsub(/`[^`]*`/, "", line)
  return line ~ /\[[^]]*$/
}
held != "" {
  if (/[^ ]/ && !/^ *(```|~~~|#|[-*+] )/) {
    sub(/^ +/, "")
    $0 = held " " $0
    held = ""
  } else {
    emit(held)
    held = ""
  }
}
match($0, /^ *(```+|~~~+)/) {
  mark = substr($0, RSTART, RLENGTH)
  sub(/^ */, "", mark)
  if (fence == "") {
    fence = mark
    print substr($0, 1, RLENGTH)
    next
  }
  if (length(mark) >= length(fence)) fence = ""
  print
  next
}
fence != "" { print; next }
/^#+ / {
  level = $0
  sub(/ .*/, "", level)
  text = substr($0, length(level) + 2)
  anchor = anchor_of(text)
  count = seen[anchor]++
  gsub(/`/, "", text)  # titles have no code
  gsub(/"/, "\\&quot;", text)
  id = level == "#" && !titled++ ? identifier(page) : identifier(page) "-" anchor (count ? "-" count : "")
  print level " " text " {#" id "}"
  if (id == identifier(page)) print "\n@anchor " identifier(page) "-" anchor "\n"
  next
}
{
  if (is_open($0)) held = $0
  else emit($0)
}
END { if (held != "") emit(held) }
