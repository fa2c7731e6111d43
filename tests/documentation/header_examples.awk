# Writes a source file with the examples of headers: the includes of these headers, and a function
# for every block between \code and \endcode, which uses the names of header_examples.h.
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
