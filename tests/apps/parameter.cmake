# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# cmake -DJSON=calibration.json -DNAME=boresight_roll -DKEY=bias -P parameter.cmake: prints one value.
file(READ ${JSON} json)
string(JSON value GET "${json}" instrument parameters ${NAME} ${KEY})
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${value}")
