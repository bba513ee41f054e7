// Strict reading of TOML: each value is requested by name and type. Keys that nobody requested are
// errors. Messages contain file, line and key.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// Resolves a path in a file against the file's folder. An empty path stays empty.
std::filesystem::path Resolved(const std::filesystem::path& file, const std::string& path);

/// One table of a TOML file. A key without a fallback is required.
///
/// Every function throws SetupError for a value of the wrong type or out of range.
class TomlSection {
 public:
  /// Reads a whole file. @throws SetupError  if it is missing or not TOML.
  static TomlSection ReadFile(const std::filesystem::path& file);
  /// Reads TOML from text. @param name  used for the text in messages.
  static TomlSection ReadText(std::string_view text, const std::string& name);

  /// Whether the table has a key. The key counts as requested.
  bool Has(std::string_view key) { return Find(key) != nullptr; }
  /// Names of all keys, in the order of the file.
  std::vector<std::string> Keys() const;

  double Number(const std::string& key, std::optional<double> fallback = {});
  double PositiveNumber(const std::string& key, std::optional<double> fallback = {});
  double NumberWithin(const std::string& key, double min, double max,
                      std::optional<double> fallback = {});
  std::int64_t IntegerWithin(const std::string& key, std::int64_t min, std::int64_t max,
                             std::optional<std::int64_t> fallback = {});
  bool Flag(const std::string& key, std::optional<bool> fallback = {});
  std::string Text(const std::string& key, std::optional<std::string> fallback = {});
  /// Reads a text that must be one of `choices`; returns its index.
  std::size_t Choice(const std::string& key, const std::vector<std::string>& choices,
                     std::optional<std::size_t> fallback = {});
  std::vector<std::string> Texts(const std::string& key);
  std::vector<double> Numbers(const std::string& key, std::size_t count);
  /// Reads an array whose length is one of the two.
  std::vector<double> Numbers(const std::string& key, std::size_t few, std::size_t many);
  /// All numbers of an array, or of its rows; none if the key is missing.
  std::vector<double> AllNumbers(const std::string& key);
  /// Any number of integers within bounds; none if the key is missing.
  std::vector<int> Integers(const std::string& key, int min, int max);
  Vector3 Vector(const std::string& key);
  Matrix3 Matrix(const std::string& key);
  bool IsTable(const std::string& key);
  bool IsArray(const std::string& key);
  /// A table in this one; empty if missing.
  std::optional<TomlSection> Section(const std::string& key);
  /// A table that must exist. @param wanted  what it is, for messages.
  TomlSection NeededSection(const std::string& key, const std::string& wanted);
  /// An array of tables; empty if missing.
  std::vector<TomlSection> Sections(const std::string& key);

  /// Names keys that this table may have only with other settings.
  /// @param needs  these settings, for messages: `needs head = "fixed"`.
  void Reserve(const std::vector<std::string>& keys, const std::string& needs);
  /// @throws SetupError  for the first key that was never requested, with the key that it
  /// resembles.
  void RejectUnknownKeys() const;
  /// Returns "file:line: key", for messages.
  std::string Where(const std::string& key) const;
  /// Throws: `file:line: key what`.
  [[noreturn]] void Fail(const std::string& key, const std::string& what) const;

 private:
  TomlSection(std::shared_ptr<const toml::table> root, const toml::table* table, std::string file,
              std::string path);

  const toml::node* Find(std::string_view key);
  const toml::node& Need(const std::string& key, const std::string& wanted);
  const toml::array& NeedArray(const std::string& key, std::size_t count,
                               const std::string& wanted);
  double NumberFrom(const toml::node& node, const std::string& key,
                    const std::string& wanted) const;
  std::string PathOf(const std::string& key) const;
  std::vector<std::string> KeysThatMayBe() const;
  std::string MisspeltAs(const std::string& key) const;

  std::shared_ptr<const toml::table> root_;  ///< Keeps table_ alive.
  const toml::table* table_;
  std::string file_;
  std::string path_;  ///< "cameras.cam1."; empty at the top.
  std::set<std::string, std::less<>> asked_for_;
  std::map<std::string, std::string> reserved_;  ///< Keys, and what each needs.
};

}  // namespace mocap
