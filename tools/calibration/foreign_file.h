// Files of other programs as values by their keys, with line numbers.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mocap {

/// Numbers with their place: "file:line: key", for messages.
struct ForeignNumbers {
  std::string where;
  std::vector<double> values;
};

/// A scalar, or all scalars of a list and of its rows.
struct ForeignValue {
  int line = 0;
  std::vector<std::string> words{};
  bool is_string = false;  ///< Of a type that is no number.
};

/// What a file says. Keys are joined by dots: "cam0.resolution". Of several tables or values of one
/// name the second has "#2" after its name, and so on.
struct ForeignFile {
  struct Place {
    std::string path{};  ///< "cameras.cam1."; empty at the top.
    std::string name{};  ///< "cam1", which may have dots.
    std::size_t depth = 0;
    int line = 0;
  };

  std::string name;
  std::map<std::string, ForeignValue> values{};
  std::vector<Place> tables{};  ///< In the file's order.
};

/// A table of a file. Keys may reach into inner tables. What is missing or wrong throws SetupError:
/// "file:line: key", what was found and what was expected.
class ForeignTable {
 public:
  /// Reads the text of a file; nothing in it is too deep or too large to be refused in one line.
  /// @param name  the file's, for messages. @throws SetupError  naming file and line.
  static ForeignTable OfYaml(std::string text, const std::string& name);
  static ForeignTable OfXml(const std::string& text, const std::string& name);
  static ForeignTable OfToml(const std::string& text, const std::string& name);

  explicit ForeignTable(ForeignFile file)
      : file_(std::make_shared<const ForeignFile>(std::move(file))) {}

  /// Inner tables of a name, at any depth; without a name, all that are no part of another.
  std::vector<ForeignTable> Tables(std::string_view name = {}) const;
  /// Empty if there is none.
  std::optional<ForeignTable> Table(const std::string& key) const;
  const std::string& Name() const { return place_.name; }

  bool Has(const std::string& key) const;
  const std::vector<std::string>& Words(const std::string& key) const;
  /// The words of a value, joined by blanks.
  std::string Text(const std::string& key) const;
  /// A value's numbers, or those of a matrix as in OpenCV and ROS (a table of rows, cols and data).
  ForeignNumbers Numbers(const std::string& key) const;
  double Number(const std::string& key) const;

  std::string Where(const std::string& key) const;
  [[noreturn]] void Fail(const std::string& key, const std::string& what) const;

 private:
  const ForeignValue* Find(const std::string& key) const;

  std::shared_ptr<const ForeignFile> file_;
  ForeignFile::Place place_;
};

/// Parses a number. @throws SetupError  beginning with `where`, when it is not a finite number.
double FiniteNumber(std::string_view text, const std::string& where);

}  // namespace mocap
