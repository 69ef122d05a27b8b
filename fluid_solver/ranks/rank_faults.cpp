#include "fluid_solver/ranks/rank_faults.hpp"

namespace toryu::fluid {

namespace {

/// Terms that find what they need in a part with ghosts. One that is added later is refused until somebody
/// has made sure of it.
template <class Term>
constexpr bool goes_over_ranks =
    is_one_of<Term, BackgroundPressure, CentralForce, DensityDiffusion, ParticleShifting, TensileControl,
              ConsistentGradients, ArtificialViscosity, LaminarViscosity, PowerLaw, HerschelBulkley, Carreau,
              SlipLaw, WallRepulsion, SurfaceTension, HeldVolume, EnclosedMedium, Viscoelasticity, Friction,
              Removal>;

}  // namespace

std::vector<StartFault> rank_faults(const Parameters& p, const Scene& scene) {
  std::vector<StartFault> faults;
  const auto refuse = [&](bool is_there, const std::string& key, const std::string& what) {
    if (is_there) faults.push_back({key, what + " not go over ranks: start the case in one process"});
  };
  for_each_term(p, [&]<class Term>(const std::optional<Term>& term) {
    if constexpr (!goes_over_ranks<Term>)
      refuse(term.has_value(), std::string("fluid.") + Term::section,
             std::string("[fluid.") + Term::section + "] does");
  });
  refuse(p.model != Model::weakly_compressible, "fluid.model", "the implicit model does");
  if (p.wall_model.slip == WallSlip::no_slip && !p.wall_slip)
    refuse(p.removal.has_value(), "fluid.removal",
           "[fluid.removal] of a medium that sticks to its walls does");
  refuse(p.has_open_ends(), "fluid", "inlets and outlets do");
  refuse(scene.geometry != Geometry::plane, "case.geometry", "a flow about an axis does");
  return faults;
}

}  // namespace toryu::fluid
