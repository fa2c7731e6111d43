#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# stable.sh RESULT.json: the result without what names files.
sed -e '/"inputs": \[/,/\]/d' -- "$1"
