// Reads text tables written by people or spreadsheets, or cut off by a power loss. Messages name
// the place of an error.
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

/// Reads lines of a text file that end with LF, CRLF or CR. Skips a byte order mark.
class TextLines {
 public:
  /// @param wanted  the expected kind of file, for messages, such as "a table of capture times".
  /// @throws SetupError  here and below: a file that cannot be read or is not text.
  TextLines(std::filesystem::path file, std::string_view wanted);
  ~TextLines();
  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  /// Reads the next line; false at the end. The text is valid until the next call.
  bool Next(std::string_view& line);
  /// Like Next, but skips empty lines at the end of the file; elsewhere they are an error.
  bool NextRow(std::string_view& line);

  /// Whether the last line read had a line end; without one it may be cut off.
  bool has_end() const { return has_end_; }
  /// Throws `file:line: what`.
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  bool Fill();
  void Begin();
  void TakeEnd();

  std::filesystem::path file_;
  std::string wanted_;
  int fd_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< Range of the buffer that is still unread.
  std::string line_;
  int number_ = 0;
  bool has_end_ = true;
};

/// Checks a table's header; reports separators other than commas.
/// @param wanted  for the message.
/// @throws SetupError  when it is none of `headers`. @return  the index of the match.
std::size_t RequireHeader(TextLines& lines, std::span<const std::string> headers,
                          const std::string& wanted);

/// Checks that a table's header begins with `first`; reports as RequireHeader does.
/// @throws SetupError  likewise, and when a further column has the name of another one.
/// @return  all columns.
std::vector<std::string> RequireColumns(TextLines& lines, std::span<const std::string> first,
                                        const std::string& wanted);

/// The fields of a row.
class TableRow {
 public:
  /// @param columns  names; not owned. @throws SetupError  when the number of fields differs.
  TableRow(std::string_view line, std::span<const std::string> columns, const TextLines& lines);

  std::string_view Text(std::size_t column) const { return fields_[column]; }

  /// Reads a number; nan and inf are rejected.
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

  /// Throws `file:line: column is "…"; … is wanted`.
  [[noreturn]] void Fail(std::size_t column, const std::string& wanted) const;

 private:
  [[noreturn]] void FailAsNumber(std::size_t column, bool is_whole) const;

  std::span<const std::string> columns_;
  const TextLines& lines_;
  std::vector<std::string_view> fields_;
};

}  // namespace mocap
