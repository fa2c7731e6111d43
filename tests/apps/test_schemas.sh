#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# Result files satisfy their schemas, and damaged ones do not.
# shellcheck source=tests/apps/tool_test.sh
source "$(dirname -- "$0")/tool_test.sh"
schemas=$here/../../share/schema
python=$(type -ap python3 | while IFS= read -r p; do
  "$p" -c 'import jsonschema' 2>/dev/null && { echo "$p"; break; }
done)
[[ -n $python ]] || { echo "SKIPPED: test_schemas needs python3-jsonschema"; exit 77; }

# valid SCHEMA FILE: whether the file satisfies the schema, itself a valid one.
valid() {
  "$python" - "$schemas/$1.schema.json" "$2" <<'PYTHON' >out.txt 2>&1
import json, sys
import jsonschema
schema, result = (json.load(open(name, encoding="utf-8")) for name in sys.argv[1:])
jsonschema.Draft202012Validator.check_schema(schema)
errors = list(jsonschema.Draft202012Validator(schema).iter_errors(result))
for error in errors:
    print("/".join(map(str, error.absolute_path)), error.message[:300])
sys.exit(1 if errors else 0)
PYTHON
}

strips=("$block"/strip?.las)
flight=(-trajectory "$block/trajectory.csv" -control "$block/control.csv")
run calibrate "${strips[@]}" "${flight[@]}" -output calibration.json
run calibrate "${strips[@]}" "${flight[@]}" -prior calibration.json -output prior.json
run check "${strips[@]}" "${flight[@]}" -before "$block" -output quality.json
printf 'is,a,b\na,40,2\nb,3,50\n' >matrix.csv
printf 'is,a,b\na,38,4\nb,3,50\n' >other.csv
"$bin/las_waveforms" 9 waves.las
run waveform waves.las echoes.las -pulse_width 4.8 -output waveform.json
run accuracy matrix.csv -compare other.csv -output accuracy.json

check "calibration.json has its schema" valid calibration calibration.json
check "a calibration with a prior has its schema" valid calibration prior.json
check "quality.json has its schema" valid quality quality.json
check "accuracy.json has its schema" valid accuracy accuracy.json
check "waveform.json has its schema" valid waveform waveform.json

sed 's/"boresight_roll": {/"boresight_rol": {/' calibration.json >damaged.json
check "a calibration without roll has not" eval '! valid calibration damaged.json'
sed 's/"converged": true/"converged": 1/' calibration.json >damaged.json
check "a number is no truth value" eval '! valid calibration damaged.json'
sed 's/"format": "pcl_als quality"/"format": "other"/' quality.json >damaged.json
check "another format is none" eval '! valid quality damaged.json'
finish
