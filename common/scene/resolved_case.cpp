#include "common/scene/resolved_case.hpp"

#include <set>

#include "common/case/document.hpp"
#include "common/scene/outline.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

namespace {

/// Times at which a motion is told, beside those at which it changes.
constexpr int looks_at_motion = 400;

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

toml::array array_of(const std::vector<Outline::Ring>& rings) {
  toml::array found;
  for (const auto& ring : rings) {
    toml::array corners;
    for (const Vec& corner : ring) corners.push_back(toml::array(corner[0], corner[1]));
    found.push_back(corners);
  }
  return found;
}

/// All bodies with a shape, with the list in which they stand and their number in it.
toml::array shapes(const CaseFile& file) {
  toml::array found;
  for (const char* list : {"wall", "fluid.region", "fluid.hole", "fluid.observer", "solid.region",
                           "solid.hole", "solid.clamp", "solid.load"})
    for (std::size_t i = 0; i < file.count(list); ++i) {
      BodyShape shape;
      Box box;
      std::string name;
      bool has_shape = false;
      file.look(fmt::format("{}[{}]", list, i), [&](ParameterTable& table) {
        table.text("name", name, {});
        has_shape = describe_optional_shape(table, shape, box, "");
      });
      if (!has_shape || !box.is_sound()) continue;
      found.push_back(toml::table{{"list", list},
                                  {"number", static_cast<std::int64_t>(i)},
                                  {"name", name},
                                  {"is_outline", box.outline != nullptr},
                                  {"rings", array_of(outline_of(box).rings())}});
    }
  return found;
}

/// How each wall that moves by prescription lies over time.
toml::array motions(const Scene& scene) {
  toml::array found;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (!scene.walls[i].motion) continue;
    const Motion& motion = *scene.walls[i].motion;
    std::set<double> times;
    for (int k = 0; k <= looks_at_motion; ++k) times.insert(scene.end_time * k / looks_at_motion);
    if (const auto knots = motion.knots(scene.end_time); knots.size() <= looks_at_motion)
      times.insert(knots.begin(), knots.end());
    toml::array poses;
    for (const double t : times) {
      const Pose pose = motion.pose_at(t);
      poses.push_back(
          toml::array(t, pose.centre[0], pose.centre[1], pose.angle, pose.velocity[0], pose.velocity[1]));
    }
    const Vec about = motion.pose_at(0).about;
    found.push_back(toml::table{{"wall", static_cast<std::int64_t>(i)},
                                {"about", toml::array(about[0], about[1])},
                                {"poses", poses}});
  }
  return found;
}

}  // namespace

std::string resolved_case(CaseFile& file) {
  const std::string text = file.resolved();
  toml::array references, files, bodies, moves;
  if (file.kind() != Kind::study) {
    std::vector<Reference> found;
    file.read_list("reference", found, "");
    for (const auto& reference : found) references.push_back(resolved(file, reference));
    for (const auto& name : file.named_files()) files.push_back(name);
    bodies = shapes(file);
    moves = motions(read_scene(file));
  }
  return fmt::format(
      "{{\n\"case\": {},\n\"references\": {},\n\"files\": {},\n\"shapes\": {},\n\"motions\": {}\n}}", text,
      json_text(references), json_text(files), json_text(bodies), json_text(moves));
}

}  // namespace toryu
