// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/photogrammetric_types.h>

namespace pcl_als {

/// Reads / writes camera.json: focal_length_mm, principal_point_mm, pixel_size_mm with
/// image_size_px, or image_size_mm, and distortion (k1_per_mm2, k2_per_mm4, k3_per_mm6, p1_per_mm,
/// p2_per_mm). InputError names file and key, also of a distortion that no camera has.
FrameCamera readCamera(const std::filesystem::path& path);
void writeCamera(const std::filesystem::path& path, const FrameCamera& camera);

/// Reads / writes exterior orientations: CSV image,x,y,z,omega,phi,kappa[,sigma_position]
/// [,sigma_angle] (metres, degrees); standard deviations may be empty. InputError names file, line
/// and column.
std::vector<ImageOrientation> readImages(const std::filesystem::path& path);
void writeImages(const std::filesystem::path& path, const std::vector<ImageOrientation>& images);

/** \brief Reads / writes image coordinates: CSV image,kind,feature,x,y[,sigma], kind point or
 * line, coordinates in the unit of the camera's file (px or mm).
 *
 * InputError for a place outside the image, a point that is measured twice in an image, and where
 * all places together cover so little of the images that their unit is another one.
 * \param sigma of records without one, unit of the file; 0: 0.5 px or 0.003 mm
 */
std::vector<ImageMeasurement> readMeasurements(const std::filesystem::path& path,
                                               const FrameCamera& camera, double sigma);
void writeMeasurements(const std::filesystem::path& path, const FrameCamera& camera,
                       const std::vector<ImageMeasurement>& measurements);

/** \brief Reads / writes lines of the ground: CSV id[,kind],x1,y1,z1,x2,y2,z2 (metres) with
 * standard deviations across the line: sigma, or sigma_plan_1, sigma_height_1, sigma_plan_2,
 * sigma_height_2 (metres) and their correlations r_p1h1, r_p1p2, r_p1h2, r_h1p2, r_h1h2, r_p2h2;
 * strips (separated by blanks).
 *
 * A path that ends in .geojson is written as GeoJSON (in the coordinates of the survey, with a crs
 * member where \a crs is an EPSG code) and not read.
 */
std::vector<ObjectLine> readLines(const std::filesystem::path& path);
void writeLines(const std::filesystem::path& path, const std::vector<ObjectLine>& lines,
                const std::string& crs = {});

/// ridge, valley, eave; empty: unknown.
std::string nameOf(ObjectLine::Kind kind);

}  // namespace pcl_als
