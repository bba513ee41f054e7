// Tables that a person, a spreadsheet or a loss of power may have left: line by line, with what a
// message must say of each place.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mocap {

/// Lines of a text file, whatever they end with: LF, CRLF or CR. A byte order mark is passed over.
class TextLines {
 public:
  /// @param wanted  what the file shall be, for messages, as in "a table of capture times".
  /// @throws SetupError  here and below: a file that cannot be read or is no text.
  TextLines(std::filesystem::path file, std::string_view wanted);
  ~TextLines();
  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  /// Gives the next line; false when there is none. The text holds until the next call.
  bool Next(std::string_view& line);
  /// The same, but for lines with nothing in them at the end of the file, which are passed over;
  /// elsewhere they are an error.
  bool NextRow(std::string_view& line);

  /// Whether the last line that was given had an end: without one it may have been cut off.
  bool has_end() const { return has_end_; }
  /// Throws: `file:line: what`.
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  bool Fill();
  void Begin();
  void TakeEnd();

  std::filesystem::path file_;
  std::string wanted_;
  int fd_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< Of what is in the buffer and was not given yet.
  std::string line_;
  int number_ = 0;
  bool has_end_ = true;
};

/// Looks at a table's header, and tells of other separators than commas.
/// @param wanted  for the message.
/// @throws SetupError  when it is none of `headers`. @return  which of them it is.
std::size_t RequireHeader(TextLines& lines, std::span<const std::string> headers,
                          const std::string& wanted);

/// The fields of a row.
class TableRow {
 public:
  /// @param columns  names; borrowed. @throws SetupError  when there are more or fewer fields.
  TableRow(std::string_view line, std::span<const std::string> columns, const TextLines& lines);

  std::string_view Text(std::size_t column) const { return fields_[column]; }

  /// Reads a number; one of no size (nan, inf) is none.
  template <typename Value>
  Value Number(std::size_t column) const {
    const std::string_view field = fields_[column];
    Value value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() ||
        !std::isfinite(static_cast<double>(value))) {
      FailAsNumber(column, std::is_integral_v<Value>);
    }
    return value;
  }

  /// Throws: `file:line: column is "…"; … is wanted`.
  [[noreturn]] void Fail(std::size_t column, const std::string& wanted) const;

 private:
  [[noreturn]] void FailAsNumber(std::size_t column, bool is_whole) const;

  std::span<const std::string> columns_;
  const TextLines& lines_;
  std::vector<std::string_view> fields_;
};

}  // namespace mocap
