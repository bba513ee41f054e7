#include "drivers/take/text_table.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr std::size_t kBuffer = 1 << 16;
constexpr std::size_t kLongestLine = 1 << 20;
constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";

bool IsBlank(std::string_view line) {
  return line.find_first_not_of(" \t,;") == std::string_view::npos;
}

}  // namespace

TextLines::TextLines(std::filesystem::path file, std::string_view wanted)
    : file_(std::move(file)), wanted_(wanted), fd_(OpenToRead(file_, wanted)), buffer_(kBuffer) {}

TextLines::~TextLines() { close(fd_); }

// Keeps unread bytes and reads more after them.
bool TextLines::Fill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  for (;;) {
    const ssize_t got = read(fd_, buffer_.data() + end_, buffer_.size() - end_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw SetupError(file_.string() + ": cannot be read: " + std::strerror(errno) +
                       "; expected " + wanted_);
    }
    end_ += static_cast<std::size_t>(got);
    return got > 0;
  }
}

void TextLines::Begin() {
  while (end_ < kUtf8Mark.size() && Fill()) continue;
  const std::string_view start(buffer_.data(), end_);
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff")) {
    number_ = 1;
    Fail("is UTF-16; expected " + wanted_ + " in UTF-8");
  }
  if (start.starts_with(kUtf8Mark)) begin_ = kUtf8Mark.size();
}

// LF, CR, CRLF, or the CRCRLF of a double conversion.
void TextLines::TakeEnd() {
  while (end_ - begin_ < 3 && Fill()) continue;
  const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
  begin_ += rest.starts_with("\r\r\n") ? 3 : rest.starts_with("\r\n") ? 2 : 1;
}

bool TextLines::Next(std::string_view& line) {
  if (number_ == 0) Begin();
  line_.clear();
  if (begin_ == end_ && !Fill()) return false;
  ++number_;
  for (;;) {
    const auto from = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto to = buffer_.begin() + static_cast<std::ptrdiff_t>(end_);
    const auto stop =
        std::find_if(from, to, [](char c) { return c == '\n' || c == '\r' || c == '\0'; });
    line_.append(from, stop);
    begin_ += static_cast<std::size_t>(stop - from);
    if (line_.size() > kLongestLine) {
      Fail("is longer than " + std::to_string(kLongestLine) + " characters; expected " + wanted_);
    }
    has_end_ = stop != to;
    if (has_end_ && *stop == '\0') Fail("contains a zero byte; expected " + wanted_ + " as text");
    if (has_end_) TakeEnd();
    if (has_end_ || !Fill()) break;
  }
  line = line_;
  return true;
}

bool TextLines::NextRow(std::string_view& line) {
  if (!Next(line)) return false;
  if (!IsBlank(line)) return true;
  const int first_blank = number_;
  while (Next(line)) {
    if (IsBlank(line)) continue;
    number_ = first_blank;
    Fail("is empty; expected a row, or the end of the file");
  }
  return false;
}

void TextLines::Fail(const std::string& what) const {
  throw SetupError(file_.string() + ":" + std::to_string(std::max(number_, 1)) + ": " + what);
}

namespace {

/// Says why a first line is no header.
[[noreturn]] void FailAsHeader(const TextLines& lines, bool is_there, std::string_view line,
                               const std::string& wanted) {
  const std::string then = "; expected the header " + wanted;
  if (!is_there) lines.Fail("is empty" + then);
  const bool has_commas = line.find(',') != std::string_view::npos;
  if (!has_commas && line.find(';') != std::string_view::npos) {
    lines.Fail("has semicolons between its fields; expected commas");
  }
  if (!has_commas && line.find('\t') != std::string_view::npos) {
    lines.Fail("has tabs between its fields; expected commas");
  }
  if (line.find('"') != std::string_view::npos) {
    lines.Fail("has quotation marks" + then + ", without any");
  }
  lines.Fail("begins with " + Quoted(line) + then);
}

std::vector<std::string_view> FieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::size_t RequireHeader(TextLines& lines, std::span<const std::string> headers,
                          const std::string& wanted) {
  std::string_view line;
  const bool is_there = lines.Next(line);
  const auto header = std::find(headers.begin(), headers.end(), line);
  if (!is_there || header == headers.end()) FailAsHeader(lines, is_there, line, wanted);
  return static_cast<std::size_t>(header - headers.begin());
}

std::vector<std::string> RequireColumns(TextLines& lines, std::span<const std::string> first,
                                        const std::string& wanted) {
  std::string_view line;
  const bool is_there = lines.Next(line);
  const std::vector<std::string_view> fields = FieldsOf(line);
  const bool begins =
      fields.size() >= first.size() && std::equal(first.begin(), first.end(), fields.begin());
  if (!is_there || !begins) FailAsHeader(lines, is_there, line, wanted);
  std::vector<std::string> columns(fields.begin(), fields.end());
  for (std::size_t i = first.size(); i < columns.size(); ++i) {
    const auto here = columns.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(columns.begin(), here, columns[i]) != here) {
      lines.Fail("has the column " + Quoted(columns[i]) + " a second time");
    }
  }
  return columns;
}

TableRow::TableRow(std::string_view line, std::span<const std::string> columns,
                   const TextLines& lines)
    : columns_(columns), lines_(lines), fields_(FieldsOf(line)) {
  if (fields_.size() == columns.size()) return;
  lines.Fail("has " + Counted(fields_.size(), "field") + "; expected " +
             std::to_string(columns.size()) + ", as in the header");
}

void TableRow::Fail(std::size_t column, const std::string& wanted) const {
  const std::string found =
      fields_[column].empty() ? std::string("empty") : Quoted(fields_[column]);
  lines_.Fail(columns_[column] + " is " + found + "; expected " + wanted);
}

void TableRow::FailAsNumber(std::size_t column, bool is_whole) const {
  const std::string_view field = fields_[column];
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool is_number = error == std::errc() && end == field.data() + field.size();
  if (is_whole && is_number && field.find_first_of("eE") != std::string_view::npos) {
    Fail(column, "a whole number with all its digits, which spreadsheets remove");
  }
  Fail(column, is_whole ? "a whole number" : "a number");
}

}  // namespace mocap
