# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# awk -v tool=pcl_als_info -f completion.awk: completion in bash, from what `pcl_als_info -list_options`
# prints: names of options, words of a choice, and files.
BEGIN { FS = "\t" }
NR == 1 || $1 == "IN" || $1 == "OUT" { next }
{ options = options " -" $1 }
$2 == "choice" {
  gsub(/,/, " ", $8)
  values = values "    -" $1 ") COMPREPLY=($(compgen -W \"" $8 "\" -- \"$word\")) ;;\n"
}
END {
  print "# Completion of " tool " in bash."
  print "_" tool "() {"
  print "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} file"
  print "  COMPREPLY=()"
  print "  case ${before/#--/-} in"
  printf "%s", values
  print "    *)"
  print "      if [[ $word == -* ]]; then"
  print "        COMPREPLY=($(compgen -W \"" substr(options, 2) "\" -- \"${word/#--/-}\"))"
  print "      else"
  print "        while IFS= read -r file; do COMPREPLY+=(\"$file\"); done < <(compgen -f -- \"$word\")"
  print "      fi ;;"
  print "  esac"
  print "}"
  print "complete -o filenames -F _" tool " " tool
}
