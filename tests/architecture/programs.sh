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

listed=" $(with_dependencies "${pcl_als_packages_build[@]%%:*}" "${pcl_als_packages_test[@]%%:*}")"
declare -A verdict  # by program: the package that lacks in the lists, or nothing
missing_package() {
  local path package
  path=$(readlink -f -- "$(type -P "$1")")
  package=$(dpkg-query -S "$path" "/usr$path" "${path#/usr}" 2>/dev/null | head -n 1 | cut -d: -f1) || true
  [[ -n $package && $listed != *" $package "* ]] || return 0
  [[ $(dpkg-query -W -f '${Essential}' "$package") == yes ]] || echo "$package"
}
breaches=0
while IFS=$'\t' read -r script program; do
  [[ $(type -t "$program") == file ]] || continue
  [[ -v "verdict[$program]" ]] || verdict[$program]=$(missing_package "$program")
  [[ -n ${verdict[$program]} ]] || continue
  grep -qE "(command -v|type -P) $program\b" "$script" && continue
  echo "$script: calls $program of ${verdict[$program]}, which share/packages.sh does not list"
  breaches=$((breaches + 1))
done < <(find share/demo share/packages.sh share/doc tests .ci -type f \( -name '*.sh' -o -name run \) \
  -not -path 'tests/benchmarks/*' -not -path 'tests/mpi/*' -exec bash -c "$(declare -f called)"'; called "$@"' bash {} +)
((breaches == 0)) || exit 1
echo "${#verdict[@]} programs are in every Debian or in share/packages.sh."
