// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// class_sites OUT_DIR PER_CLASS FILE…: training.csv and checkpoints.csv from the classes that point
// files were delivered with: middles of cells of 1 m whose points are all ground (2) or all
// building (6). Training comes from every second square of 20 m, check points from the others.
// Vegetation is trained, not checked, on cells of unclassified points with a range of 3 m and a
// third of multiple returns: nobody said what they are.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/io/point_reader.h>

namespace {

struct Cell {
  int points = 0, ground = 0, building = 0, multiple = 0;
  double low = 1e9, high = -1e9;

  std::string name() const {
    if (points < 3) return {};
    if (ground == points) return "ground";
    if (building == points) return "building";
    const bool leafy = ground + building == 0 && high - low > 3.0 && 3 * multiple > points;
    return leafy ? "vegetation" : "";
  }
};

using Cells = std::map<std::pair<long, long>, Cell>;

void read(const std::string& path, Cells& cells) {
  const auto reader = pcl_als::PointReader::open(path);
  pcl_als::PointChunk chunk;
  while (reader->read(chunk))
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      Cell& cell =
          cells[{std::lround(std::floor(chunk.x[i])), std::lround(std::floor(chunk.y[i]))}];
      ++cell.points;
      cell.ground += chunk.classification[i] == 2;
      cell.building += chunk.classification[i] == 6;
      cell.multiple += chunk.number_of_returns[i] > 1;
      cell.low = std::min(cell.low, chunk.z[i]);
      cell.high = std::max(cell.high, chunk.z[i]);
    }
}

void write(const std::filesystem::path& path, const Cells& cells, int per_class, bool training) {
  std::map<std::string, std::vector<std::pair<long, long>>> places;
  for (const auto& [place, cell] : cells) {
    const bool first = ((place.first / 20) + (place.second / 20)) % 2 == 0;
    const std::string name = cell.name();
    if (first == training && !name.empty() && (training || name != "vegetation"))
      places[name].push_back(place);
  }
  std::string text = "x,y,class\n";
  std::mt19937 random(1);
  for (auto& [name, all] : places) {
    std::shuffle(all.begin(), all.end(), random);
    all.resize(std::min<std::size_t>(all.size(), static_cast<std::size_t>(per_class)));
    for (const auto& [x, y] : all)
      text += std::to_string(x) + ".5," + std::to_string(y) + ".5," + name + "\n";
    std::cout << path.string() << ": " << all.size() << " of " << name << "\n";
  }
  pcl_als::AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "class_sites OUT_DIR PER_CLASS FILE…\n";
    return 1;
  }
  Cells cells;
  for (int i = 3; i < argc; ++i) read(argv[i], cells);
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write(folder / "training.csv", cells, std::stoi(argv[2]), true);
  write(folder / "checkpoints.csv", cells, std::stoi(argv[2]), false);
  return 0;
}
