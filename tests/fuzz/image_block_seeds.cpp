// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_seeds.h"

namespace pcl_als::fuzz {

std::vector<std::string> cameraSeeds() {
  return {R"({"format": "pcl_als camera", "version": 1, "name": "c", "focal_length_mm": 100.5,
"principal_point_mm": [0.021, -0.013], "pixel_size_mm": 0.006, "image_size_px": [9000, 6732],
"distortion": {"k1_per_mm2": 2e-6, "k2_per_mm4": -6e-10, "k3_per_mm6": 0, "p1_per_mm": 1e-7}})",
          R"({"format": "pcl_als camera", "focal_length_mm": 50, "image_size_mm": [36, 24]})"};
}

std::vector<std::string> imageSeeds() {
  return {
      "image,x,y,z,omega,phi,kappa,sigma_position,sigma_angle\n"
      "I1,699552.5,5659570.3,2004.02,0.669,0.593,1.14,,\n"
      "I2,699552.2,5659712.9,1998.76,0.93,-0.52,179.98,0.05,0.002\n",
      "image;x;y;z;omega;phi;kappa\nI1;1;2;3;0;0;0\n"};
}

std::vector<std::string> imageCoordinateSeeds() {
  return {
      "image,kind,feature,x,y,sigma\nI1,point,T1,-20.5,19.1,0.003\n"
      "I1,line,R1,3.25,-18.5,\nI1,line,R1,4.25,-18.1,\nI2,point,T1,21,5,0.003\n",
      "image,kind,feature,x,y\nI1,point,T1,-20.5,19.1\n"};
}

std::vector<std::string> objectLineSeeds() {
  return {
      "id,kind,x1,y1,z1,x2,y2,z2,sigma_plan_1,sigma_height_1,sigma_plan_2,sigma_height_2,"
      "r_p1h1,r_p1p2,r_p1h2,r_h1p2,r_h1h2,r_p2h2,strips\n"
      "L1,ridge,10.5,20.5,5.25,22.5,21,5.5,0.02,0.01,0.02,0.01,0,0.9,0,0,0.9,0,1 4\n",
      "id,x1,y1,z1,x2,y2,z2,sigma\nL1,0,0,0,9,1,0,0.05\n"};
}

}  // namespace pcl_als::fuzz
