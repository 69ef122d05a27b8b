#include "common/scene/shape_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/case/csv_rows.hpp"
#include "common/case/nearest_word.hpp"
#include "common/scene/drawing_tool.hpp"
#include "common/scene/reference.hpp"

namespace toryu {

namespace {

using Fault = ShapeFileFault;

const std::vector<std::string> units{"of_file", "m", "cm", "mm", "um", "in"};
constexpr std::array metres{0.0, 1.0, 1e-2, 1e-3, 1e-6, 0.0254};

std::string word_of(LengthUnit unit) {
  return unit == LengthUnit::of_file ? "" : units[static_cast<std::size_t>(unit)];
}

/// ".svg" of PART.SVG
std::string extension(const InputFile& file) {
  std::string text = file.path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The corners of a CSV.
class Corners {
 public:
  Corners(const std::string& text, LengthUnit stated) : rows_(text), stated_(stated) {}

  std::optional<Fault> read(std::vector<Outline::Ring>& rings) {
    if (!rows_.next()) return Fault{"file", "is empty"};
    const bool headed = !csv_number(rows_.cells[0]);
    columns_ = rows_.cells.size();
    if (columns_ != 2 && columns_ != 3)
      return Fault{"file",
                   fmt::format("line {}: {} columns; there are x and y, or ring, x and y{}", rows_.line,
                               columns_, has_other_comma(rows_.cells) ? "; commas part columns" : "")};
    if (const auto fault = find_unit(headed)) return fault;
    if (headed && !rows_.next()) return Fault{"file", "holds no corner"};
    double ring = NAN;
    do {
      if (const auto fault = add_corner(rings, ring)) return fault;
    } while (rows_.next());
    for (auto& corners : rings)
      if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    return {};
  }

 private:
  std::optional<Fault> find_unit(bool headed) {
    std::string told;
    for (std::size_t k = columns_ - 2; headed && k < columns_; ++k) {
      const std::string& cell = rows_.cells[k];
      const auto begin = cell.find('['), end = cell.find(']');
      const std::string unit =
          begin < end && end != std::string::npos ? cell.substr(begin + 1, end - begin - 1) : "";
      if (k > columns_ - 2 && unit != told)
        return Fault{"file", fmt::format("line {}: x and y have different units", rows_.line)};
      told = unit;
    }
    const std::string stated = word_of(stated_);
    const std::vector<std::string> words(units.begin() + 1, units.end());
    if (told.empty() && stated.empty())
      return Fault{"file",
                   fmt::format("the file does not say its unit in a header such as 'x[mm],y[mm]': give "
                               "'unit', one of {}",
                               quoted_list(words))};
    if (!told.empty() && !stated.empty() && told != stated)
      return Fault{"unit", fmt::format("the file says its unit is {}: leave 'unit' out", told)};
    const auto found = std::find(units.begin(), units.end(), told.empty() ? stated : told);
    if (found == units.end())
      return Fault{"file",
                   fmt::format("line {}: unit '{}' is none of {}", rows_.line, told, quoted_list(words))};
    unit_ = metres.at(static_cast<std::size_t>(found - units.begin()));
    return {};
  }

  std::optional<Fault> add_corner(std::vector<Outline::Ring>& rings, double& ring) {
    if (rows_.cells.size() != columns_)
      return Fault{"file",
                   fmt::format("line {}: {} cells, not {}", rows_.line, rows_.cells.size(), columns_)};
    std::array<double, 3> read{};
    for (std::size_t k = 0; k < columns_; ++k) {
      const auto value = csv_number(rows_.cells[k]);
      if (!value || std::isnan(*value))
        return Fault{"file", fmt::format("line {}: '{}' is no number", rows_.line, rows_.cells[k])};
      read.at(k + 3 - columns_) = *value;
    }
    if (rings.empty() || read[0] != ring) rings.emplace_back();
    ring = read[0];
    rings.back().emplace_back(read[1] * unit_, read[2] * unit_);
    return {};
  }

  CsvRows rows_;
  LengthUnit stated_;
  std::size_t columns_ = 0;
  double unit_ = 0;  ///< [m]
};

std::vector<std::string> arguments_of(const ShapeFile& shape, double tolerance) {
  std::vector<std::string> arguments;
  const auto add = [&](const std::string& key, const std::string& value) {
    if (!value.empty()) arguments.push_back("--" + key + "=" + value);
  };
  add("id", shape.id);
  add("layer", shape.layer);
  add("unit", word_of(shape.unit));
  add("tolerance", tolerance > 0 ? fmt::format("{}", tolerance) : "");
  return arguments;
}

std::optional<Fault> fault_of_keys(const ShapeFile& shape, const std::string& kind) {
  if (kind != ".svg" && kind != ".dxf" && kind != ".csv")
    return Fault{"file", fmt::format("'{}' is none of .svg, .dxf and .csv", shape.file.name)};
  if (!shape.id.empty() && kind != ".svg") return Fault{"id", "'id' is that of an element of an .svg"};
  if (!shape.layer.empty() && kind != ".dxf") return Fault{"layer", "'layer' is one of a .dxf"};
  if (const std::string wrong = fault_of_results_name(shape.file.name); !wrong.empty())
    return Fault{"file", wrong};
  return {};
}

}  // namespace

void describe(ParameterTable& table, ShapeFile& file) {
  if (table.wants(!file.file.name.empty()))
    table.file("file", file.file, {.help = "outline in a drawing beside the case: .svg, .dxf, or .csv"});
  if (table.wants(!file.id.empty()))
    table.text("id", file.id, {.help = "of the element or group of an .svg; else all of it"});
  if (table.wants(!file.layer.empty()))
    table.text("layer", file.layer, {.help = "of a .dxf; else all of it"});
  if (table.wants(file.unit != LengthUnit::of_file))
    table.choice("unit", file.unit, units, {.help = "of lengths in the file, where it does not say it"});
  const bool named = !file.file.name.empty();
  const auto require_file = [&](const std::string& key, bool given) {
    table.require(named || !given, key, fmt::format("'{}' is that of a 'file'", key));
  };
  require_file("id", !file.id.empty());
  require_file("layer", !file.layer.empty());
  require_file("unit", file.unit != LengthUnit::of_file);
}

std::optional<ShapeFileFault> read_rings(const ShapeFile& shape, double tolerance,
                                         std::vector<Outline::Ring>& rings) {
  const std::string kind = extension(shape.file);
  if (auto fault = fault_of_keys(shape, kind)) return fault;
  const auto named = [&](const Fault& fault) {
    return fault.key == "file" ? Fault{"file", fmt::format("'{}': {}", shape.file.name, fault.message)}
                               : fault;
  };
  if (kind == ".csv") {
    const auto fault = Corners(shape.file.text, shape.unit).read(rings);
    return fault ? std::optional(named(*fault)) : std::nullopt;
  }
  const ToolAnswer answer =
      ask_drawing_tool(shape.file.path, shape.file.text, arguments_of(shape, tolerance));
  if (!answer.fault.empty()) return named({answer.key, answer.fault});
  const auto fault = Corners(answer.rows, LengthUnit::of_file).read(rings);
  return fault ? std::optional(named(*fault)) : std::nullopt;
}

}  // namespace toryu
