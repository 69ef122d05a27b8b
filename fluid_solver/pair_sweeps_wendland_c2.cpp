#include "fluid_solver/pair_sweeps.ipp"

namespace toryu::fluid {

template void PairSweeps::rates(const WendlandC2&, RatesOf, Particles&, const ClusterList&,
                                const std::vector<Boundary>&, std::vector<ForceOnFluid>&) const;
template void PairSweeps::reaction(const WendlandC2&, const Particles&, Boundary&) const;

}  // namespace toryu::fluid
