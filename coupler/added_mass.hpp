/// Whether an explicit coupling scheme can bear a case: the fluid that a window's motion carries along acts
/// as an added mass, and where that outweighs the solid's surface layer the exchange grows from window to
/// window.
///
///     serial     m_s > (C/2)^2 rho_f dx, but at least 0.37 rho_f dx      C = c_f T/dx, T the window's length
///     parallel   m_s > (C/2)^2 rho_f dx, but at least 0.9 rho_f dx
///     Robin      m_s > 0.03 rho_f dx, and a rigid body any mass, whose equations of motion hold the
///     impedance
///
/// A body that nothing can move has no window to grow in.
///
/// The law is that of a mass on a spring of stiffness rho_f c_f^2/dx, integrated explicitly (van Brummelen
/// 2009: in a compressible fluid the added mass is in proportion to the window). The lower bounds are
/// measured with a kernel that reaches 2.5 dx: see cases/pushed_column/added_mass_map.toml. A wider one takes
/// more of the fluid for its wall's neighbour, and the bounds grow in proportion: with 4 dx the parallel
/// scheme is wrong at 1.0 rho_f dx (cases/submerged_beam).
#pragma once

#include <optional>

#include "common/case/case_file.hpp"
#include "common/link/participant.hpp"
#include "coupler/parameters.hpp"

namespace toryu::coupling {

/// How deep the layer of solid is that fluid beside it has in reach [m]: the fluid's first row stands half a
/// spacing off.
double layer_depth(const FluidTraits& fluid);

/// The layer of solid behind the faces that the fluid wets.
class SurfaceLayer {
 public:
  SurfaceLayer(const Interface& interface, const FluidTraits& fluid);

  /// The mass of the particles behind the faces that `load` presses on (or sucks at), as deep as fluid beside
  /// them has in reach, over the area of these faces, per row of fluid rho_f dx. Dry faces do not count, and
  /// what lies behind two wet ones counts once. Nothing if no face is wet.
  ///
  /// Depth counts from the face: water that only grazes a dry solid has its outermost particles alone in
  /// reach, but those behind move along.
  std::optional<double> mass_ratio(const InterfaceLoad& load) const;

 private:
  struct Face {
    std::uint32_t particle;
    Vec area;                           ///< outward [m per metre depth]
    std::vector<std::uint32_t> behind;  ///< particles, itself among them
  };
  std::vector<Face> faces_;
  std::vector<double> mass_;  ///< [kg per metre depth]
  double row_ = 0;            ///< rho_f dx [kg/m2]
};

/// How the solid of a case moves under a load.
enum class SolidKind { elastic, rigid, held };
SolidKind solid_kind(const CaseFile& file);

/// The least such ratio that `scheme` bears with windows of `dt` [s]; 0 for the implicit scheme.
double least_mass_ratio(SchemeKind scheme, SolidKind solid, const FluidTraits& fluid, double dt);

/// How to say that a layer is too light: both ratios, and what helps.
std::string too_light(double ratio, double least);

}  // namespace toryu::coupling
