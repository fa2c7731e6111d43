// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>

namespace pcl_als {

/** \brief Values as bytes, for messages between processes of one program (Communicator).
 *
 * Numbers are in the byte order of the machine. Structures are written member by member:
 * \code
 * ByteWriter out;
 * out.put(strip.id).put(strip.points).put(strip.minimum);
 * ByteReader in(out.bytes());
 * in.get(strip.id).get(strip.points).get(strip.minimum);
 * \endcode
 */
class ByteWriter {
 public:
  template <typename T>
  std::enable_if_t<std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, ByteWriter&> put(
      const T& value) {
    return raw(&value, sizeof value);
  }
  ByteWriter& put(const std::string& text) {
    return put(text.size()).raw(text.data(), text.size());
  }
  /// Of fixed size.
  template <typename Scalar, int kRows, int kColumns>
  ByteWriter& put(const Eigen::Matrix<Scalar, kRows, kColumns>& matrix) {
    static_assert(kRows > 0 && kColumns > 0, "the size must be fixed");
    return raw(matrix.data(), sizeof(Scalar) * kRows * kColumns);
  }
  template <typename T>
  ByteWriter& put(const std::vector<T>& values) {
    put(values.size());
    if constexpr (std::is_trivially_copyable_v<T>)
      return raw(values.data(), sizeof(T) * values.size());
    for (const T& value : values) put(value);
    return *this;
  }
  /// Values that consist of numbers and matrices of fixed size only.
  template <typename T>
  ByteWriter& putPlain(const std::vector<T>& values) {
    return put(values.size()).raw(values.data(), sizeof(T) * values.size());
  }
  /// A map, ordered or hashed, whose keys are numbers; \a value writes an entry: value(out, v). A
  /// hashed map gets the same order of iteration from getHashed().
  template <typename Map, typename Value>
  ByteWriter& putMap(const Map& map, const Value& value) {
    put(map.size());
    for (const auto& [key, entry] : map) {
      put(key);
      value(*this, entry);
    }
    return *this;
  }
  template <typename T>
  ByteWriter& plain(const T& value) {
    return raw(&value, sizeof value);
  }
  ByteWriter& raw(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what ByteWriter wrote. InputError where the bytes end early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <typename T>
  std::enable_if_t<std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, ByteReader&> get(
      T& value) {
    return raw(&value, sizeof value);
  }
  ByteReader& get(std::string& text) {
    text.resize(size(1));
    return raw(text.data(), text.size());
  }
  template <typename Scalar, int kRows, int kColumns>
  ByteReader& get(Eigen::Matrix<Scalar, kRows, kColumns>& matrix) {
    static_assert(kRows > 0 && kColumns > 0, "the size must be fixed");
    return raw(matrix.data(), sizeof(Scalar) * kRows * kColumns);
  }
  template <typename T>
  ByteReader& get(std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      values.resize(size(sizeof(T)));
      return raw(values.data(), sizeof(T) * values.size());
    }
    values.clear();
    for (std::size_t left = size(1); left > 0; --left) get(values.emplace_back());
    return *this;
  }
  template <typename T>
  ByteReader& getPlain(std::vector<T>& values) {
    values.resize(size(sizeof(T)));
    return raw(static_cast<void*>(values.data()), sizeof(T) * values.size());
  }
  template <typename Map, typename Value>
  ByteReader& getHashed(Map& map, std::size_t buckets, const Value& value) {
    std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> entries(size(1));
    for (auto& [key, entry] : entries) {
      get(key);
      value(*this, entry);
    }
    map.clear();
    map.rehash(buckets);  // new entries are put in front of those of their bucket
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
      map.emplace(entry->first, std::move(entry->second));
    return *this;
  }
  template <typename Map, typename Value>
  ByteReader& getMap(Map& map, const Value& value) {
    map.clear();
    for (std::size_t left = size(1); left > 0; --left) {
      const auto key = take<typename Map::key_type>();
      value(*this, map[key]);
    }
    return *this;
  }
  ByteReader& raw(void* data, std::size_t size) {
    if (size > rest_.size()) throw InputError("a message between processes ends early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
    return *this;
  }
  template <typename T>
  T take() {
    T value{};
    get(value);
    return value;
  }
  /// Values that consist of numbers and matrices of fixed size only.
  template <typename T>
  ByteReader& plain(T& value) {
    return raw(static_cast<void*>(&value), sizeof value);
  }
  bool done() const { return rest_.empty(); }

 private:
  /// A number of elements of at least \a bytes each.
  std::size_t size(std::size_t bytes) {
    const auto count = take<std::size_t>();
    if (count > rest_.size() / bytes) throw InputError("a message between processes ends early");
    return count;
  }

  std::string_view rest_;
};

}  // namespace pcl_als
