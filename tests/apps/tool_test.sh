# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Sourced by the test_*.sh of this folder, which are called as: test_X.sh BIN_DIR SCRATCH_DIR. Gives
# a fresh folder to work in ($scratch, also the current one), the small block of make_block.sh
# ($block), and checks that count failures instead of stopping at the first.
set -uo pipefail
export LC_ALL=C
bin=$1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
scratch=$2/$(basename -- "$0" .sh)
block=$2/block
damage=$bin/las_damage
rm -rf -- "$scratch" && mkdir -p -- "$scratch" && cd -- "$scratch" || exit 1
checks=0 failures=0

failed() {  # WHAT: reports it with the output of the last command
  failures=$((failures + 1))
  echo "FAILED: $1"
  [[ -s out.txt ]] && sed 's/^/  out: /' out.txt
  [[ -s err.txt ]] && sed 's/^/  err: /' err.txt
  return 0
}

run() {  # VERB ARG…: the tool pcl_als_VERB; sets $status, out.txt, err.txt
  local verb=$1
  shift
  status=0
  "$bin/pcl_als_$verb" "$@" >out.txt 2>err.txt </dev/null || status=$?
}

# expect STATUS TEXT VERB ARG…: the tool ends with STATUS. 0: stderr is empty and stdout has TEXT;
# else: stderr is one line that begins with the tool's name and has TEXT (a glob pattern).
expect() {
  local wanted=$1 text=$2 what="pcl_als_${*:3}"
  shift 2
  checks=$((checks + 1))
  run "$@"
  if [[ $status != "$wanted" ]]; then
    failed "$what: exit status $status, not $wanted"
  elif [[ $wanted == 0 ]]; then
    [[ ! -s err.txt ]] || failed "$what: writes to stderr"
    [[ $(<out.txt) == *$text* ]] || failed "$what: stdout lacks '$text'"
  else
    [[ $(wc -l <err.txt) == 1 ]] || failed "$what: stderr is not one line"
    [[ $(<err.txt) == "pcl_als_$1: "*$text* ]] || failed "$what: stderr lacks '$text'"
  fi
}

check() {  # WHAT COMMAND…: the command succeeds
  local what=$1
  shift
  checks=$((checks + 1))
  "$@" >out.txt 2>err.txt || failed "$what"
}

absent() {  # FILE…: none of them is there, nor a temporary of theirs
  local file
  checks=$((checks + 1))
  for file in "$@"; do
    if compgen -G "$file*" >/dev/null; then
      failed "left behind: $(compgen -G "$file*")"
      rm -rf -- "$file"*
    fi
  done
}

# number KEY FIELD FILE: the number of a field of a parameter in a result.
number() {
  awk -v key="\"$1\":" -v field="\"$2\":" '$1 == key { on = 1 }
    on && $1 == field { sub(",", "", $2); print $2; exit }' "$3"
}
# cell FOLDER A B COLUMN: of the pair in FOLDER/pairs.csv
cell() {
  awk -F, -v a="$2" -v b="$3" -v name="$4" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
    $2 == a && $3 == b { print $at[name] }' "$1/pairs.csv"
}
# near A B TOLERANCE: two numbers differ by the tolerance at most
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { exit !(a != "" && b != "" && (a - b) ^ 2 <= t ^ 2) }'; }

finish() {
  echo "$checks checks, $failures failed"
  ((failures == 0))
  exit
}
