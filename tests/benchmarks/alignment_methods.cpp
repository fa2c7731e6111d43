// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "alignment_methods.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <pcl/features/normal_3d_omp.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef PCL_ALS_SMALL_GICP
#include <small_gicp/registration/registration_helper.hpp>
#endif

namespace pcl_als::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr copyOf(const Points& points) {
  typename pcl::PointCloud<PointT>::Ptr copy(new pcl::PointCloud<PointT>);
  copy->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) (*copy)[i].getVector3fMap() = points[i];
  return copy;
}

void addNormals(const pcl::PointCloud<pcl::PointNormal>::Ptr& cloud, int neighbours, int threads) {
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::PointNormal> estimation(
      static_cast<unsigned>(threads));
  estimation.setInputCloud(cloud);
  estimation.setKSearch(neighbours);
  estimation.setViewPoint(0.0F, 0.0F, 1e4F);
  estimation.compute(*cloud);
}

template <typename Icp, typename CloudPtr>
Alignment finish(Icp& icp, const CloudPtr& source, const CloudPtr& target,
                 Clock::time_point start) {
  icp.setMaxCorrespondenceDistance(1.0);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  typename std::remove_reference_t<decltype(*source)> aligned;
  icp.align(aligned);
  Alignment result;
  result.seconds = secondsSince(start);
  result.motion = icp.getFinalTransformation().template cast<double>();
  result.converged = icp.hasConverged();
  return result;
}

Alignment icpWithNormals(const Points& source, const Points& target, int neighbours, int threads) {
  const auto moving = copyOf<pcl::PointNormal>(source);
  const auto fixed = copyOf<pcl::PointNormal>(target);
  const auto start = Clock::now();
  addNormals(moving, neighbours, threads);
  addNormals(fixed, neighbours, threads);
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setMaximumIterations(50);
  icp.setTransformationEpsilon(1e-10);
  return finish(icp, moving, fixed, start);
}

Alignment generalizedIcp(const Points& source, const Points& target) {
  const auto moving = copyOf<pcl::PointXYZ>(source), fixed = copyOf<pcl::PointXYZ>(target);
  const auto start = Clock::now();
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  return finish(icp, moving, fixed, start);
}

#ifdef PCL_ALS_SMALL_GICP
Alignment smallGicp(const Points& source, const Points& target, double voxel, int threads) {
  const auto start = Clock::now();
  small_gicp::RegistrationSetting setting;
  setting.num_threads = threads;
  setting.downsampling_resolution = voxel;
  const auto found = small_gicp::align(target, source, Eigen::Isometry3d::Identity(), setting);
  Alignment result;
  result.seconds = secondsSince(start);
  result.motion = found.T_target_source.matrix();
  result.converged = found.converged;
  return result;
}
#endif

void writeText(const Points& points, const std::filesystem::path& path) {
  std::ofstream out(path);
  char line[100];
  for (const Eigen::Vector3f& p : points) {
    std::snprintf(line, sizeof line, "%.4f %.4f %.4f\n", p.x(), p.y(), p.z());
    out << line;
  }
}

/// Reads the last four lines with four numbers each in brackets that simpleICP prints.
Eigen::Matrix4d lastMatrix(const std::filesystem::path& log) {
  std::vector<Eigen::RowVector4d> rows;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    Eigen::RowVector4d row;
    const std::size_t bracket = line.find('[');
    if (bracket == std::string::npos) continue;
    if (std::sscanf(line.c_str() + bracket, "[%lf %lf %lf %lf]", &row[0], &row[1], &row[2],
                    &row[3]) == 4)
      rows.push_back(row);
  }
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < 4 && rows.size() >= 4; ++i)
    matrix.row(static_cast<Eigen::Index>(i)) = rows[rows.size() - 4 + i];
  return matrix;
}

/// A program that reads text: reading is in its time. It prints the iteration's own time, too.
Alignment simpleIcp(const Points& source, const Points& target, const std::string& program,
                    int correspondences) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("alignment_methods_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  writeText(target, folder / "fixed.xyz");
  writeText(source, folder / "moving.xyz");
  const std::string command = "\"" + program + "\" -f \"" + (folder / "fixed.xyz").string() +
                              "\" -m \"" + (folder / "moving.xyz").string() + "\" -c " +
                              std::to_string(correspondences) + " -o 1 > \"" +
                              (folder / "log.txt").string() + "\" 2>&1";
  const auto start = Clock::now();
  const int status = std::system(command.c_str());
  Alignment result;
  result.seconds = secondsSince(start);
  result.motion = lastMatrix(folder / "log.txt");
  result.converged = status == 0;
  std::filesystem::remove_all(folder);
  return result;
}

double peakMegabytes(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double cpuSeconds() {
  double seconds = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  long total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

}  // namespace

std::vector<AlignmentMethod> otherMethods(int threads, const std::string& simpleicp) {
  using P = const Points&;
  std::vector<AlignmentMethod> all;
#ifdef PCL_ALS_SMALL_GICP
  all.push_back({"small_gicp GICP", [=](P a, P b) { return smallGicp(a, b, 0.25, threads); }});
#endif
  for (const int k : {15, 45})
    all.push_back({"PCL ICP with normals, k = " + std::to_string(k),
                   [=](P a, P b) { return icpWithNormals(a, b, k, threads); }});
  all.push_back({"PCL GICP", [](P a, P b) { return generalizedIcp(a, b); }});
  if (!simpleicp.empty())
    for (const int count : {1000, 100000})
      all.push_back({"simpleICP -c " + std::to_string(count),
                     [=](P a, P b) { return simpleIcp(a, b, simpleicp, count); }});
  return all;
}

Alignment runAlone(const AlignmentMethod& method, const Points& source, const Points& target) {
  int channel[2];
  if (pipe(channel) != 0) throw std::runtime_error("no pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    close(channel[0]);
    const double before = residentMegabytes();
    Alignment result = method.align(source, target);
    result.cpu_seconds = cpuSeconds();
    result.megabytes =
        std::max(peakMegabytes(RUSAGE_SELF) - before, peakMegabytes(RUSAGE_CHILDREN));
    const bool written = write(channel[1], &result, sizeof result) == sizeof result;
    _exit(written ? 0 : 1);
  }
  close(channel[1]);
  Alignment result;
  const bool complete = read(channel[0], &result, sizeof result) == sizeof result;
  close(channel[0]);
  waitpid(child, nullptr, 0);
  if (!complete) throw std::runtime_error(method.name + " ended without a result");
  return result;
}

}  // namespace pcl_als::bench
