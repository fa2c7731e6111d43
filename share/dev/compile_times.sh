#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/compile_times.sh [-s N] [-l] [REGEX]: CPU seconds that the compiler needs for the objects
# whose path in the build folder matches (default: all), one after the other and without ccache, then
# the sums per folder. The build folder must be configured and, where precompiled headers are used,
# have been built.
#   -s N  only every Nth object (a sample); the sums are those of the sample
#   -l    preprocessed lines in place of seconds (needs seconds, not minutes)
source "$(dirname -- "${BASH_SOURCE[0]}")/../packages.sh"
every=1 lines=0
while getopts s:l option; do
  case $option in
    s) every=$OPTARG ;;
    l) lines=1 ;;
    *) exit 1 ;;
  esac
done
shift $((OPTIND - 1))
regex=${1:-.}
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
commands=$pcl_als_root/share/dev/compile_commands.awk
cd -- "$pcl_als_build"
awk -f "$commands" compile_commands.json | { grep -E "^[^	]*($regex)" || true; } |
  awk -v every="$every" 'NR % every == 0' >"$scratch/commands"

# measure COMMAND: CPU seconds of the compiler, or lines that it reads.
measure() {
  local command=$1
  if ((lines)); then
    command=$(sed -E 's/ -o [^ ]+ -c / -E -P /; s/ -Winvalid-pch//; s/ -include [^ ]*cmake_pch.hxx//' <<<"$command")
    eval "$command" 2>/dev/null | wc -l
    return
  fi
  command=$(sed -E "s# -o [^ ]+ # -o $scratch/object.o #" <<<"$command")
  local TIMEFORMAT='%U %S'
  { time eval "$command" 2>"$scratch/errors"; } 2>"$scratch/time" || { cat "$scratch/errors" >&2; return 1; }
  awk '{ printf "%.2f\n", $1 + $2 }' "$scratch/time"
}

while IFS=$'\t' read -r object command; do
  printf '%s\t%s\n' "$(measure "$command" </dev/null)" "$(sed -E 's#CMakeFiles/##' <<<"$object")"
done <"$scratch/commands" | tee "$scratch/result" | awk -F '\t' '{ printf "%9s  %s\n", $1, $2; fflush() }'

echo "Sums:"
awk -F '\t' '{
    split($2, part, "/")
    folder = part[1] "/" part[2]
    sum[folder] += $1
    count[folder]++
    all += $1
  }
  END {
    for (folder in sum) printf "%9.1f  %4d objects  %s\n", sum[folder], count[folder], folder | "sort -rn"
    close("sort -rn")
    printf "%9.1f  %4d objects  all\n", all, NR
  }' "$scratch/result"
