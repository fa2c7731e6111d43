// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// las_waveforms FORMAT OUT.las: a file of 200 pulses with waveforms in OUT.wdp; every fifth has a
// second echo that is no point.
#include <cstdlib>
#include <iostream>

#include "waveform_file.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "las_waveforms FORMAT OUT.las\n";
    return 1;
  }
  pcl_als::test::waveformFile(std::atoi(argv[1])).write(argv[2]);
  return 0;
}
