#include "common/scene/case_bodies.hpp"

#include <fmt/format.h>

#include "common/scene/period.hpp"

namespace toryu {

namespace {

/// A shape in a list of the case.
struct Item {
  std::string name, key;
  Box box;
  std::size_t index = 0;        ///< in the list
  std::string moves_with = {};  ///< the motion that it names
};

/// The shapes of the list `section`, as far as they are sound.
std::vector<Item> items(const CaseFile& file, const std::string& section) {
  std::vector<Item> found;
  for (std::size_t i = 0; i < file.count(section); ++i) {
    Item item;
    BodyShape shape;
    item.index = i;
    file.look(fmt::format("{}[{}]", section, i), [&](ParameterTable& table) {
      table.text("name", item.name, {});
      table.text("moves_with", item.moves_with, {});
      if (!describe_optional_shape(table, shape, item.box, "") && section == "fluid.hole")
        describe(table, item.box);
    });
    item.key = fmt::format("{}.{}.{}", section, i, shape.place());
    if (item.box.is_sound()) found.push_back(std::move(item));
  }
  return found;
}

std::vector<Box> boxes_of(const std::vector<Item>& items) {
  std::vector<Box> boxes;
  boxes.reserve(items.size());
  for (const auto& item : items) boxes.push_back(item.box);
  return boxes;
}

/// As they stand or, where a press moves them, with all that they can sweep over.
std::vector<Body> walls_of(const Scene& scene, bool swept) {
  std::vector<Body> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (!wall.box.is_sound()) continue;
    walls.push_back({fmt::format("the wall '{}'", wall.name),
                     fmt::format("wall.{}.{}", i, wall.shape.place()),
                     {{swept ? swept_box(wall) : wall.box}, {}},
                     wall.motion ? &*wall.motion : nullptr,
                     wall.press.has_value()});
  }
  return walls;
}

/// The regions of `participant` less its holes.
std::vector<Body> regions_of(const CaseFile& file, const Scene& scene, const std::string& participant) {
  const auto holes = with_images(boxes_of(items(file, participant + ".hole")), Period(scene).shifts());
  std::vector<Body> regions;
  for (const auto& region : items(file, participant + ".region"))
    regions.push_back(
        {fmt::format("the {}'s region '{}'", participant, region.name), region.key, {{region.box}, holes}});
  return regions;
}

std::vector<Held> held_parts(const std::vector<Item>& clamps, const Scene& scene,
                             const std::vector<Body>& regions) {
  std::vector<Held> held;
  for (const auto& clamp : clamps)
    for (const Body& region : regions) {
      Held part{region, clamp.index};
      part.part.within.push_back(clamp.box);
      part.name = fmt::format("the solid's clamp '{}'", clamp.name);
      part.key = clamp.key;
      part.motion = shared_motion(scene, clamp.moves_with);
      held.push_back(part);
    }
  return held;
}

std::vector<Body> free_parts(const std::vector<Item>& clamps, std::vector<Body> regions) {
  const auto boxes = boxes_of(clamps);
  for (Body& region : regions)
    region.part.without.insert(region.part.without.end(), boxes.begin(), boxes.end());
  return regions;
}

}  // namespace

CaseBodies::CaseBodies(const CaseFile& file, const Scene& scene)
    : walls(walls_of(scene, false)),
      swept(walls_of(scene, true)),
      fluid(regions_of(file, scene, "fluid")),
      solid(regions_of(file, scene, "solid")) {
  const auto clamps = items(file, "solid.clamp");
  free = free_parts(clamps, solid);
  held = held_parts(clamps, scene, solid);
}

}  // namespace toryu
