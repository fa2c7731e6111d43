#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# test_processes.sh BIN_DIR SCRATCH_DIR folder|mpi: jobs in 1, 2 and 4 processes, which exchange
# messages in a folder or by MPI, give the files of a job without processes; a process that fails
# ends the job; by MPI, -resume completes one of which a process is killed.
# shellcheck source=tool_test.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/tool_test.sh"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none  # containers may not allow it
export OMPI_MCA_rmaps_base_oversubscribe=1
flight=$block/trajectory.csv
strips=("$block"/strip[1-5].las)
kind=$3

among_mpi() {
  local n=$1 verb=$2
  shift 2
  mpirun -n "$n" "$bin/pcl_als_$verb" "$@" -threads 1 >out.txt 2>err.txt </dev/null || status=$?
}

# The first process ends with the status of the job, as do the others; nothing is left of it.
among_folder() {
  local n=$1 verb=$2 folder k others=() one
  shift 2
  folder=$(mktemp -d "$scratch/exchange.XXXXXX")
  for ((k = 2; k <= n; ++k)); do
    "$bin/pcl_als_$verb" "$@" -threads 1 -process "$k/$n" -exchange "$folder" \
      >"$folder.out$k" 2>"$folder.err$k" </dev/null &
    others+=($!)
  done
  "$bin/pcl_als_$verb" "$@" -threads 1 -process "1/$n" -exchange "$folder" >out.txt 2>err.txt \
    </dev/null || status=$?
  for one in "${others[@]}"; do
    local other=0
    wait "$one" || other=$?
    [[ $other == "$status" ]] || failed "$verb: another process ended with $other, not $status"
  done
  [[ -z $(cat "$folder".out*) ]] || failed "$verb: another process than the first one prints"
  [[ -z $(ls "$folder") ]] || failed "$verb: messages are left"
  checks=$((checks + 2 + ${#others[@]}))
}

among() {  # N VERB ARG…: the tool in N processes; sets $status, out.txt, err.txt
  status=0
  "among_$kind" "$@"
}

listed() {  # FOLDER: the names in the lists of files that were written there
  find "$1" -name .pcl_als_files -exec grep -hv '^#' {} + | cut -d ' ' -f 3 | sort -u
}

# compare WHAT VERB STATUS ARG…: the job in 1, 2 and 4 processes gives the files of one without
# -process and mpirun, each in a folder of its own. What depends on time and memory is not compared.
compare() {
  local what=$1 verb=$2 wanted=$3 n
  shift 3
  for n in one 1 2 4; do
    mkdir -p "$what/$n"
    cd "$what/$n" || exit 1
    if [[ $n == one ]]; then run "$verb" "$@"; else among "$n" "$verb" "$@"; fi
    mv out.txt err.txt ../..
    cd ../.. || exit 1
    checks=$((checks + 3))
    [[ $status == "$wanted" ]] || failed "$what in $n processes: exit status $status, not $wanted"
    diff -r -I '"milliseconds":' -I 'memory_mb":' -I 'Made by' -I '[|>] *threads *[<|]' -x run.csv \
      -x .pcl_als_files "$what/one" "$what/$n" >diff.txt || {
      failed "$what in $n processes: other results"
      head -n 5 diff.txt
    }
    # Lists of written files are in the order of their completion, with digests of their times.
    diff <(listed "$what/one") <(listed "$what/$n") >diff.txt ||
      failed "$what in $n processes: other files are listed"
  done
}

biases=boresight_roll=100,boresight_heading=-60,range_bias=0.1
compare apply apply 0 "${strips[@]}" -corrected . -trajectory "$flight" -bias $biases
compare calibrate calibrate 0 "${strips[@]}" -trajectory "$flight" -control "$block/control.csv" \
  -output calibration.json -corrected . -report report
compare calibrate_reconstructed calibrate 0 "${strips[@]}" -trajectory reconstruct \
  -control "$block/control.csv" -output calibration.json -force
compare calibrate_positions calibrate 0 "${strips[@]}" -trajectory "$flight" \
  -model quasi_rigorous -output calibration.json -force
compare check check 0 "${strips[@]}" -trajectory "$flight" -control "$block/control.csv" \
  -output quality.json
compare intensity intensity 0 "${strips[@]}" -corrected . -trajectory "$flight" \
  -estimate strip_gains -output intensity.json
compare classify classify 0 "${strips[@]}" -training "$block/training.csv" -cell 2 -tile 64 \
  -output landcover.tif -grids grids.tif -classified .

# A damaged file ends the job with the message of one process, and no temporary is left.
mkdir damaged
head -c 3000 "$block/strip3.las" >damaged/strip9.las
among 3 apply "${strips[@]}" damaged/strip9.las -corrected failed -trajectory "$flight" \
  -bias $biases
checks=$((checks + 3))
[[ $status == 2 ]] || failed "a damaged file: exit status $status"
[[ $(grep -c '^pcl_als_apply: damaged/strip9.las: ' err.txt) == 1 ]] ||
  failed "a damaged file: not one message"
compgen -G "failed/*.partial" >/dev/null && failed "a damaged file: temporaries are left"

# So does wrong usage, which all processes find.
among 3 apply -nonsense
checks=$((checks + 1))
[[ $status == 1 && $(grep -c '^pcl_als_apply: ' err.txt) == 1 ]] || failed "wrong usage"

if [[ $kind == folder ]]; then
  refused() {  # STATUS PATTERN ARG…
    local wanted=$1 pattern=$2
    shift 2
    run apply "${strips[@]}" -corrected refused -trajectory "$flight" -bias $biases "$@"
    checks=$((checks + 1))
    [[ $status == "$wanted" ]] && grep -q "$pattern" err.txt || failed "not refused: $*"
  }
  for place in 0/2 3/2 2 a/b 1/2x -1/2; do
    refused 1 'such as 2/4' -process=$place -exchange messages
  done
  refused 1 'process' -process 1/2
  refused 1 'exchange' -exchange messages
  refused 2 'is no folder' -process 1/2 -exchange "$flight"
  mkdir stale
  touch stale/process-1
  refused 2 'of another run' -process 1/2 -exchange stale
  # Processes with different options do not wait for each other.
  "$bin/pcl_als_apply" "${strips[@]}" -corrected refused -trajectory "$flight" -threads 1 \
    -bias boresight_roll=7 -process 2/2 -exchange different 2>second.txt &
  refused 1 'process 2 has other options' -process 1/2 -exchange different -threads 1
  other=0
  wait $! || other=$?
  checks=$((checks + 2))
  [[ $other == 1 ]] || failed "other options: status $other of the second process"
  grep -q 'process 2 has other options' second.txt || failed "other options: no message"
  finish
  exit
fi

# A process that is killed while files are written: the others end and remove their temporaries;
# -resume keeps what is complete and gives the files of an uninterrupted job.
mkdir many
for i in {1..12}; do
  for strip in 1 2 3; do ln "$block/strip$strip.las" "many/$i-$strip.las"; done
done
cat >rank.sh <<'EOT'
#!/usr/bin/env bash
echo $$ >"pid.$OMPI_COMM_WORLD_RANK"
exec "$@"
EOT
chmod +x rank.sh
many=(many/*.las -trajectory "$flight" -bias $biases)
run apply "${many[@]}" -corrected uninterrupted -threads 1
status=0
mpirun -n 3 ./rank.sh "$bin/pcl_als_apply" "${many[@]}" -corrected killed -resume \
  -threads 1 >out.txt 2>err.txt </dev/null &
job=$!
until compgen -G "killed/*.las" >/dev/null || ! kill -0 $job 2>/dev/null; do sleep 0.01; done
kill -9 "$(<pid.1)"
wait $job || status=$?
checks=$((checks + 3))
((status != 0)) || failed "a killed process: exit status 0"
for file in killed/*.las; do
  cmp -s "$file" "uninterrupted/${file##*/}" || failed "a killed process: $file is not complete"
done
(($(find killed -name '*.partial' | wc -l) <= 1)) ||
  failed "processes that were not killed left temporaries"
among 2 apply "${many[@]}" -corrected killed -resume
checks=$((checks + 4))
[[ $status == 0 ]] || failed "-resume: exit status $status"
grep -qE '[1-9][0-9]* files? complete from an earlier run' out.txt || failed "-resume: keeps no file"
[[ -z $(find killed -name '*.partial') ]] || failed "-resume: leaves temporaries"
diff -r -x .pcl_als_resume uninterrupted killed >diff.txt || failed "-resume: other results"

# Records are of one command and of the inputs as they were.
checks=$((checks + 3))
among 2 apply "${many[@]}" -corrected killed -resume -keep_uncovered
grep -q 'complete from an earlier run' out.txt && failed "-resume: keeps files of other options"
touch many/1-1.las  # one file of many names
among 2 apply "${many[@]}" -corrected killed -resume -keep_uncovered
grep -q '24 files complete from an earlier run' out.txt ||
  failed "-resume: keeps files whose inputs have changed"
among 2 apply "${many[@]}" -corrected killed -resume -keep_uncovered
grep -q '36 files complete from an earlier run' out.txt || failed "-resume: repeats files"

finish
