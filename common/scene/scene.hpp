/// What every participant knows of a scene: the `[case]` section, the rigid walls `[[wall]]` and the
/// references drawn in the report `[[reference]]`. The fluid and the solid have sections of their own, owned
/// by their solvers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "common/scene/body_shape.hpp"
#include "common/scene/box.hpp"
#include "common/scene/gravity.hpp"
#include "common/scene/motion.hpp"
#include "common/scene/reference.hpp"
#include "common/scene/worn_face.hpp"
#include "common/vector.hpp"

namespace toryu {

enum class Direction { plus_x, minus_x, plus_y, minus_y };

/// A piston that presses on the fluid: a rigid body that moves along one axis as its press and the fluid push
/// it, m dv/dt = F(t) + what the fluid does.
struct Press {
  std::vector<std::vector<double>> pressure;  ///< rows of time [s], pressure [Pa]; empty: `force` says it
  std::vector<std::vector<double>> force;     ///< rows of time [s], force [N per metre depth]
  Direction direction = Direction::plus_x;    ///< in which it presses
  Vec travel = Vec::Zero();  ///< least and largest way along `direction`, between its stops [m]
  double mass = 0;           ///< [kg per metre depth]; 0: little beside the fluid's
  Vec axis() const;          ///< the unit vector of `direction`
  /// At `time` [s] on a face of `area` [m per metre depth], linear between the rows [Pa].
  double pressure_at(double time, double area) const;
};
void describe(ParameterTable& table, Press& press);

/// A rigid body: filled with particles by each solver, on a lattice of its own spacing.
struct Wall {
  std::string name;
  Box box;
  std::optional<Motion> motion;
  std::optional<Press> press = {};
  bool work_piece = false;          ///< what the fluid's abrasive rubs on; a body of its own in the results
  std::vector<WornFace> worn = {};  ///< faces that lie behind those of the box
  BodyShape shape = {};             ///< as the case has it
  std::string moves_with = {};      ///< the name of its motion among those that bodies share
};
void describe(ParameterTable& table, Wall& wall);
/// What the plane of a case stands for: a slice of something long, by metre of depth, or the half plane of x
/// along the axis and y the distance from it, by the whole circumference.
enum class Geometry { plane, axisymmetric };

/// Of the face with which a pressed wall presses [m per metre depth], or of its whole ring [m2].
double pressing_area(const Wall& wall, Geometry geometry = Geometry::plane);
/// All places that the wall takes: as it stands, or between the stops of its press.
Box swept_box(const Wall& wall);

void describe(ParameterTable& table, Reference& reference);

/// The directions in which space repeats itself: what leaves the domain at one side comes in at the other.
enum class Periodic { none, x, y, xy };

struct Scene {
  std::string title;
  Vec gravity = Vec::Zero();  ///< [m/s2], to which a change is added
  double end_time = 0;
  double frame_interval = 0;       ///< 0: no frames
  double series_interval = 0;      ///< 0: every step
  double checkpoint_interval = 0;  ///< of simulated time; 0: none [s]
  double checkpoint_every = 600;   ///< of wall time; 0: none [s]
  Box domain;                      ///< a particle outside it is a failure
  Periodic periodic = Periodic::none;
  Geometry geometry = Geometry::plane;
  std::vector<Wall> walls;
  std::vector<Reference> references;
  std::optional<GravityChange> gravity_change = {};
  std::vector<NamedMotion> motions = {};
  Vec gravity_at(double t) const { return gravity_change ? gravity_change->at(gravity, t) : gravity; }
};
/// Of all walls whose motion is prescribed [m/s].
double largest_wall_speed(const Scene& scene);
/// The keys of [case]; walls and references are sections of their own.
void describe(ParameterTable& table, Scene& scene);
/// The motion of that name among those that bodies share; none: nothing has it.
const Motion* shared_motion(const Scene& scene, const std::string& name);
/// The fault where there is none.
std::string no_motion(const Scene& scene, const std::string& name);
/// Reads [case], [[wall]], [[motion]] and [[reference]], and checks that names of walls differ, that walls
/// lie within the domain, that no two bodies of the case are in one place (check_bodies) and that references
/// can be read. Faults are collected in `file`.
Scene read_scene(CaseFile& file);
/// A file of the case that lies where a run with its results in `out` would write is a fault of `file`.
void check_folder(CaseFile& file, const std::filesystem::path& out);
/// Copies the files that the case names to `out`, so that the case written there finds them as well. Another
/// file that is there stays beside the copy, as NAME.N.
void copy_named_files(const CaseFile& file, const std::filesystem::path& out);

}  // namespace toryu
