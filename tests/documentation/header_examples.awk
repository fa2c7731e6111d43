# Writes a program part for the examples of headers: their includes, and a function for every block
# between \code and \endcode. Uses the names that header_examples.h declares.
FNR == 1 { include = FILENAME; sub(/.*\/include\//, "", include); has_example = 0 }
/\\code/ {
  if (!has_example) includes = includes "#include <" include ">\n"
  has_example = on = 1
  text = text "\nvoid example" ++count "() {\n#line " FNR + 1 " \"" FILENAME "\"\n"
  next
}
/\\endcode/ { if (on) text = text "}\n"; on = 0; next }
on { line = $0; sub(/^ *(\*|\/\/\/) ?/, "", line); text = text line "\n" }
END {
  if (count < 30) { print "#error only " count + 0 " examples were found in the headers" }
  printf "%s\n#include \"header_examples.h\"\n\nnamespace examples {\n%s\n}  // namespace examples\n", includes, text
}
