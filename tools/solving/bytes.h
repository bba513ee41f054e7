// Numbers as bytes, in the order of this computer.
#pragma once

#include <Eigen/Core>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace mocap {

/// Appends numbers to bytes.
class BytesOut {
 public:
  /// @param bytes  emptied first; borrowed.
  explicit BytesOut(std::vector<char>& bytes) : bytes_(bytes) { bytes_.clear(); }

  template <typename T>
  void Add(const T& value) {
    AddAll(&value, 1);
  }
  template <typename T>
  void AddAll(const T* values, std::size_t count) {
    static_assert(std::is_arithmetic_v<T>);
    const char* const begin = reinterpret_cast<const char*>(values);
    bytes_.insert(bytes_.end(), begin, begin + count * sizeof(T));
  }
  template <typename T>
  void AddVector(const Eigen::Vector3<T>& vector) {
    AddAll(vector.data(), 3);
  }

 private:
  std::vector<char>& bytes_;
};

/// Takes them back, in the same order.
class BytesIn {
 public:
  /// @param bytes  borrowed.
  explicit BytesIn(const std::vector<char>& bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  template <typename T>
  T Take() {
    T value;
    TakeAll(&value, 1);
    return value;
  }
  /// @throws std::runtime_error  when there are not that many.
  template <typename T>
  void TakeAll(T* values, std::size_t count) {
    static_assert(std::is_arithmetic_v<T>);
    if (left() / sizeof(T) < count) throw std::runtime_error("ends too soon");
    std::memcpy(values, at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  template <typename T>
  Eigen::Vector3<T> TakeVector() {
    Eigen::Vector3<T> vector;
    TakeAll(vector.data(), 3);
    return vector;
  }

 private:
  const char* at_;
  const char* end_;
};

}  // namespace mocap
