#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# cluster.sh BIN_DIR FOLDER JOB…: time and memory of jobs (apply, calibrate, check, intensity,
# classify) in 1, 2 and 4 processes of one thread, and in one process of two threads, on the block
# that pcl_als_simulate wrote into FOLDER/block.
# cluster.sh kill BIN_DIR FOLDER: kills a random process of pcl_als_apply at 20 random moments of a
# run on the files in FOLDER/files (copies, no links), and continues the job.
set -uo pipefail
export LC_ALL=C OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none  # threads of a process on several processors

# Of a command in N processes of T threads: elapsed seconds; the largest processor time and memory
# of a process; whether the outputs are those of the first run, byte for byte. On a machine with
# other work the processor time is what can be compared.
measure() {  # N T JOB ARG…
  local n=$1 t=$2 job=$3 start
  shift 3
  rm -rf out use.txt && mkdir out
  start=$(date +%s.%N)
  mpirun -n "$n" /usr/bin/time -a -o use.txt -f '%U %S %M' "$bin/pcl_als_$job" "$@" \
    -threads "$t" >out.txt 2>err.txt || echo "$job: exit status $?, see err.txt"
  local end sums
  end=$(date +%s.%N)
  sums=$(cd out && find . -type f -print0 | sort -z | xargs -0 md5sum | md5sum)
  [[ $n$t == 11 ]] && first=$sums
  awk -v job="$job" -v n="$n" -v t="$t" -v seconds="$(echo "$end - $start" | bc)" \
    -v same="$([[ $sums == "$first" ]] && echo equal || echo different)" '
    /^[0-9]/ { used = $1 + $2; all += used; if (used > most) most = used; if ($3 > kb) kb = $3 }
    END { printf "%-10s %d x %d  %7.1f s elapsed  %7.1f s of a process  %7.1f s of all  %6.0f MB" \
          "  outputs %s\n", job, n, t, seconds, most, all, kb / 1024, same }' use.txt
}

# seconds of a command
duration() {
  local start
  start=$(date +%s.%N)
  "$@" >out.txt 2>err.txt
  echo "$(date +%s.%N) - $start" | bc
}

kill_loop() {
  local bin=$1 folder=$2 hit=0 status pid left=0 wrong=0 whole
  cd -- "$folder" || exit 1
  args=(files/*.las -trajectory block/trajectory.csv -bias boresight_roll=100 -threads 1)
  rm -rf whole
  whole=$(duration mpirun -n 3 "$bin/pcl_als_apply" "${args[@]}" -corrected whole)
  ls whole/*.las >/dev/null || { cat err.txt; exit 1; }
  echo "uninterrupted: $whole s"
  printf '#!/bin/bash\necho $$ >pid.$OMPI_COMM_WORLD_RANK\nexec "$@"\n' >rank.sh
  chmod +x rank.sh
  while ((hit < 20)); do
    rm -rf killed pid.*
    mpirun -n 3 ./rank.sh "$bin/pcl_als_apply" "${args[@]}" -corrected killed -resume \
      >out.txt 2>err.txt &
    local job=$!
    sleep "$(echo "scale=3; $whole * $RANDOM / 32768" | bc)"
    pid=pid.$((RANDOM % 3))
    until [[ -s $pid ]]; do sleep 0.01; done
    kill -9 "$(<$pid)" 2>/dev/null
    wait $job
    status=$?
    ((status != 0)) || continue  # it had ended before
    hit=$((hit + 1))
    for file in killed/*.las; do
      [[ -e $file ]] && ! cmp -s "$file" "whole/${file##*/}" && wrong=$((wrong + 1))
    done
    local complete=$(ls killed 2>/dev/null | grep -c 'las$')
    local partial=$(find killed -name '*.partial' 2>/dev/null | wc -l)
    mpirun -n 3 "$bin/pcl_als_apply" "${args[@]}" -corrected killed -resume >out.txt 2>err.txt
    local again=$?
    diff -r -x .pcl_als_resume whole killed >/dev/null || wrong=$((wrong + 1))
    left=$(find killed -name '*.partial' | wc -l)
    echo "$hit: ${pid#pid.} killed, status $status, $complete complete, $partial temporary;" \
      "resumed: status $again, $left temporary, $wrong wrong so far"
  done
}

if [[ $1 == kill ]]; then
  kill_loop "$2" "$3"
  exit
fi
bin=$1 folder=$2
cd -- "$folder" || exit 1
strips=(block/strip*.las)
shift 2
for job in "$@"; do
  case $job in
    apply) args=("${strips[@]}" -corrected out -trajectory block/trajectory.csv
      -bias boresight_roll=100,range_bias=0.1) ;;
    calibrate) args=("${strips[@]}" -trajectory block/trajectory.csv -output out/calibration.json) ;;
    check) args=("${strips[@]}" -output out/quality.json) ;;
    intensity) args=("${strips[@]}" -corrected out -trajectory block/trajectory.csv
      -estimate strip_gains) ;;
    classify) args=("${strips[@]}" -training block/training.csv -cell 1 -output out/map.tif) ;;
  esac
  for run in 1x1 1x2 2x1 4x1; do
    measure "${run%x*}" "${run#*x}" "$job" "${args[@]}"
  done
done
