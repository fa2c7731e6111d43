#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# No tool replaces a file that it reads, a file that it writes besides, or a file of the user in an
# output folder. Every output of every tool, as -list_options names them, is given every input of that
# tool: by the same path, another path, a symbolic link, a hard link, and inside an output folder.
source "$(dirname -- "$0")/tool_test.sh"

# table VERB: name, role, need, least number of input files and words of each argument and option of
# the tool, separated by |.
table() { "$bin/pcl_als_$1" -list_options | awk -F'\t' 'NR > 1 { print $1 "|" $2 "|" $3 "|" $6 "|" $8 }'; }
rows() { awk -F'|' -v role="$1" '$2 ~ role' <<<"$all"; }

# arguments_of OUTPUT INPUT: the positional arguments of the form of the command that has these options.
arguments_of() {
  local form need least count=1
  form=$(awk -F'|' -v one="with -$1" -v other="with -$2" \
    '$1 == "IN" && ($3 == one || $3 == other) { print $3; exit }' <<<"$all")
  least=$(awk -F'|' -v form="$form" '$1 == "IN" && $3 == form { print $4; exit }' <<<"$all")
  arguments=()
  while ((count <= least)); do arguments+=("in/points$((count++)).las"); done
  ((least == 0)) || arguments[0]=$input_argument
  need=$(awk -F'|' -v form="$form" '$1 == "OUT" && $3 == form' <<<"$all")
  [[ -z $need || $1 == OUT ]] || arguments+=(spare.las)
}

# refused TEXT VERB ARG…: exit status 1 with TEXT on one line, and no file of the user has changed.
refused() {
  expect 1 "$@"
  checks=$((checks + 1))
  [[ $(sums) == "$before" ]] || failed "pcl_als_${*:2}: changes a file of the user"
}
sums() { find . -name '.pcl_als*' -prune -o -type f ! -name '*.txt' -exec sha256sum {} + | sort; }
fresh() {
  local name
  rm -rf in links spare* && mkdir in links
  for name in points1.las points2.las; do echo "points of the user, $name" >in/$name; done
}

# give VERB OUTPUT VALUE INPUT: the command in which OUTPUT has the path VALUE and INPUT is $file.
give() {
  local verb=$1 output=$2 value=$3 input=$4
  input_argument=in/points1.las
  [[ $input != IN ]] || input_argument=$file
  arguments_of "$output" "$input"
  command=("$verb" "${arguments[@]}")
  [[ $input == IN ]] || command+=("-$input" "$file")
  if [[ $output == OUT ]]; then command=("${command[@]:0:${#arguments[@]}+1}" "$value" "${command[@]:${#arguments[@]}+1}")
  else command+=("-$output" "$value"); fi
}

# An output file is an input, in five ways.
file_is_input() {  # VERB OUTPUT EXTENSION INPUT
  local verb=$1 output=$2 extension=$3 input=$4 value
  fresh
  file=in/file$extension
  echo "a file of the user" >$file
  ln -s ../$file links/symbolic$extension
  ln $file links/hard$extension
  before=$(sums)
  for value in $file in/../in/./file$extension "$PWD/$file" links/symbolic$extension links/hard$extension; do
    give "$verb" "$output" "$value" "$input"
    refused "is also an input" "${command[@]}"
  done
}

# A file in an output folder is an input, or a file that the user put there.
folder_has_input() {  # VERB OUTPUT NAME INPUT
  local verb=$1 output=$2 name=$3 input=$4 value
  fresh
  [[ $name == */* ]] && mkdir -p "in/$(dirname -- "$name")"
  file=in/$name
  echo "a file of the user" >"$file"
  ln -s ../in links/folder
  before=$(sums)
  for value in in in/../in/. links/folder; do
    give "$verb" "$output" "$value" "$input"
    refused "is also an input" "${command[@]}"
  done
  give "$verb" "$output" "$file" "$input"  # the file in place of the folder
  refused "is also an input" "${command[@]}"
  mkdir -p "links/symbolic/$(dirname -- "$name")" "links/hard/$(dirname -- "$name")"
  ln -s "$PWD/$file" "links/symbolic/$name"
  ln "$file" "links/hard/$name"
  before=$(sums)
  for value in links/symbolic links/hard; do
    give "$verb" "$output" "$value" "$input"
    refused "is also an input" "${command[@]}"
  done
}
folder_has_other() {  # VERB OUTPUT NAME
  fresh
  mkdir -p "links/$(dirname -- "$3")"
  echo "a file of the user" >"links/$3"
  before=$(sums)
  file=in/points1.las
  give "$1" "$2" links IN
  refused "would be replaced" "${command[@]}"
}

# A value for the option NAME of ROLE with WORDS: its first extension, or its first file name.
first_word() { local word=${1%%,*}; echo "${word//\*/1}"; }

tools=0
for tool in "$bin"/pcl_als_*; do
  verb=${tool##*/pcl_als_}
  all=$(table "$verb")
  tools=$((tools + 1))
  check "pcl_als_$verb has an output" test -n "$(rows '^(output|folder)$')"
  # The positional inputs of any form are one input.
  inputs=$(rows '^inputs?$' | awk -F'|' '!seen[$1]++ && !($1 == "IN" && $4 == 0 && $3 == "") { print $1 }')
  while IFS='|' read -r output role _ _ words; do
    [[ -n $output ]] || continue
    for input in $inputs; do
      if [[ $role == output ]]; then
        file_is_input "$verb" "$output" "$(first_word "$words")" "$input"
      else
        folder_has_input "$verb" "$output" "$(first_word "${words:-points1.las}")" "$input"
      fi
    done
    [[ $role == folder ]] || continue
    [[ -n $words ]] || words=points1.las  # copies are named as the inputs
    for name in ${words//,/ }; do folder_has_other "$verb" "$output" "${name//\*/1}"; done
  done < <(rows '^(output|folder)$')
  # Two outputs of one path, and a file among those of a folder.
  fresh
  before=$(sums)
  while IFS='|' read -r one role _ _ words; do
    [[ $role == output && -n $one ]] || continue
    while IFS='|' read -r other other_role _ _ other_words; do
      [[ -n $other && $other != "$one" && $one != OUT ]] || continue
      path=spare$(first_word "$words")
      [[ $other_role != folder ]] || path=spare/$(first_word "${other_words:-points1.las}")
      file=in/points1.las
      give "$verb" "$other" "$([[ $other_role == folder ]] && echo spare || echo "$path")" IN
      text=""
      [[ ,$words, == *,"${path##*.}",* || $other_role == folder || ,$other_words, == *",.${path##*.},"* ]] && text="also another output"
      [[ $other_role != folder || ,$words, == *",.${path##*.},"* ]] || text="does not end in"
      refused "$text" "${command[@]}" "-$one" "$path"
      absent spare
    done < <(rows '^(output|folder)$')
  done < <(rows '^output$')
done
check "every tool was asked" test "$tools" -ge 10
finish
