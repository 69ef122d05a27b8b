/// The shape of a body as a case says it: a box, a circle, a polygon or the outline in a file, and how it is
/// laid into the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/box.hpp"
#include "common/scene/shape_file.hpp"

namespace toryu {

void describe(ParameterTable& table, Box& box);

struct Circle {
  Vec centre = Vec::Zero();  ///< [m]
  double radius = 0;         ///< [m]
};
void describe(ParameterTable& table, Circle& circle);

/// Copies of a shape, each moved against the one before.
struct Array {
  int count = 2;                ///< with the first
  Vec translate = Vec::Zero();  ///< [m]
  double rotate = 0;            ///< anticlockwise about `about` [degrees]
  Vec about = Vec::Zero();      ///< [m]
};
void describe(ParameterTable& table, Array& array);

enum class Mirror { none, x, y, xy };

/// Exactly one of box, circle, polygon and file. Then, in this order: mirror, scale and rotate, all of them
/// about one point, translate, array.
struct BodyShape {
  std::optional<Box> box = {};
  std::optional<Circle> circle = {};
  std::vector<std::vector<double>> polygon = {};             ///< corners [m]
  std::vector<std::vector<std::vector<double>>> holes = {};  ///< in it, their corners [m]
  ShapeFile file = {};
  double tolerance = 0;  ///< largest distance of a curve from its chords [m]; 0: 1e-4 of the larger side
  Vec about = Vec::Zero();
  Mirror mirror = Mirror::none;  ///< the coordinates that change their sign
  double scale = 1, rotate = 0;  ///< [1], anticlockwise [degrees]
  Vec translate = Vec::Zero();   ///< [m]
  std::optional<Array> array = {};

  std::vector<std::string> given() const;  ///< the keys of those of the four that are there
  /// The key at which faults of the shape stand.
  std::string place() const { return given().empty() ? "box" : given()[0]; }
};

/// Describes the keys of a shape, which stand among the other keys of its body, and sets `box` to what they
/// come to: the box as it is given, or another one where it stays one; the bounds of an outline for all else.
/// Returns whether there is a shape.
bool describe_optional_shape(ParameterTable& table, BodyShape& shape, Box& box, const std::string& help);
/// The same of a body that must have one.
void describe_shape(ParameterTable& table, BodyShape& shape, Box& box, const std::string& help);

}  // namespace toryu
