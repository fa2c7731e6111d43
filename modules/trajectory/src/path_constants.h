// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {

// Constants of the reconstruction of paths from points; the module's page gives their sources.

inline constexpr double kAcross = 0.01;  // m, standard deviation of a return across, at the start
inline constexpr double kLeastAcross = 1e-4;      // m
inline constexpr double kAgility = 0.3;           // m/s^2 per sqrt(Hz), accelerations, at the start
inline constexpr double kAccelerationTime = 5.0;  // s, correlation time of accelerations
inline constexpr double kRough = 0.010;     // m, rough movements, such as errors of a trajectory
inline constexpr double kPriorRough = 3.0;  // values that this counts
inline constexpr double kLeastRough = 1e-5, kMostRough = 0.3;       // m
inline constexpr double kRoughTime = 10.0;                          // s, their correlation time
inline constexpr double kLeastAgility = 0.01, kMostAgility = 10.0;  // the same, limits
inline constexpr double kRoll = 1.0 * kRadiansPerDegree;  // rad, of the roll in recorded angles
inline constexpr double kLeastRoll = 0.005 * kRadiansPerDegree;  // rad
inline constexpr double kLeastPitch = 0.2 * kRadiansPerDegree;   // rad, of a calm flight
inline constexpr double kMostAttitude = 5.0 * kRadiansPerDegree;
inline constexpr double kAttitudeTime = 3.0;  // s, correlation time of roll and pitch
inline constexpr double kAngleNoise =
    0.15 * kRadiansPerDegree;  // rad, mean of a class, at the start
inline constexpr double kLeastAngleNoise = 0.02 * kRadiansPerDegree;
inline constexpr double kScale = 0.005;    // 1, prior of recorded angles' scale
inline constexpr double kSkewShare = 0.5;  // 1, uncertainty of the effect of skewed scan lines
inline constexpr double kOffset = 1.0 * kRadiansPerDegree;       // rad, prior of their offset
inline constexpr double kTruncation = 0.25 * kRadiansPerDegree;  // rad, of whole degrees
inline constexpr double kPitch = 3.0 * kRadiansPerDegree;        // rad, prior of the mean pitch
inline constexpr double kPitchMotion =
    1.5 * kRadiansPerDegree;                                    // rad, about its mean, at the start
inline constexpr double kAlongNoise = 1.5 * kRadiansPerDegree;  // rad, of a second, at the start
inline constexpr double kMiddleTime = 1.0;                      // s, of a mean of points
inline constexpr double kRegular = 1e-10;                       // 1/m^2, prior of a coefficient
inline constexpr double kSlowest = 0.5;         // m/s, speed from which there is a course
inline constexpr double kSlopeTolerance = 0.3;  // 1, heights from angles over that of rays
inline constexpr double kRaysSuffice = 0.005;   // std over height: recorded angles are not used
inline constexpr double kSharedTime = 0.5;      // s, within which rays may share errors
inline constexpr double kFewestBins = 8.0;      // such times that are needed to see it
inline constexpr double kJitterTime = 0.1;      // s, within which fast movements are one
inline constexpr int kJitterSteps = 6;
inline constexpr double kSignificant = 2.5;  // standard deviations
inline constexpr double kLeastFree = 0.25;   // 1, least share of them that is redundant
inline constexpr int kRobustSteps = 12, kMostSteps = 80;
inline constexpr double kConverged = 1e-3;          // m, change of a coefficient
inline constexpr double kConvergedVariance = 0.01;  // 1, relative change
inline constexpr double kNormHuber = 2.5;           // standard deviations of a norm
inline constexpr double kNormRejection = 5.0;
inline constexpr double kPriorRays = 4.0;   // rays that the value at the start counts
inline constexpr double kManyRays = 100.0;  // rays from which on it does not
inline constexpr std::size_t kFewestRaysOfLine = 8;
inline constexpr double kRegularLine = 1e-12;  // 1, reciprocal condition of its equations
inline constexpr double kBend = 2.0;           // m/s^2, acceleration beside it that is allowed for
inline constexpr double kStraightTime = 5.0;   // s, of a pass that is compared with it
inline constexpr double kBeyondLine = 3.0;     // standard deviations from it
inline constexpr double kFastestFlight = 250.0;  // m/s, of aircraft that survey
inline constexpr double kSteepestFlight = 50.0;  // m/s, climb
inline constexpr double kMostMissing = 0.5;      // 1, share of the rays beside a path of angles
inline constexpr double kMostAngleNoise = 1.0 * kRadiansPerDegree;  // rad, of recorded angles

}  // namespace pcl_als::detail
