#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# programs.sh SOURCE_DIR: every program that the scripts of the demo and of the tests call is part of
# every Debian (packages marked essential), of a package that is listed in share/packages.sh or that
# one of these depends on, or looked for with command -v in the script (tests/mpi is run only where
# MPI is asked for). A machine with many packages finds here what a bare one lacks; a program that
# this machine lacks is not seen here, but its script fails.
set -euo pipefail
export LC_ALL=C
cd -- "$1"
command -v dpkg >/dev/null || { echo "SKIPPED: no Debian system"; exit 0; }
source share/packages.sh

# called SCRIPT…: words where a command begins, without comments and what is in single quotes (awk, perl).
called() {
  perl -0777 -ne '
    s/\\\n/ /g; s/^\s*#.*$//mg; s/\s#\s.*$//mg; s/\b(?:eval|sh -\w*c) \x27([^\x27]*)\x27/; $1;/g;
    s/(\x27[^\x27]*\x27)|("(?:[^"\\]|\\.)*")/defined $1 ? "\x27\x27" : $2/gse; s/\$?\(\([^\n]*?\)\)//g;
    my $begin = qr/(?:^|[|;&({!`]|\$\(|\b(?:then|else|elif|do|if|while|until|xargs|exec|sudo|env|time)\b)/m;
    print "$ARGV\t$1\n" while /$begin[ \t]*(?:-[^ ]+[ \t]+|\w+=\S*[ \t]+)*([a-z][\w.+-]*)(?=[\s;|&)]|$)/mg' "$@" | sort -u
}

# with_dependencies PACKAGE…: the packages and what they depend on, of those that are installed.
with_dependencies() {
  local -A seen=()
  local package queue=("$@")
  while ((${#queue[@]})); do
    for package in "${queue[@]}"; do seen[$package]=1; done
    mapfile -t queue < <(dpkg-query -W -f '${Depends},${Pre-Depends}\n' "${queue[@]}" 2>/dev/null |
      tr ',|' '\n\n' | sed 's/^ *//; s/[ (:].*//; /^$/d' | sort -u |
      while read -r package; do [[ -v "seen[$package]" ]] || echo "$package"; done)
  done
  printf '%s ' "${!seen[@]}"
}

mapfile -t calls < <(find share/demo share/packages.sh share/doc tests .ci -type f \( -name '*.sh' -o -name run \) \
  -not -path 'tests/benchmarks/*' -not -path 'tests/mpi/*' -exec bash -c "$(declare -f called)"'; called "$@"' bash {} +)
declare -A file=()  # by program; without those of the shell and of other machines
for program in $(printf '%s\n' "${calls[@]#*$'\t'}" | sort -u); do
  [[ $(type -t "$program") != file ]] || file[$program]=$(readlink -f -- "$(type -P "$program")")
done
# A search reads the lists of all packages, so there is one for all files. Older packages have their
# files in /bin, which is a link to /usr/bin.
declare -A package=()  # by file, without /usr
while IFS=$'\t' read -r name path; do package[${path#/usr}]=$name; done < <(
  dpkg-query -S "${file[@]}" "${file[@]#/usr}" 2>/dev/null | sed -nE 's/^([^ :,]+)[^ ]*: (.*)$/\1\t\2/p')
listed=" $(with_dependencies "${pcl_als_packages_build[@]%%:*}" "${pcl_als_packages_test[@]%%:*}")"
listed+=" $(dpkg-query -W -f '${Essential} ${Package}\n' | sed -n 's/^yes //p' | tr '\n' ' ')"
breaches=0
for call in "${calls[@]}"; do
  script=${call%%$'\t'*} program=${call#*$'\t'}
  [[ -v "file[$program]" ]] || continue
  path=${file[$program]#/usr}
  name=${package[$path]:-}
  [[ -n $name && $listed != *" $name "* ]] || continue
  grep -qE "(command -v|type -P) $program\b" "$script" && continue
  echo "$script: calls $program of $name, which share/packages.sh does not list"
  breaches=$((breaches + 1))
done
((breaches == 0)) || exit 1
echo "${#file[@]} programs are in every Debian or in share/packages.sh."
