// A JSON object as text, for other programs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mocap {

/// Members keep the order in which they are added.
class JsonObject {
 public:
  /// @param decimals  the number is rounded to this many; it must be finite.
  void Add(std::string_view name, double value, int decimals);
  void Add(std::string_view name, std::int64_t value);
  void Add(std::string_view name, int value) { Add(name, std::int64_t{value}); }
  void Add(std::string_view name, bool value);
  void Add(std::string_view name, std::string_view text);
  void Add(std::string_view name, const char* text) { Add(name, std::string_view(text)); }
  void Add(std::string_view name, const JsonObject& object);
  void Add(std::string_view name, std::span<const JsonObject> objects);
  void Add(std::string_view name, std::span<const std::string> texts);

  std::string Text() const { return '{' + members_ + '}'; }

 private:
  void AddRaw(std::string_view name, std::string_view value);

  std::string members_;
};

}  // namespace mocap
