/// The unloaded solid: particles that fill its regions exactly, which of them are held, and its surface.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/fill_outline.hpp"
#include "solid_solver/parameters.hpp"
#include "solid_solver/shape.hpp"

namespace toryu::solid {

/// Particles numbered region by region, row by row. Each region is filled by a lattice of its own, whose
/// spacing along each axis is the nearest to the stated one that divides the region's side: the particles are
/// at (i + 1/2) spacings from its faces, and their volumes sum to its area. A clamp line that is the common
/// face of two regions therefore lies between rows. Of a round region, or about a round hole, the particles
/// whose centre is inside are there.
///
/// Between worn faces each line across the region fits what is left of it in the same way: its cells are as
/// much shorter as is off, and a row fewer where that comes nearer to the spacing. Mass is the density times
/// the area that is left. Slopes of the faces should be gentle over a spacing; bonds take the box for the
/// shape.
/// A region that is an outline, or that a hole with an outline cuts, is fitted instead: fill_outline.hpp says
/// how. The surface of a body that has such a region is its outline, each piece of which belongs to the
/// particle nearest to it.
struct Body {
  std::vector<Vec> X;                   ///< positions [m]
  std::vector<Vec> cell;                ///< sides of each particle's cell; of a fitted one as if square [m]
  std::vector<std::uint32_t> region;    ///< index of each particle's region
  std::vector<std::uint32_t> material;  ///< and of what it is made of: Parameters::all_materials
  std::vector<double> density;          ///< by material [kg/m3]
  std::vector<char> held;               ///< by a clamp
  std::vector<Vec> area_vector;         ///< outward faces of the surface [m per metre depth]; zero inside
  Shape shape;                          ///< where there is material
  std::vector<Vec> outside;             ///< empty lattice sites, or places as far beyond the surface [m]
  /// Of all regions without the holes, if one is fitted or a pressure acts on the body; else none.
  std::vector<Outline> outlines;
  std::vector<Vec> shifts{Vec::Zero()};  ///< by which it repeats itself (Period) [m]
  double spacing = 0;                    ///< as stated [m]
  double spread = 0;                     ///< of the density of fitted particles: see fill_outline.hpp
  std::size_t first = 0;                 ///< number of its first particle in a solid of several parts
  std::vector<std::pair<std::string, std::size_t>> counts;  ///< particles by region and clamp, for the log

  std::size_t size() const { return X.size(); }
  double volume(std::size_t i) const { return cell[i].prod(); }                  ///< [m2 per metre depth]
  double mass(std::size_t i) const { return density[material[i]] * volume(i); }  ///< [kg per metre depth]
  double total_volume() const;
  double total_mass() const;
  double mass_of(const std::vector<std::uint32_t>& particles) const;  ///< [kg per metre depth]
  bool has_outline() const { return !outlines.empty(); }
  /// Whether `x` [m] lies in one of the outlines or of their images.
  bool contains(const Vec& x) const;
  /// The point of the surface that is nearest to `x` [m]: none in a body without an outline.
  std::optional<Outline::Foot> foot(const Vec& x) const;
  std::vector<std::uint32_t> inside(const Box& box) const;  ///< numbers of the particles in a box
  /// The pieces of the surface in a box: none in a body without an outline.
  std::vector<SurfacePiece> surface(const Box& box) const;
  /// Numbers of the particles that have an empty lattice site within `reach` [m]: those that a fluid with
  /// that reach can touch.
  std::vector<std::uint32_t> near_surface(double reach) const;
};

/// Takes a fault of the input: the key of the case file it belongs to, and what is wrong.
using TellFault = std::function<void(const std::string& key, const std::string& message)>;
/// The key in that item of [solid]: solid.region."gate".box.
inline std::string item(const std::string& list, const std::string& name, const std::string& key) {
  return "solid." + list + ".\"" + name + "\"." + key;
}

/// Tells as faults: a region that cannot be filled (a side shorter than a spacing, or not near a whole number
/// of them), regions that overlap, a clamp or a load that holds no particle. Where space repeats itself by
/// `shifts`, regions that touch across a period are one as any others that touch.
Body build_body(const Parameters& parameters, const TellFault& tell_fault,
                const std::vector<Vec>& shifts = {Vec::Zero()});
/// The last of it again: loads that act on nothing, observers that are not in the body.
void check_loads_and_observers(const Parameters& parameters, const Body& body, const TellFault& tell_fault);

}  // namespace toryu::solid
