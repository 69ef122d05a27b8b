#include "common/scene/body_shape.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/scene/outline.hpp"

namespace toryu {

namespace {

using Ring = Outline::Ring;

/// Of the larger side of a shape, where the case states no tolerance.
constexpr double default_tolerance = 1e-4;
/// Copies of which none may overlap another.
constexpr int most_copies = 10'000;
/// Whoever turns a shape by more than a full turn means another unit [degrees].
constexpr double full_turn = 360;

constexpr const char* one_shape = "a body has one of 'box', 'circle', 'polygon' and 'file'";

/// What is wrong with a shape, at one of its keys.
struct ShapeFault {
  std::string key, message;
};

/// A box or circle whose own faults have been reported is left alone.
bool is_sound(const BodyShape& shape) {
  return (!shape.box || (shape.box->max.array() > shape.box->min.array()).all()) &&
         (!shape.circle || shape.circle->radius > 0);
}

/// A turn by whole right angles is exact.
struct Turn {
  double cos, sin;
  bool right;
  explicit Turn(double degrees) {
    const double quarters = degrees / 90, angle = degrees * std::numbers::pi / 180;
    right = quarters == std::round(quarters);
    cos = right ? std::round(std::cos(angle)) : std::cos(angle);
    sin = right ? std::round(std::sin(angle)) : std::sin(angle);
  }
  Vec operator()(const Vec& x, const Vec& about) const {
    const Vec r = x - about;
    return about + Vec(cos * r[0] - sin * r[1], sin * r[0] + cos * r[1]);
  }
};

/// Where a point of the shape comes to in the scene. What is not asked for changes no bit.
Vec placed(const BodyShape& shape, Vec x) {
  const bool flips_x = shape.mirror == Mirror::x || shape.mirror == Mirror::xy;
  const bool flips_y = shape.mirror == Mirror::y || shape.mirror == Mirror::xy;
  if (flips_x) x[0] = shape.about[0] - (x[0] - shape.about[0]);
  if (flips_y) x[1] = shape.about[1] - (x[1] - shape.about[1]);
  if (shape.scale != 1) x = shape.about + shape.scale * (x - shape.about);
  if (shape.rotate != 0) x = Turn(shape.rotate)(x, shape.about);
  return x + shape.translate;
}

bool stays_a_box(const BodyShape& shape) {
  return shape.box && !shape.array && Turn(shape.rotate).right;
}

Box placed_box(const BodyShape& shape) {
  const Vec a = placed(shape, shape.box->min), b = placed(shape, shape.box->max);
  return {a.cwiseMin(b), a.cwiseMax(b), shape.box->round};
}

/// Finer than any particle could tell.
constexpr double most_corners_of_quarter = 1e4;

/// So many corners that an ellipse's chords keep within the tolerance, and alike in all quarters.
int corners_of(const Vec& radii, double tolerance) {
  const double share = std::min(0.5, tolerance / radii.maxCoeff());
  const double quarter = std::ceil(0.25 * std::numbers::pi / std::acos(1 - share));
  return 4 * static_cast<int>(std::min(quarter, most_corners_of_quarter));
}

Ring ring_of(const std::vector<std::vector<double>>& rows) {
  Ring ring;
  for (const auto& row : rows) ring.emplace_back(row[0], row[1]);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

std::vector<Ring> ellipse(const BodyShape& shape, const Vec& centre, const Vec& radii) {
  const double tolerance = shape.tolerance > 0 ? shape.tolerance : default_tolerance * 2 * radii.maxCoeff();
  return {ellipse_ring(centre, radii, corners_of(radii, tolerance))};
}

/// The rings as they are given.
std::vector<Ring> rings_of(const BodyShape& shape) {
  if (shape.circle) return ellipse(shape, shape.circle->centre, Vec::Constant(shape.circle->radius));
  if (shape.box && shape.box->round)
    return ellipse(shape, 0.5 * (shape.box->min + shape.box->max), 0.5 * (shape.box->max - shape.box->min));
  if (shape.box) return {ring_of(*shape.box)};
  std::vector<Ring> rings{ring_of(shape.polygon)};
  for (const auto& hole : shape.holes) rings.push_back(ring_of(hole));
  return rings;
}

std::string text_of(const OutlineFault& fault, std::size_t rings) {
  const std::string ring = rings > 1 ? fmt::format(" of its ring {}", fault.ring) : "";
  return fmt::format("{}, at its corner {}{}, counted from 0", fault.message, fault.corner, ring);
}

/// Of a shape that was sound before it was placed: too small, or too far away for its corners to be told
/// apart.
std::string vanishing(const std::string& name, const OutlineFault& fault, std::size_t rings) {
  return fmt::format("{}, mirrored, scaled, rotated and moved, {}", name, text_of(fault, rings));
}

std::vector<Ring> copies_of(const std::vector<Ring>& rings, const Array& array) {
  std::vector<Ring> all;
  for (int copy = 0; copy < array.count; ++copy) {
    const Turn turn(copy * array.rotate);
    for (Ring ring : rings) {
      for (Vec& corner : ring) corner = turn(corner, array.about) + copy * array.translate;
      all.push_back(std::move(ring));
    }
  }
  return all;
}

/// Sets `box` to what a shape of which one kind is given comes to, or says what is wrong.
std::optional<ShapeFault> solve(const BodyShape& shape, Box& box) {
  if (stays_a_box(shape)) {
    const Box placed = placed_box(shape);
    if (const auto fault = fault_of({ring_of(placed)}))
      return ShapeFault{"box", vanishing("'box'", *fault, 1)};
    box = placed;
    return {};
  }
  std::vector<Ring> rings;
  if (shape.file.file.name.empty())
    rings = rings_of(shape);
  else if (const auto fault = read_rings(shape.file, shape.tolerance, rings))
    return ShapeFault{fault->key, fault->message};
  const std::string key = shape.given()[0];
  const std::string name = key == "file" ? "the outline" : "'" + key + "'";
  if (const auto fault = fault_of(rings)) return ShapeFault{key, name + " " + text_of(*fault, rings.size())};
  for (std::size_t k = 1; k < rings.size() && key == "polygon"; ++k)
    if (!Outline({rings[0]}).contains(rings[k][0]))
      return ShapeFault{"holes",
                        fmt::format("hole {} of 'polygon', counted from 0, lies outside of it", k - 1)};
  for (Ring& ring : rings)
    for (Vec& corner : ring) corner = placed(shape, corner);
  if (shape.array) {
    rings = copies_of(rings, *shape.array);
    if (const auto fault = fault_of(rings))
      return ShapeFault{"array", "copies overlap or touch: one " + fault->message};
  } else if (const auto fault = fault_of(rings)) {
    return ShapeFault{key, vanishing(name, *fault, rings.size())};
  }
  box = box_of(Outline(std::move(rings)));
  return {};
}

void describe_placing(ParameterTable& table, BodyShape& shape) {
  if (table.wants(!shape.about.isZero(0)))
    table.vector("about", shape.about,
                 {.unit = "m",
                  .help = "the point about which the shape is mirrored, "
                          "scaled and rotated, in this order"});
  if (table.wants(shape.mirror != Mirror::none))
    table.choice("mirror", shape.mirror, {"none", "x", "y", "xy"},
                 {.help = "the coordinates that change their sign about that point"});
  if (table.wants(shape.scale != 1))
    table.number("scale", shape.scale, {.minimum = 0, .above_minimum = true, .help = "of all lengths"});
  if (table.wants(shape.rotate != 0))
    table.number("rotate", shape.rotate,
                 {.unit = "degrees", .minimum = -full_turn, .maximum = full_turn, .help = "anticlockwise"});
  if (table.wants(!shape.translate.isZero(0)))
    table.vector("translate", shape.translate, {.unit = "m", .help = "moves the shape, after all of these"});
  table.optional("array", shape.array, "copies of the shape, at last");
}

void describe_outline(ParameterTable& table, BodyShape& shape) {
  if (table.wants(!shape.polygon.empty()))
    table.rows("polygon", shape.polygon, {"x [m]", "y [m]"}, {.help = "corners in order, either way round"});
  if (table.wants(!shape.holes.empty()))
    table.tables("holes", shape.holes, {"x [m]", "y [m]"}, {.help = "in the polygon, each by its corners"});
  describe(table, shape.file);
  if (table.wants(shape.tolerance != 0))
    table.number("tolerance", shape.tolerance,
                 {.unit = "m",
                  .minimum = 0,
                  .help = "largest distance of a curve from the chords in its place; 0: 1e-4 of the larger "
                          "side"});
}

}  // namespace

std::vector<std::string> BodyShape::given() const {
  std::vector<std::string> keys;
  if (box) keys.emplace_back("box");
  if (circle) keys.emplace_back("circle");
  if (!polygon.empty()) keys.emplace_back("polygon");
  if (!file.file.name.empty()) keys.emplace_back("file");
  return keys;
}

void describe(ParameterTable& table, Box& box) {
  table.vector("min", box.min, {.unit = "m", .required = true, .help = "smallest corner"});
  table.vector("max", box.max, {.unit = "m", .required = true, .help = "largest corner"});
  table.flag("round", box.round, "the disc or ellipse that touches the sides, in place of the whole box");
  table.require((box.max.array() > box.min.array()).all(), "max",
                "'max' must exceed 'min' in each direction");
}

void describe(ParameterTable& table, Circle& circle) {
  table.vector("centre", circle.centre, {.unit = "m", .required = true});
  table.number("radius", circle.radius, {.unit = "m", .minimum = 0, .above_minimum = true, .required = true});
}

void describe(ParameterTable& table, Array& array) {
  table.integer("count", array.count,
                {.minimum = 1, .maximum = most_copies, .required = true, .help = "copies, with the first"});
  table.vector("translate", array.translate, {.unit = "m", .help = "from each copy to the next"});
  table.number("rotate", array.rotate,
               {.unit = "degrees",
                .minimum = -full_turn,
                .maximum = full_turn,
                .help = "from each copy to the next, anticlockwise"});
  table.vector("about", array.about, {.unit = "m", .help = "the point about which the copies are rotated"});
}

bool describe_optional_shape(ParameterTable& table, BodyShape& shape, Box& box, const std::string& help) {
  table.optional("box", shape.box, help);
  table.optional("circle", shape.circle, "in its place");
  describe_outline(table, shape);
  describe_placing(table, shape);
  table.require(shape.holes.empty() || !shape.polygon.empty(), "holes", "'holes' are those of a 'polygon'");
  const auto given = shape.given();
  if (given.size() > 1)
    table.require(false, given[1],
                  fmt::format("'{}' and '{}' are both there: {}", given[0], given[1], one_shape));
  else if (given.size() == 1 && table.reads() && is_sound(shape))
    if (const auto fault = solve(shape, box)) table.require(false, fault->key, fault->message);
  return !given.empty();
}

void describe_shape(ParameterTable& table, BodyShape& shape, Box& box, const std::string& help) {
  if (!describe_optional_shape(table, shape, box, help))
    table.require(false, "", fmt::format("a shape is missing: {}", one_shape));
}

}  // namespace toryu
