#include "fluid_solver/weakly_compressible/pair_sweeps.ipp"

namespace toryu::fluid {

template void PairSweeps::rates(const CubicSpline&, RatesOf, Particles&, const ClusterList&,
                                std::vector<Boundary>&, const std::vector<std::uint32_t>*) const;
template void PairSweeps::reaction(const CubicSpline&, const Particles&, Boundary&) const;

}  // namespace toryu::fluid
