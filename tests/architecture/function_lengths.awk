# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# function_lengths.awk: the lines of every function in C++ sources, from its signature to its
# closing brace, as LINES<tab>FILE<tab>LINE<tab>SIGNATURE. A function is a block in braces outside
# of other functions whose preceding text since the last statement contains parentheses.

function resetText() { text = ""; begin = 0 }

# Whether the text before a brace opens a function. An initialiser of a constructor's member list
# ("X::X() : member_{…}") and of a variable do not.
function opensFunction(t) {
  if (t !~ /\)/ || t ~ /(=|return)$/) return 0
  if (t ~ /(^| )(namespace|class|struct|enum|union)[^()]*$/) return 0
  return t !~ /\) *: .*[A-Za-z0-9_>]$/
}

# Removes a raw string that begins or continues on a line.
function withoutRawString(line,    i, tag) {
  if (raw_end != "") {
    i = index(line, raw_end)
    if (!i) return ""
    line = substr(line, i + length(raw_end))
    raw_end = ""
  }
  if (match(line, /R"[A-Za-z_]*\(/)) {
    tag = substr(line, RSTART + 2, RLENGTH - 3)
    i = index(substr(line, RSTART + RLENGTH), ")" tag "\"")
    if (!i) raw_end = ")" tag "\""
    line = substr(line, 1, RSTART - 1) "0" \
           (i ? substr(line, RSTART + RLENGTH + i + length(tag) + 1) : "")
  }
  return line
}

# Position of the quote that closes the literal that opens at k.
function endOfLiteral(line, k,    quote) {
  quote = substr(line, k, 1)
  for (++k; k <= length(line) && substr(line, k, 1) != quote; ++k)
    if (substr(line, k, 1) == "\\") ++k
  return k
}

function openBrace() {
  ++depth
  if (within) return
  gsub(/[ \t]+/, " ", text)
  gsub(/^ | $/, "", text)
  if (opensFunction(text)) {
    within = depth; first = begin; signature = substr(text, 1, 100)
  } else if (text ~ /\) *: .*[A-Za-z0-9_>]$/) {
    initialiser = depth
    return
  }
  resetText()
}

function closeBrace() {
  if (depth == within) {
    printf "%d\t%s\t%d\t%s\n", FNR - first + 1, FILENAME, first, signature
    within = 0
  }
  if (depth == initialiser) initialiser = 0; else resetText()
  --depth
}

FNR == 1 { depth = within = initialiser = parentheses = comment = 0; raw_end = ""; resetText() }

{
  line = withoutRawString($0)
  if (line ~ /^[ \t]*#/) next
  if (!depth && line ~ /^[A-Z_0-9]+\(.*\)$/) next  # a macro without semicolon
  for (k = 1; k <= length(line); ++k) {
    c = substr(line, k, 1)
    two = substr(line, k, 2)
    if (comment) {
      if (two == "*/") { comment = 0; ++k }
    } else if (two == "//") {
      break
    } else if (two == "/*") {
      comment = 1; ++k
    } else if (c == "\"" || (c == "'" && substr(line, k - 1, 1) !~ /[0-9a-fA-F]/)) {
      k = endOfLiteral(line, k)
      text = text "0"
    } else if (c == "{" && (within || parentheses == 0)) {
      openBrace()
    } else if (c == "}" && (within || parentheses == 0)) {
      closeBrace()
    } else if (parentheses == 0 && (c == ";" || (c == ":" && text ~ /(public|protected|private)$/))) {
      resetText()
    } else {
      if (c == "(") ++parentheses
      if (c == ")") --parentheses
      if (!begin && c !~ /[ \t]/) begin = FNR
      text = text c
    }
  }
  text = text " "
}
