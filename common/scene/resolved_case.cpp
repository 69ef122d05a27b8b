#include "common/scene/resolved_case.hpp"

#include "common/case/document.hpp"
#include "common/scene/outline.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

namespace {

toml::table resolved(const CaseFile& file, const Reference& reference) {
  toml::table result{{"label", reference.label},
                     {"file", reference.file},
                     {"series", reference.series},
                     {"column", reference.column}};
  std::optional<ReferenceFault> fault = fault_of_series(reference);
  const Curve curve = fault ? Curve{} : read_curve(file.folder(), reference, fault);
  if (fault) {
    result.insert("fault", fault->line > 0
                               ? fmt::format("{}:{}: {}", reference.file, fault->line, fault->message)
                               : fault->message);
    return result;
  }
  toml::array points;
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    points.push_back(toml::array(curve.time[i], curve.value[i]));
  result.insert("points", points);
  return result;
}

/// The rings of each wall that is given by an outline, and its number among the walls.
toml::array outlines_of_walls(const CaseFile& file) {
  toml::array outlines;
  for (std::size_t i = 0; i < file.count("wall"); ++i) {
    BodyShape shape;
    Box box;
    file.look(fmt::format("wall[{}]", i),
              [&](ParameterTable& table) { describe_optional_shape(table, shape, box, ""); });
    if (!box.outline) continue;
    toml::array rings;
    for (const auto& ring : box.outline->rings()) {
      toml::array corners;
      for (const Vec& corner : ring) corners.push_back(toml::array(corner[0], corner[1]));
      rings.push_back(corners);
    }
    outlines.push_back(toml::table{{"wall", static_cast<std::int64_t>(i)}, {"rings", rings}});
  }
  return outlines;
}

}  // namespace

std::string resolved_case(CaseFile& file) {
  const std::string text = file.resolved();
  toml::array references, files, outlines;
  if (file.kind() != Kind::study) {
    std::vector<Reference> found;
    file.read_list("reference", found, "");
    for (const auto& reference : found) references.push_back(resolved(file, reference));
    for (const auto& name : file.named_files()) files.push_back(name);
    outlines = outlines_of_walls(file);
  }
  return fmt::format("{{\n\"case\": {},\n\"references\": {},\n\"files\": {},\n\"outlines\": {}\n}}", text,
                     json_text(references), json_text(files), json_text(outlines));
}

}  // namespace toryu
