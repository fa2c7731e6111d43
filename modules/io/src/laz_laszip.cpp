// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>

#include <pcl_als/common/errors.h>

#include "laz.h"
#include "laz_point.h"

// Chosen by the build where LASzip was found. Header and VLRs are this library's own business;
// LASzip sees the compressed points only.
namespace pcl_als::detail {
namespace {

/// One LASzip object: every call's status becomes an InputError.
class Laszip {
 public:
  explicit Laszip(std::string name) : name_(std::move(name)) {
    if (laszip_create(&handle_) != 0) throw InputError(name_ + ": LASzip cannot be started");
  }
  ~Laszip() {
    laszip_clean(handle_);
    laszip_destroy(handle_);
  }
  Laszip(const Laszip&) = delete;
  Laszip& operator=(const Laszip&) = delete;

  laszip_POINTER handle() const { return handle_; }
  const std::string& name() const { return name_; }
  void check(laszip_I32 status) const {
    if (status == 0) return;
    laszip_CHAR* reason = nullptr;
    laszip_get_error(handle_, &reason);
    throw InputError(name_ + ": LASzip: " + (reason == nullptr ? "unknown failure" : reason));
  }
  laszip_point_struct* point() const {
    laszip_point_struct* point = nullptr;
    check(laszip_get_point_pointer(handle_, &point));
    return point;
  }

 private:
  std::string name_;
  laszip_POINTER handle_ = nullptr;
};

class LaszipReader : public LazReader {
 public:
  LaszipReader(const std::string& path, const LasHeader& header, const std::string& name)
      : laszip_(name),
        layout_(LasRecordLayout::of(header.point_format)),
        record_length_(header.record_length) {
    laszip_BOOL compressed = 0;
    laszip_.check(laszip_open_reader(laszip_.handle(), path.c_str(), &compressed));
    point_ = laszip_.point();
    const auto extra = static_cast<laszip_I32>(record_length_ - layout_.length);
    if (point_->num_extra_bytes != extra)
      throw InputError(name + ": LASzip's record and the header disagree about the extra bytes");
  }
  ~LaszipReader() override { laszip_close_reader(laszip_.handle()); }

  void read(std::uint64_t first, std::size_t count, std::byte* out) override {
    if (first != position_)
      laszip_.check(laszip_seek_point(laszip_.handle(), static_cast<laszip_I64>(first)));
    for (std::size_t i = 0; i < count; ++i) {
      laszip_.check(laszip_read_point(laszip_.handle()));
      packLazPoint(*point_, layout_, record_length_, out + i * record_length_);
    }
    position_ = first + count;
  }

 private:
  Laszip laszip_;
  LasRecordLayout layout_;
  std::size_t record_length_;
  laszip_point_struct* point_ = nullptr;
  std::uint64_t position_ = 0;
};

class LaszipWriter : public LazWriter {
 public:
  LaszipWriter(const LasHeader& header, const std::string& name)
      : laszip_(name),
        layout_(LasRecordLayout::of(header.point_format)),
        record_length_(header.record_length) {
    laszip_header_struct* own = nullptr;
    laszip_.check(laszip_get_header_pointer(laszip_.handle(), &own));
    own->version_major = 1;
    own->version_minor = static_cast<laszip_U8>(header.version_minor);
    laszip_.check(laszip_request_native_extension(laszip_.handle(), 1));
    laszip_.check(laszip_set_point_type_and_size(laszip_.handle(), header.point_format,
                                                 header.record_length));
  }

  std::vector<std::byte> vlr() override {
    laszip_U8* bytes = nullptr;
    laszip_U32 size = 0;
    laszip_.check(laszip_create_laszip_vlr(laszip_.handle(), &bytes, &size));
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    return {begin, begin + size};
  }

  void begin(const std::string& path, std::uint64_t offset_to_points) override {
    stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    stream_.open(path, std::ios::in | std::ios::out | std::ios::binary);
    stream_.seekp(static_cast<std::streamoff>(offset_to_points));
    laszip_.check(laszip_open_writer_stream(laszip_.handle(), stream_, 1, 1));
    point_ = laszip_.point();
  }

  void write(const std::byte* records, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      unpackLazPoint(records + i * record_length_, layout_, record_length_, *point_);
      laszip_.check(laszip_write_point(laszip_.handle()));
    }
    checkStream();
  }

  void finish() override {
    laszip_.check(laszip_close_writer(laszip_.handle()));
    stream_.flush();
    checkStream();
    stream_.close();
    checkStream();
  }

 private:
  void checkStream() const {
    if (!stream_) throw InputError(laszip_.name() + ": cannot be written (is the disk full?)");
  }

  std::vector<char> buffer_ = std::vector<char>(std::size_t{1} << 20);
  std::fstream stream_;  // outlives the LASzip object, which writes to it
  Laszip laszip_;
  LasRecordLayout layout_;
  std::size_t record_length_;
  laszip_point_struct* point_ = nullptr;
};

}  // namespace

bool lazSupported() {
  return true;
}

std::unique_ptr<LazReader> openLazReader(const std::string& path, const LasHeader& header,
                                         const std::string& name) {
  return std::make_unique<LaszipReader>(path, header, name);
}

std::unique_ptr<LazWriter> makeLazWriter(const LasHeader& header, const std::string& name) {
  return std::make_unique<LaszipWriter>(header, name);
}

}  // namespace pcl_als::detail
