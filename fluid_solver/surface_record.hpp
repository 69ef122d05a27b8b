/// What the medium does to the surface of the work pieces, particle by particle: contact, sliding and what
/// comes off, recorded over time in `surface.h5`.
///
/// Of the fluid within the kernel's reach, at each surface particle s of area A_s and outward normal n_s (of
/// one with opposite faces: at each of its sides, of the fluid on that side):
///
///     p_s = sum_f V_f max(p_f, 0) W_sf / sum_f V_f W_sf                         contact pressure
///     v_s = |mean of v_f - v_s, less its part along n_s|                        sliding speed, free slip
///     v_s = |u_s|                                          sliding speed, by the law of terms/wall_slip.hpp
///     v_s = gdot_s l                                                            sliding speed, no slip
///     F_s/A_s, F_s the friction force (33); dw/dt = F_s/A_s . (mean of v_f - v_s)   friction's traction,
///     work tau_s = tau_w of the slip law, or eta(gdot_s) gdot_s under no slip; + |F_s|/A_s            shear
///     stress dh/dt = k p_s v_s (Preston 1927), (K/H) p_s v_s (Archard 1953), k tau_s v_s (Fouvry et al.
///     2003, wear
///             by the work of friction)                                          removed depth
///
/// Under no slip the medium sticks, and at the wall's rate of shear gdot_s a grain that stands off by the
/// length l rubs the surface so fast: depths are in proportion to that length.
///
/// Where the kernel sum of the fluid is below 1e-3 (about 0.25 at a plane interface) there is no contact: all
/// are 0. About an axis A_s is the area of a ring. The surface stays where it is in a run: depths are far
/// below a particle's spacing. A study takes it on from run to run (worn_walls.hpp).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "common/output/hdf5_series.hpp"
#include "common/run/solver.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// A fluid that sticks to walls.
struct Sticking {
  double spacing;                           ///< [m]
  std::function<double(double)> viscosity;  ///< [Pa s], of a shear rate [1/s]
};

/// What the medium does in a moment at a point of the surface.
struct SurfaceContact {
  bool there = false;
  double pressure = 0, sliding = 0, shear = 0;  ///< p_s [Pa], v_s [m/s], tau_s [Pa]
  Vec traction = Vec::Zero();                   ///< of friction, as the body was turned at the start [Pa]
  double friction_power = 0;                    ///< [W/m2]
};

class SurfaceRecord {
 public:
  /// `sticks`: of a fluid whose walls have no slip.
  explicit SurfaceRecord(const Removal& removal, std::optional<Sticking> sticks = {},
                         Geometry geometry = Geometry::plane)
      : removal_(removal), laws_(depth_laws(removal)), sticks_(std::move(sticks)), geometry_(geometry) {}

  /// Takes the points (surface_points) of the work pieces among `boundaries`, as they stand.
  void attach(const std::vector<Boundary>& boundaries);
  /// Adds a step of `dt` [s] with the fluid, what contact adds to its pressure [Pa], its `neighbours` and the
  /// friction forces of its last evaluation.
  void add(const std::vector<Boundary>& boundaries, const Particles& fluid, double p_offset,
           const ClusterList& neighbours, const Kernel& kernel, double dt);
  /// What such a step adds: at each point, and the sums of it.
  std::vector<SurfaceContact> find(const std::vector<Boundary>& boundaries, const Particles& fluid,
                                   double p_offset, const ClusterList& neighbours,
                                   const Kernel& kernel) const;
  void add(const std::vector<SurfaceContact>& found, double dt);
  /// On rank 0 `found` becomes what the ranks have found that have all of the fluid near a point.
  void collect(std::vector<SurfaceContact>& found, const std::vector<Boundary>& boundaries,
               const Ranks& ranks) const;
  /// Makes `out`/surface.h5.
  void open(const std::filesystem::path& out);
  /// Appends a row: means since the last one, and the sums so far.
  void write(double time);
  /// Gives the file its final name: no row follows.
  void complete() { file_->complete(); }

  std::size_t size() const { return length_.size(); }
  /// Removed depth (mean over what has been wetted, largest) [m], area [m2], the length that was wetted [m],
  /// or about an axis the volume [m3] and the area [m2], roughness [m]; by the law that counts, and the
  /// depths by the others.
  std::vector<Observation> observe() const;

 private:
  /// At point s, of particle k of `body`, whose points have `area` together.
  SurfaceContact find_at(std::size_t s, const Boundary& body, std::size_t k, double area,
                         const Particles& fluid, double p_offset, const ClusterList& neighbours,
                         const Kernel& kernel) const;
  /// Depth removed so far from surface particle k, by the law that counts [m].
  double depth(std::size_t k) const { return laws_.front().rate * integral_of(laws_.front())[k]; }
  const std::vector<double>& integral_of(const DepthLaw& law) const {
    return law.of_shear ? state_.shear_work : state_.sliding_pressure;
  }

  /// Of point s [m per metre depth], about an axis of its ring [m2].
  double area(std::size_t s) const { return length_[s] * circumference_[s]; }

  Removal removal_;
  std::vector<DepthLaw> laws_;
  std::optional<Sticking> sticks_;
  Geometry geometry_;
  std::string names_;  ///< of the work pieces, joined by ";"
  std::vector<std::uint32_t> work_piece_;
  /// By boundary: where the points of a particle begin here, by id, and where those of the last end; empty if
  /// it is no work piece.
  std::vector<std::vector<std::size_t>> first_;
  std::vector<char> alone_;  ///< whether its particle has no other point
  std::vector<double> position_, normal_;
  std::vector<double> length_;         ///< in the plane [m]
  std::vector<double> circumference_;  ///< of the ring about an axis [m], else 1
  /// Integrals over time: since the last row, and since the start.
  struct State {
    std::vector<double> pressure, speed, shear, traction;             ///< [Pa s], [m], [Pa s], [Pa s]
    std::vector<double> friction_work, sliding_pressure, shear_work;  ///< [J/m2], [Pa m], [J/m2]
    std::vector<std::uint8_t> wetted;  ///< 1 where the fluid has been in contact
    double since_row = 0;              ///< [s]
  };
  template <class Archive>
  friend void serialize(Archive& archive, SurfaceRecord& record) {
    auto& [pressure, speed, shear, traction, friction_work, sliding_pressure, shear_work, wetted, since_row] =
        record.state_;
    HdfSeriesFile::State file = record.file_ ? record.file_->state() : HdfSeriesFile::State{};
    archive(pressure, speed, shear, traction, friction_work, sliding_pressure, shear_work, wetted, since_row,
            file);
    if constexpr (Archive::is_loading::value)
      if (record.file_) record.file_->resume(file);
  }
  State state_;
  std::shared_ptr<HdfSeriesFile> file_;  ///< which copies of the record share
};

}  // namespace toryu::fluid
