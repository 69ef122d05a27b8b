#include "fluid_solver/worn_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/scene/occupancy_index.hpp"

namespace toryu::fluid {

namespace {

double face_of(const Wall& wall, const WornFace& worn) {
  return worn.outward() > 0 ? wall.box.max[worn.axis()] : wall.box.min[worn.axis()];
}

const WornFace* opposite(const Wall& wall, const WornFace& worn) {
  for (const WornFace& other : wall.worn)
    if (&other != &worn && other.axis() == worn.axis()) return &other;
  return nullptr;
}

/// Where the point is along the axis of the face, nothing if it drops out; its own place if it goes with the
/// opposite face.
std::optional<double> place_behind(const Wall& wall, const WornFace& worn, const Vec& point) {
  const double x = point[worn.axis()], s = point[worn.along()], outward = worn.outward();
  const double depth = worn.depth_at(s), face = face_of(wall, worn);
  double end = face - outward * (wall.box.max - wall.box.min)[worn.axis()];
  if (const WornFace* other = opposite(wall, worn)) {
    const double middle = 0.5 * (face + end);
    if (outward * (x - middle) < 0) return x;
    end = middle - 0.5 * outward * (depth - other->depth_at(s));
  }
  const double moved = x - outward * depth;
  if (outward * (moved - end) < 0) return {};
  return moved;
}

/// Particles of the fluid that follow each other along `axis`, from the lowest on.
using Run = std::vector<std::size_t>;

std::vector<Run> runs_along(int axis, const std::vector<Vec>& points, double spacing) {
  std::map<double, Run> columns;
  for (std::size_t i = 0; i < points.size(); ++i) columns[points[i][1 - axis]].push_back(i);
  std::vector<Run> runs;
  for (auto& [place, column] : columns) {
    std::sort(column.begin(), column.end(),
              [&](std::size_t i, std::size_t j) { return points[i][axis] < points[j][axis]; });
    const auto apart = [&](std::size_t i, std::size_t j) {
      return points[j][axis] - points[i][axis] > 1.5 * spacing;
    };
    for (auto begin = column.begin(); begin != column.end();) {
      auto end = std::adjacent_find(begin, column.end(), apart);
      if (end != column.end()) ++end;
      runs.emplace_back(begin, end);
      begin = end;
    }
  }
  return runs;
}

/// The fluid on its lattice, and how far each particle goes from there.
class WornSpace {
 public:
  WornSpace(Filling& filling, std::vector<Vec>& home, const std::vector<Wall>& walls, double spacing)
      : filling_(filling), home_(home), walls_(walls), spacing_(spacing), places_(0.5 * spacing) {
    places_.take(filling.points, "");
    moves_.assign(filling.points.size(), Vec::Zero());
  }

  void fill(int axis) {
    for (Run& run : runs_along(axis, filling_.points, spacing_)) {
      const Vec first = filling_.points[run.front()], last = filling_.points[run.back()];
      const double low = first[axis] - 0.5 * filling_.cells[run.front()][axis],
                   high = last[axis] + 0.5 * filling_.cells[run.back()][axis];
      const double below = add_rows(run, axis, low, -1), above = add_rows(run, axis, high, 1);
      if (below != 0 || above != 0) widen(run, axis, below, above);
    }
  }
  void move() {
    for (std::size_t i = 0; i < moves_.size(); ++i) filling_.points[i] += moves_[i];
  }

 private:
  /// The depth of the face that ends a run at `end`, looking towards it along `axis`; 0 if none is worn.
  double depth_at(int axis, double end, double along, double side) const {
    for (const Wall& wall : walls_)
      for (const WornFace& worn : wall.worn)
        if (worn.axis() == axis && worn.outward() == -side &&
            std::abs(face_of(wall, worn) - end) < 0.5 * spacing_ && along >= wall.box.min[worn.along()] &&
            along < wall.box.max[worn.along()])
          return worn.depth_at(along);
    return 0;
  }
  /// Adds rows at an end of the run; returns by how much the face still lies beyond them [m].
  double add_rows(Run& run, int axis, double end, double side) {
    const std::size_t edge = side < 0 ? run.front() : run.back();
    const double depth = depth_at(axis, end, filling_.points[edge][1 - axis], side);
    const long rows = std::lround(depth / spacing_);
    for (long row = 0; row < rows; ++row) {
      Vec point = filling_.points[edge], cell = filling_.cells[edge];
      point[axis] = end + side * (static_cast<double>(row) + 0.5) * spacing_;
      cell[axis] = spacing_;
      if (places_.taken(point)) continue;  // by what comes from the other axis
      places_.take({point}, "");
      run.insert(side < 0 ? run.begin() : run.end(), filling_.points.size());
      filling_.points.push_back(point);
      filling_.cells.push_back(cell);
      home_.push_back(home_[edge]);
      moves_.push_back(Vec::Zero());
    }
    return depth - static_cast<double>(rows) * spacing_;
  }
  /// Moves the ends of the run outward by `below` and `above` [m], and all between in proportion.
  void widen(const Run& run, int axis, double below, double above) {
    const double low = filling_.points[run.front()][axis] - 0.5 * filling_.cells[run.front()][axis],
                 high = filling_.points[run.back()][axis] + 0.5 * filling_.cells[run.back()][axis];
    const double strain = (below + above) / (high - low);
    for (const std::size_t i : run) {
      moves_[i][axis] += strain * (filling_.points[i][axis] - low) - below;
      filling_.cells[i][axis] *= 1 + strain;
    }
  }

  Filling& filling_;
  std::vector<Vec>& home_;
  const std::vector<Wall>& walls_;
  double spacing_;
  OccupancyIndex places_;
  std::vector<Vec> moves_;
};

}  // namespace

std::vector<std::optional<Vec>> worn_places(const Wall& wall, const std::vector<Vec>& points) {
  std::vector<std::optional<Vec>> places(points.begin(), points.end());
  for (const WornFace& worn : wall.worn)
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!places[k]) continue;
      const auto place = place_behind(wall, worn, points[k]);
      if (!place)
        places[k].reset();
      else
        (*places[k])[worn.axis()] += *place - points[k][worn.axis()];
    }
  return places;
}

bool any_is_worn(const std::vector<Wall>& walls) {
  return std::any_of(walls.begin(), walls.end(), [](const Wall& wall) { return !wall.worn.empty(); });
}

void fill_worn_space(Filling& filling, std::vector<Vec>& home, const std::vector<Wall>& walls,
                     double spacing) {
  WornSpace space(filling, home, walls, spacing);
  for (int axis = dim - 1; axis >= 0; --axis) space.fill(axis);
  space.move();
}

std::vector<std::string> thin_remains(const std::vector<Wall>& walls, double reach) {
  std::vector<std::string> said;
  for (const Wall& wall : walls)
    for (const WornFace& worn : wall.worn) {
      const double left = (wall.box.max - wall.box.min)[worn.axis()] - worn.largest_depth();
      if (left < (1 - 1e-9) * reach)
        said.push_back(
            fmt::format("wall '{}' is left {:.4g} m thick where it is worn by {:.4g} m, and the fluid sees "
                        "{:.4g} m deep: make its "
                        "box thicker by {:.2g} m",
                        wall.name, left, worn.largest_depth(), reach, reach - left));
    }
  return said;
}

}  // namespace toryu::fluid
