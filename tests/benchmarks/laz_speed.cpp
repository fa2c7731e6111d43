// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <vector>

#include <laszip/laszip_api.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/las/laz_point_reader.h>
#include <pcl_als/las/laz_point_writer.h>

// laz_speed REPETITIONS FILE.laz …: time per point of this codec and of LASzip's library.
namespace pcl_als {
namespace {

constexpr std::uint64_t kBlock = 131072;  ///< points per call

double now(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds: of all threads together, of the busier one of two, and by the wall clock.
struct Times {
  double cpu = HUGE_VAL, busier = HUGE_VAL, wall = HUGE_VAL;
};

/// What is measured: in turns, so that other work on the machine meets all of it alike.
struct Task {
  std::function<void()> work;
  Times best;
};

void measure(int repetitions, std::vector<Task>& tasks) {
  for (int i = 0; i < repetitions; ++i) {
    for (Task& task : tasks) {
      const double cpu = now(CLOCK_PROCESS_CPUTIME_ID), caller = now(CLOCK_THREAD_CPUTIME_ID),
                   wall = now(CLOCK_MONOTONIC);
      task.work();
      const double spent = now(CLOCK_PROCESS_CPUTIME_ID) - cpu;
      const double own = now(CLOCK_THREAD_CPUTIME_ID) - caller;
      task.best.cpu = std::min(task.best.cpu, spent);
      task.best.busier = std::min(task.best.busier, std::max(own, spent - own));
      task.best.wall = std::min(task.best.wall, now(CLOCK_MONOTONIC) - wall);
    }
  }
}

/// Nothing but computation, divided between threads: the gain that the machine allows.
void compute(int threads) {
  static volatile double sink = 0.0;
  constexpr int operations = 40000000;
  parallelFor(static_cast<std::size_t>(threads), threads, [&](std::size_t part) {
    double sum = static_cast<double>(part);
    for (int i = 0; i < operations / threads; ++i) sum = std::sqrt(sum + i);
    sink = sum;
  });
}

/// A LAZ file in memory.
class File {
 public:
  explicit File(const std::string& path) : path_(path) {
    std::ifstream stream(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    if (bytes_.size() < 227) throw InputError(path + ": is no LAZ file");
    const bool wide = bytes_[25] >= 4 && number<std::uint64_t>(247) > 0;
    points_.point_count = wide ? number<std::uint64_t>(247) : number<std::uint32_t>(107);
    points_.offset_to_points = number<std::uint32_t>(96);
    points_.file_size = bytes_.size();
    std::size_t at = number<std::uint16_t>(94);
    while (std::strncmp(reinterpret_cast<const char*>(&bytes_[at + 2]), kLazUser, 16) != 0)
      at += 54U + number<std::uint16_t>(at + 20);
    schema_ = LazSchema::parse(&bytes_[at + 54], number<std::uint16_t>(at + 20), path);
  }

  const std::string& path() const { return path_; }
  int format() const { return bytes_[104] & 63; }
  int minor() const { return bytes_[25]; }
  std::uint64_t count() const { return points_.point_count; }
  const LazSchema& schema() const { return schema_; }

  void decode(int threads, std::vector<std::uint8_t>& records) const {
    const auto read = [this](std::uint64_t position, std::size_t bytes, void* out) {
      std::memcpy(out, &bytes_[position], bytes);
    };
    LazPoints points = points_;
    points.threads = threads;
    LazPointReader reader(schema_, read, points, path_);
    records.resize(count() * schema_.recordLength());
    for (std::uint64_t i = 0; i < count(); i += kBlock)
      reader.read(i, std::min(kBlock, count() - i), &records[i * schema_.recordLength()]);
  }

 private:
  template <typename T>
  T number(std::size_t at) const {
    T value;
    std::memcpy(&value, &bytes_[at], sizeof value);
    return value;
  }

  std::string path_;
  std::vector<std::uint8_t> bytes_;
  LazSchema schema_;
  LazPoints points_;
};

/// \param file memory of the file, kept between calls: its pages are not what is measured.
std::size_t encode(const LazSchema& schema, const std::vector<std::uint8_t>& records, int threads,
                   std::vector<std::uint8_t>& file) {
  const auto write = [&file](std::uint64_t position, std::size_t bytes, const void* data) {
    if (file.size() < position + bytes) file.resize(position + bytes);
    std::memcpy(&file[position], data, bytes);
  };
  LazPointWriter writer(schema, write, 0, threads);
  const std::size_t length = schema.recordLength();
  for (std::uint64_t i = 0; i < records.size() / length; i += kBlock)
    writer.write(&records[i * length], std::min(kBlock, records.size() / length - i));
  return writer.finish();
}

void laszipDecode(const File& file, std::vector<laszip_point_struct>* points) {
  laszip_POINTER reader = nullptr;
  laszip_create(&reader);
  laszip_BOOL compressed = 0;
  laszip_open_reader(reader, file.path().c_str(), &compressed);
  laszip_point_struct* point = nullptr;
  laszip_get_point_pointer(reader, &point);
  for (std::uint64_t i = 0; i < file.count(); ++i) {
    laszip_read_point(reader);
    if (points != nullptr) points->push_back(*point);
  }
  laszip_close_reader(reader);
  laszip_destroy(reader);
}

/// \param records of the points, for their extra bytes.
std::size_t laszipEncode(const File& file, const std::vector<laszip_point_struct>& points,
                         const std::vector<std::uint8_t>& records) {
  laszip_POINTER writer = nullptr;
  laszip_create(&writer);
  laszip_header_struct* header = nullptr;
  laszip_get_header_pointer(writer, &header);
  header->version_major = 1;
  header->version_minor = static_cast<laszip_U8>(file.minor());
  header->header_size = file.minor() >= 4 ? 375 : file.minor() == 3 ? 235 : 227;
  header->offset_to_point_data = header->header_size;
  laszip_request_native_extension(writer, 1);
  laszip_set_point_type_and_size(writer, static_cast<laszip_U8>(file.format()),
                                 static_cast<laszip_U16>(file.schema().recordLength()));
  std::stringstream stream(std::ios::in | std::ios::out | std::ios::binary);
  laszip_open_writer_stream(writer, stream, 1, 1);
  laszip_point_struct* point = nullptr;
  laszip_get_point_pointer(writer, &point);
  laszip_U8* const extra_bytes = point->extra_bytes;
  const std::size_t length = file.schema().recordLength();
  const auto extra = static_cast<std::size_t>(point->num_extra_bytes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    *point = points[i];
    point->extra_bytes = extra_bytes;
    if (extra > 0) std::memcpy(extra_bytes, &records[(i + 1) * length - extra], extra);
    laszip_write_point(writer);
  }
  laszip_close_writer(writer);
  laszip_destroy(writer);
  return stream.str().size();
}

void row(const File& file, int repetitions) {
  std::vector<std::uint8_t> records, encoded;
  std::vector<laszip_point_struct> points;
  laszipDecode(file, &points);
  const LazSchema schema = LazSchema::forFormat(file.format(), file.schema().recordLength());
  std::size_t bytes = 0, laszip_bytes = 0;
  std::vector<Task> tasks(8);
  tasks[0].work = [&] { laszipDecode(file, nullptr); };
  tasks[1].work = [&] { file.decode(1, records); };
  tasks[2].work = [&] { file.decode(2, records); };
  tasks[3].work = [&] { laszip_bytes = laszipEncode(file, points, records); };
  tasks[4].work = [&] { bytes = encode(schema, records, 1, encoded); };
  tasks[5].work = [&] { encode(schema, records, 2, encoded); };
  tasks[6].work = [] { compute(1); };
  tasks[7].work = [] { compute(2); };
  file.decode(1, records);
  measure(repetitions, tasks);
  const double unit = 1e9 / static_cast<double>(file.count());
  std::printf("| %s | %d | %llu |", file.path().substr(file.path().rfind('/') + 1).c_str(),
              file.format(), static_cast<unsigned long long>(file.count()));
  for (const std::size_t first : {0U, 3U}) {
    const Times &laszip = tasks[first].best, &one = tasks[first + 1].best,
                &two = tasks[first + 2].best;
    std::printf(" %.0f | %.0f | %.2f | %.2f | %.2f |", laszip.cpu * unit, one.cpu * unit,
                laszip.cpu / one.cpu, one.cpu / two.busier, one.wall / two.wall);
  }
  std::printf(" %.2f | %.3f |\n", tasks[6].best.wall / tasks[7].best.wall,
              static_cast<double>(bytes) / static_cast<double>(laszip_bytes));
  std::fflush(stdout);
}

}  // namespace
}  // namespace pcl_als

int main(int argc, char** argv) {
  std::puts(
      "| file | format | points | decode: LASzip | here | times faster | two threads: CPU | "
      "elapsed "
      "| encode: LASzip | here | times faster | two threads: CPU | elapsed | computation: elapsed "
      "| size |");
  for (int i = 2; i < argc; ++i) pcl_als::row(pcl_als::File(argv[i]), std::atoi(argv[1]));
  return 0;
}
