#include "daemon/status/status_field.h"

#include <fmt/format.h>

#include "drivers/printable_text.h"

namespace mocap {

std::string CellText(const Column& column, const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return Printable(value.get_ref<const std::string&>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return value.dump();
  return fmt::format("{:.{}f}{}", column.scale * value.get<double>(), column.digits, column.unit);
}

std::string Padded(const Column& column, std::string_view text) {
  if (column.width == 0) return "  " + std::string(text);
  return column.width < 0 ? fmt::format("{:<{}}", text, -column.width)
                          : fmt::format("{:>{}}", text, column.width);
}

}  // namespace mocap
