#include "fluid_solver/pair_sweeps.ipp"

namespace toryu::fluid {

template void PairSweeps::rates(const CubicSpline&, RatesOf, Particles&, const ClusterList&,
                                const std::vector<Boundary>&, std::vector<ForceOnFluid>&) const;
template void PairSweeps::reaction(const CubicSpline&, const Particles&, Boundary&) const;

}  // namespace toryu::fluid
