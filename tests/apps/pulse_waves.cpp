// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// pulse_waves OUT.pls: a PulseWaves file of 200 pulses with 334 echoes, and OUT.wvs.
#include <iostream>

#include "pulse_waves_bytes.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "pulse_waves OUT.pls\n";
    return 1;
  }
  pcl_als::test::SimulatedPulses().make().write(argv[1]);
  return 0;
}
