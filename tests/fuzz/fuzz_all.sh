#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# fuzz_all.sh BIN_DIR WORK_DIR SECONDS [ROUNDS] [JOBS]: every fuzzer in BIN_DIR for SECONDS each, ROUNDS times (1),
# JOBS at a time (1), on the corpora WORK_DIR/corpus/TARGET, which grow. Inputs with findings are in
# WORK_DIR/findings, logs in WORK_DIR/logs. Prints executions and coverage by target.
set -uo pipefail
export LC_ALL=C
(($# >= 3)) || { sed -n '5,7s/^# //p' "$0"; exit 1; }
bin=$1 work=$2 seconds=$3 rounds=${4:-1} jobs=${5:-1}
mkdir -p "$work/findings" "$work/logs" "$work/corpus" "$work/tmp"
for writer in "$bin"/write_*_seeds; do
  "$writer" "$work/seeds" || exit
done

fuzz() {  # FUZZER ROUND: one run
  local target=${1##*/fuzz_}
  mkdir -p "$work/corpus/$target"
  TMPDIR=$work/tmp "$1" "$work/corpus/$target" "$work/seeds/$target" -max_total_time="$seconds" -timeout=120 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$work/findings/$target." \
    >"$work/logs/$target.$2.log" 2>&1 || echo "$target, round $2: see $work/logs/$target.$2.log"
}
export -f fuzz
export work seconds
for ((round = 1; round <= rounds; ++round)); do
  printf '%s\0' "$bin"/fuzz_* | xargs -0 -P "$jobs" -I{} bash -c 'fuzz {} '"$(date +%s)"
done

printf '%-20s %14s %10s %10s %8s\n' target executions edges features inputs
for fuzzer in "$bin"/fuzz_*; do
  target=${fuzzer##*/fuzz_}
  awk -v target="$target" '
    /^stat::number_of_executed_units/ { executions += $2 }
    { for (i = 1; i < NF; ++i) { if ($i == "cov:" && $(i + 1) > cov) cov = $(i + 1)
        if ($i == "ft:" && $(i + 1) > ft) ft = $(i + 1)
        if ($i == "corp:") corpus = $(i + 1) } }
    END { printf "%-20s %14d %10d %10d %8s\n", target, executions, cov, ft, corpus }' "$work/logs/$target".*.log
done
