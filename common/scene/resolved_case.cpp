#include "common/scene/resolved_case.hpp"

#include "common/case/document.hpp"
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

}  // namespace

std::string resolved_case(CaseFile& file) {
  const std::string text = file.resolved();
  toml::array references;
  if (file.kind() != Kind::study) {
    std::vector<Reference> found;
    file.read_list("reference", found, "");
    for (const auto& reference : found) references.push_back(resolved(file, reference));
  }
  return fmt::format("{{\n\"case\": {},\n\"references\": {}\n}}", text, json_text(references));
}

}  // namespace toryu
