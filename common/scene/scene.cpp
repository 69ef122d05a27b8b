#include "common/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "common/case/nearest_word.hpp"
#include "common/case/text_file.hpp"
#include "common/scene/bodies.hpp"
#include "common/scene/outline.hpp"
#include "common/scene/period.hpp"
#include "common/scene/rows.hpp"
#include "common/scene/worn_box.hpp"

namespace toryu {

namespace {

bool box_in_box(const Box& inner, const Box& outer) {
  return (inner.min.array() >= outer.min.array()).all() && (inner.max.array() <= outer.max.array()).all();
}

/// Where bodies may be: in the domain or, where that repeats itself, beyond its sides by so much that a part
/// of them is in it.
bool is_within_domain(const Box& box, const Scene& scene) {
  Box domain = scene.domain;
  const Period period(scene);
  for (int axis = 0; axis < dim; ++axis)
    if (period.along(axis) && box.min[axis] < domain.max[axis] && box.max[axis] > domain.min[axis]) {
      domain.min[axis] = std::min(domain.min[axis], box.min[axis]);
      domain.max[axis] = std::max(domain.max[axis], box.max[axis]);
    }
  return box_in_box(box, domain);
}

/// A box whose own faults have been reported is left alone.
void check_walls(CaseFile& file, const Scene& scene) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    const std::string key = fmt::format("wall.{}", i);
    if (wall.box.is_sound() && scene.domain.is_sound() && !is_within_domain(wall.box, scene))
      file.fault(key + "." + wall.shape.place(),
                 fmt::format("the {} of wall '{}' is not within [case.domain]",
                             wall.box.outline ? "outline" : "box", wall.name));
    else if (wall.press && wall.box.is_sound() && scene.domain.is_sound() &&
             !box_in_box(swept_box(wall), scene.domain))
      file.fault(key + ".press.travel",
                 fmt::format("the wall '{}' leaves [case.domain] by its travel", wall.name));
    if (!wall.worn.empty() && is_within_domain(wall.box, scene) && !box_in_box(wall.box, scene.domain))
      file.fault(key + ".worn", "a wall with worn faces cannot cross a side of [case.domain]");
    if (wall.press && file.has("solid"))
      file.fault(key + ".press", "a solid knows of no walls that the fluid moves: prescribe a 'motion'");
    if (wall.press && scene.periodic != Periodic::none)
      file.fault(key + ".press", "a wall that is pressed does not go with space that repeats itself");
  }
}

/// Whether a wall moves across the axis.
bool moves_across(const Wall& wall, double end_time) {
  if (wall.press && wall.press->axis()[1] != 0) return true;
  if (!wall.motion) return false;
  const auto across = [&](double t) { return wall.motion->velocity_at(t)[1] != 0; };
  const auto knots = wall.motion->knots(end_time);
  return wall.motion->turns() || std::any_of(knots.begin(), knots.end(), across);
}

/// Gives each wall that shares a motion its copy of it.
void share_motions(CaseFile& file, Scene& scene) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    Wall& wall = scene.walls[i];
    if (wall.moves_with.empty()) continue;
    if (const Motion* motion = shared_motion(scene, wall.moves_with))
      wall.motion = *motion;
    else
      file.fault(fmt::format("wall.{}.moves_with", i), no_motion(scene, wall.moves_with));
  }
}

/// Results call the walls that share a motion by its name.
void check_names(CaseFile& file, const Scene& scene) {
  for (std::size_t i = 0; i < scene.motions.size(); ++i) {
    const std::string& name = scene.motions[i].name;
    const auto same = [&](const Wall& wall) { return wall.name == name; };
    if (name == "walls" || name == "interface" || std::any_of(scene.walls.begin(), scene.walls.end(), same))
      file.fault(fmt::format("motion.{}.name", i),
                 fmt::format("results call the walls that move with '{}' so: no wall may have that name, and "
                             "'walls' and 'interface' mean others",
                             name));
  }
}

/// By which a wall moves.
std::string motion_key(const Scene& scene, std::size_t i) {
  const Wall& wall = scene.walls[i];
  return fmt::format("wall.{}.{}", i,
                     wall.press                ? "press"
                     : wall.moves_with.empty() ? "motion"
                                               : "moves_with");
}

void check_motions(CaseFile& file, const Scene& scene) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    const std::string key = motion_key(scene, i);
    if (!wall.motion) continue;
    if (!std::isfinite(largest_speed(*wall.motion, corners_of(wall.box), scene.end_time)))
      file.fault(key, "its speed is beyond all numbers");
    if (!wall.motion->turns()) continue;
    if (scene.periodic != Periodic::none)
      file.fault(key, "a wall that turns does not go with space that repeats itself");
    if (file.has("fluid.wall_slip"))
      file.fault(key, "a wall that turns does not go with [fluid.wall_slip], which knows plane walls alone");
  }
}

/// A motion that nothing shares is one that somebody forgot to name.
void check_shares(CaseFile& file, const Scene& scene) {
  std::set<std::string> shared;
  for (const Wall& wall : scene.walls) shared.insert(wall.moves_with);
  for (std::size_t k = 0; k < file.count("solid.clamp"); ++k)
    shared.insert(file.value<std::string>(fmt::format("solid.clamp[{}].moves_with", k)).value_or(""));
  shared.erase("");
  const auto is_mistyped = [&](const std::string& name) { return !shared_motion(scene, name); };
  if (std::any_of(shared.begin(), shared.end(), is_mistyped)) return;  // told by itself
  for (std::size_t i = 0; i < scene.motions.size(); ++i)
    if (const std::string& name = scene.motions[i].name; !shared.contains(name))
      file.fault(
          fmt::format("motion.{}.name", i),
          fmt::format("nothing moves with '{}': give moves_with = \"{}\" to a wall or a clamp", name, name));
}

void check_axis(CaseFile& file, const Scene& scene) {
  if (scene.geometry != Geometry::axisymmetric) return;
  if (file.has("solid"))
    file.fault("case.geometry", "a scene with a solid cannot be axisymmetric: solids know no axis");
  if (scene.periodic == Periodic::y || scene.periodic == Periodic::xy)
    file.fault("case.periodic",
               "about an axis space repeats itself along it alone: \"x\", or leave 'periodic' out");
  if (scene.gravity[1] != 0)
    file.fault("case.gravity", "gravity across the axis is not axisymmetric: give it along x alone");
  if (scene.gravity_change)
    file.fault("case.gravity_change", "gravity about an axis cannot change: leave it out");
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (wall.box.min[1] < 0)
      file.fault(fmt::format("wall.{}.{}", i, wall.shape.place()),
                 fmt::format("the wall '{}' crosses the axis: y is the distance from it, at "
                             "least 0",
                             wall.name));
    if (moves_across(wall, scene.end_time))
      file.fault(motion_key(scene, i),
                 fmt::format("the wall '{}' moves across the axis: it can move along x alone", wall.name));
  }
}

void check_references(CaseFile& file, const Scene& scene) {
  for (std::size_t i = 0; i < scene.references.size(); ++i) {
    const Reference& reference = scene.references[i];
    const auto tell = [&](const ReferenceFault& fault) {
      if (fault.line > 0)
        file.fault({.place = (file.folder() / reference.file).string(),
                    .line = fault.line,
                    .column = 1,
                    .message = fault.message});
      else
        file.fault(fmt::format("reference.{}.{}", i, fault.key), fault.message);
    };
    std::optional<ReferenceFault> fault;
    if (!reference.file.empty() && !reference.column.empty()) read_curve(file.folder(), reference, fault);
    if (fault) tell(*fault);
    if (!reference.series.empty() && (fault = fault_of_series(reference))) tell(*fault);
  }
}

/// Whether `other`, whatever it is, holds what the reference `file` does.
bool same_text(const std::filesystem::path& file, const std::filesystem::path& other) {
  return is_file(other) && std::filesystem::file_size(file) == std::filesystem::file_size(other) &&
         read_text(file, largest_reference) == read_text(other, largest_reference);
}

/// Moves what is there to the next free name, PATH.N.
void keep_beside(const std::filesystem::path& path) {
  std::filesystem::path kept;
  for (int number = 1; kept.empty() || std::filesystem::exists(kept); ++number)
    kept = fmt::format("{}.{}", path.string(), number);
  std::filesystem::rename(path, kept);
}

}  // namespace

const Motion* shared_motion(const Scene& scene, const std::string& name) {
  for (const NamedMotion& named : scene.motions)
    if (named.name == name) return &named.motion;
  return nullptr;
}

std::string no_motion(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const NamedMotion& named : scene.motions) names.push_back(named.name);
  return fmt::format("no [[motion]] is named '{}'{}", name, what_there_is(name, names));
}

double largest_wall_speed(const Scene& scene) {
  double largest = 0;
  for (const Wall& wall : scene.walls)
    if (wall.motion)
      largest = std::max(largest, largest_speed(*wall.motion, corners_of(wall.box), scene.end_time));
  return largest;
}

void describe(ParameterTable& table, Scene& scene) {
  table.text("title", scene.title, {.required = true, .help = "heads the log and the report"});
  table.vector("gravity", scene.gravity, {.unit = "m/s2", .help = "acceleration of every fluid and solid"});
  table.number(
      "end_time", scene.end_time,
      {.unit = "s", .minimum = 0, .above_minimum = true, .required = true, .help = "end of the run"});
  table.number("frame_interval", scene.frame_interval,
               {.unit = "s", .minimum = 0, .help = "time between frames; 0: no frames"});
  table.number("series_interval", scene.series_interval,
               {.unit = "s", .minimum = 0, .help = "time between rows of a series; 0: every step"});
  table.number("checkpoint_interval", scene.checkpoint_interval,
               {.unit = "s", .minimum = 0, .help = "simulated time between checkpoints; 0: none by it"});
  table.number("checkpoint_every", scene.checkpoint_every,
               {.unit = "s",
                .minimum = 0,
                .help = "wall time between checkpoints, of which the newest two are kept; 0: none by it"});
  // Beyond it an interval is lost in the rounding of the time. A run may be endless, so this is no small
  // number.
  table.require(!(scene.end_time / scene.frame_interval > 1e12) || scene.frame_interval == 0,
                "frame_interval",
                fmt::format("'frame_interval' would give {:.1e} frames; at most 1e12 can be counted",
                            scene.end_time / scene.frame_interval));
  table.require(!(scene.end_time / scene.series_interval > 1e12) || scene.series_interval == 0,
                "series_interval",
                fmt::format("'series_interval' would give {:.1e} rows; at most 1e12 can be counted",
                            scene.end_time / scene.series_interval));
  table.optional("gravity_change", scene.gravity_change, "what is added to gravity over time");
  table.group("domain", scene.domain, "a particle that leaves it stops the run");
  table.require(!scene.domain.round, "domain.round", "the domain is a box: it cannot be round");
  table.choice("periodic", scene.periodic, {"none", "x", "y", "xy"},
               {.help = "directions in which the domain repeats itself"});
  table.choice("geometry", scene.geometry, {"plane", "axisymmetric"},
               {.help = "plane, or x along an axis and y the distance from it; of a fluid without a solid"});
}

void describe(ParameterTable& table, Wall& wall) {
  table.text("name", wall.name,
             {.required = true, .help = "as the log and the report call it", .names_columns = true});
  describe_shape(table, wall.shape, wall.box, "filled with particles on a lattice of each solver's spacing");
  table.optional("motion", wall.motion, "prescribed motion; without it the wall stands still");
  if (table.wants(!wall.moves_with.empty()))
    table.text("moves_with", wall.moves_with, {.help = "the [[motion]] that it shares with others, by name"});
  table.require(!wall.motion || wall.moves_with.empty(), "moves_with",
                "a wall has either a 'motion' of its own or one of those that are shared");
  table.optional("press", wall.press, "moves as a pressure and the fluid push it");
  table.require((!wall.motion && wall.moves_with.empty()) || !wall.press, "press",
                "a wall has either a 'motion' or a 'press'");
  table.require(!wall.press || wall.box.is_rectangle(), "press",
                "a piston is a box: it cannot be round, or of another shape");
  table.flag("work_piece", wall.work_piece, "a rigid work piece: the fluid's friction acts on it");
  table.list("worn", wall.worn,
             "faces that the fluid finds behind those of the box; of two opposite ones that it wets, both");
  require_remains(table, wall.box, wall.worn, "wall");
}

void describe(ParameterTable& table, Reference& reference) {
  table.text("label", reference.label, {.required = true, .help = "in the legend of the chart"});
  table.text(
      "file", reference.file,
      {.required = true, .help = "CSV beside the case, its first column time [s]; # starts a comment"});
  table.text("series", reference.series,
             {.required = true, .help = "what it is drawn over: 'solid.csv:tip_displacement_x[m]'"});
  table.text("column", reference.column, {.required = true, .help = "column of the file"});
}

Scene read_scene(CaseFile& file) {
  Scene scene;
  file.read("case", scene, "what all participants share");
  file.read_list("wall", scene.walls, "rigid bodies");
  file.read_list("motion", scene.motions, "motions that walls and clamps share");
  file.read_list("reference", scene.references, "measured or published curves, drawn in the report");
  share_motions(file, scene);
  check_walls(file, scene);
  check_bodies(file, scene);
  check_references(file, scene);
  check_axis(file, scene);
  check_motions(file, scene);
  check_shares(file, scene);
  check_names(file, scene);
  for (std::size_t i = 0; i < scene.walls.size() && file.has("solid"); ++i)
    if (!scene.walls[i].worn.empty())
      file.fault(fmt::format("wall.{}.worn", i),
                 "a scene with a solid cannot have worn walls: the solid finds the faces of their boxes");
  for (std::size_t i = 0; file.has("fluid") && i < file.count("solid.region"); ++i)
    if (file.has(fmt::format("solid.region[{}].worn", i)))
      file.fault(
          fmt::format("solid.region.{}.worn", i),
          "a solid in a fluid cannot have worn regions: the fluid fills up to the faces of their boxes");
  return scene;
}

void check_folder(CaseFile& file, const std::filesystem::path& out) {
  std::error_code ignored;
  const auto folder = std::filesystem::weakly_canonical(out, ignored);
  for (const auto& input : file.inputs()) {
    const auto place = std::filesystem::weakly_canonical(input, ignored).lexically_relative(folder);
    if (!place.empty() && is_written_by_runs(place))
      file.fault(
          {.place = input.string(),
           .message = fmt::format("a run with its results in '{}' would write over this file; give --out "
                                  "another folder, or take a copy of the file",
                                  out.string())});
  }
}

void copy_named_files(const CaseFile& file, const std::filesystem::path& out) {
  for (const auto& name : file.named_files()) {
    if (!fault_of_results_name(name).empty()) continue;  // a table: the case written there holds its rows
    const auto source = file.folder() / name, target = out / name;
    std::filesystem::create_directories(target.parent_path());
    if (std::filesystem::exists(target)) {
      if (std::filesystem::equivalent(source, target) || same_text(source, target)) continue;
      keep_beside(target);
    }
    std::filesystem::copy_file(source, target);
  }
}

}  // namespace toryu
