# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# cmake -DCALIBRATION=calibration.json -DTRUTH=truth.json -DOUTPUT=table.tsv -P summary.cmake: what
# the demo's tables show, one record per line, fields parted by tabs. CMake reads JSON and is there.
file(READ ${CALIBRATION} calibration)
file(READ ${TRUTH} truth)
string(ASCII 9 tab)
set(table "")

macro(add_record)
  list(JOIN record "${tab}" line)
  string(APPEND table "${line}\n")
endmacro()

foreach(name IN ITEMS lever_arm_x lever_arm_y lever_arm_z boresight_pitch boresight_roll
        boresight_heading range_bias scan_angle_scale)
  set(record parameter ${name})
  foreach(key IN ITEMS unit status bias std)
    string(JSON value GET "${calibration}" instrument parameters ${name} ${key})
    list(APPEND record ${value})
  endforeach()
  # truth.json gives the unit with the name; what it does not mention is zero.
  set(true_value 0)
  foreach(key IN ITEMS ${name} ${name}_arcsec ${name}_m)
    string(JSON value ERROR_VARIABLE missing GET "${truth}" bias ${key})
    if(NOT missing)
      set(true_value ${value})
    endif()
  endforeach()
  list(APPEND record ${true_value})
  add_record()
endforeach()

function(add_fits array kind first_key second_key)
  string(JSON count LENGTH "${calibration}" report ${array})
  if(count EQUAL 0)
    return()
  endif()
  math(EXPR last "${count} - 1")
  foreach(i RANGE ${last})
    set(record ${kind})
    foreach(key IN ITEMS ${first_key} ${second_key} rms_before_m rms_after_m mean_before_m mean_after_m)
      string(JSON value GET "${calibration}" report ${array} ${i} ${key})
      list(APPEND record ${value})
    endforeach()
    add_record()
  endforeach()
  set(table "${table}" PARENT_SCOPE)
endfunction()
add_fits(pairs pair a b)
add_fits(control control strip points)
file(WRITE ${OUTPUT} "${table}")
