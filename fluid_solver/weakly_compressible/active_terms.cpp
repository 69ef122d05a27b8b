/// What the log and the report say of the terms of a case.

#include <fmt/format.h>

#include "fluid_solver/weakly_compressible/dynamics.hpp"

namespace toryu::fluid {

namespace {

using Texts = std::vector<ActiveTerm>;

void add_medium(Texts& texts, const Parameters& p, const EquationOfState& state) {
  texts.push_back({"equation of state", "p = rho_0 c_0^2/gamma [(rho/rho_0)^gamma - 1]",
                   "Monaghan 1994; thesis eq. 3",
                   fmt::format("rho_0 {} kg/m3, c_0 {} m/s, gamma {}", state.rho_0, state.c_0, state.gamma)});
  texts.push_back({"continuity", "Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij",
                   "Monaghan 1994; thesis eq. 18",
                   fmt::format("{}, h = {:.4g} m = {} d_0",
                               p.kernel == KernelForm::wendland_c2 ? "Wendland C2" : "cubic spline", p.h(),
                               p.smoothing_ratio)});
  texts.push_back(
      {"pressure", "- sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) gradW_ij", "Monaghan 1992; thesis eq. 22", ""});
}

}  // namespace

std::vector<ActiveTerm> Dynamics::active_terms() const {
  Texts texts;
  add_medium(texts, parameters_, state_);
  for_each_term(parameters_, [&]<class Term>(const std::optional<Term>& term) {
    if constexpr (requires { text(*term, medium_); })
      if (term && !(std::is_same_v<Term, Friction> && parameters_.wall_slip))
        texts.push_back(text(*term, medium_));
  });
  if (parameters_.friction && parameters_.wall_slip)
    texts.push_back({"friction", "tau_w <= mu_A p", "Kato's thesis, eq. 33",
                     fmt::format("mu_A {}, on work pieces the smaller of it and the slip law",
                                 parameters_.friction->coefficient)});
  if (axisymmetric())
    texts.push_back({"axisymmetry", "rings about y = 0, hoop parts pair by pair",
                     "Brookshaw 2003; Garcia-Senz, Relano, Cabezon & Bravo 2009", ""});
  texts.push_back(
      {"walls", "pressure and velocity extrapolated from the fluid",
       "Adami, Hu & Adams 2012; thesis eq. 27-29",
       fmt::format("{}{}{}", parameters_.wall_model.slip == WallSlip::no_slip ? "no slip" : "free slip",
                   parameters_.wall_model.extrapolation == WallExtrapolation::fit ? ", fitted" : "",
                   parameters_.wall_model.suction ? "" : ", no suction")});
  if (const Vec& g = body_force_.gravity; g.norm() > 0)
    texts.push_back({"gravity", "g", "", fmt::format("({}, {}) m/s2", g[0], g[1])});
  return texts;
}

}  // namespace toryu::fluid
