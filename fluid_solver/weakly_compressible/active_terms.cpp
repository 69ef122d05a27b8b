/// What the log and the report say of the terms of a case.

#include <fmt/format.h>

#include "fluid_solver/weakly_compressible/dynamics.hpp"

namespace toryu::fluid {

namespace {

using Terms = std::vector<ActiveTerm>;

void add_medium(Terms& terms, const Parameters& p, const EquationOfState& state) {
  terms.push_back({"equation of state", "p = rho_0 c_0^2/gamma [(rho/rho_0)^gamma - 1]",
                   "Monaghan 1994, eq. 3",
                   fmt::format("rho_0 {} kg/m3, c_0 {} m/s, gamma {}", state.rho_0, state.c_0, state.gamma)});
  if (p.background_pressure)
    terms.push_back({"background pressure", "p_b added to the equation of state",
                     "Colagrossi, Bouscasse, Antuono & Marrone 2012", fmt::format("p_b {} Pa", state.p_b)});
  terms.push_back({"continuity", "Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij", "eq. 18",
                   fmt::format("{}, h = {:.4g} m = {} d_0",
                               p.kernel == KernelForm::wendland_c2 ? "Wendland C2" : "cubic spline", p.h(),
                               p.smoothing_ratio)});
  terms.push_back({"pressure", "- sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) gradW_ij", "eq. 22", ""});
  if (const auto& d = p.density_diffusion)
    terms.push_back({"density diffusion", "delta h c_0 sum_j V_j psi_ij . gradW_ij",
                     d->gradient == DiffusionGradient::renormalised ? "Marrone et al. 2011, eq. 18-21"
                                                                    : "Molteni & Colagrossi 2009",
                     fmt::format("delta {}", d->delta)});
}

void add_viscosities(Terms& terms, const Parameters& p) {
  if (const auto& a = p.artificial_viscosity)
    terms.push_back(
        {"artificial viscosity", "- sum_j m_j Pi_ij gradW_ij", "Monaghan 1992, eq. 23-24",
         fmt::format("alpha {}, beta {}; acts like a kinematic viscosity of {:.3g} m2/s", a->alpha, a->beta,
                     effective_kinematic_viscosity(a->alpha, p.h(), p.sound_speed))});
  if (const auto& l = p.laminar_viscosity)
    terms.push_back({"laminar viscosity", "sum_j m_j 2 mu/(rho_i rho_j) x_ij . gradW_ij/r^2 v_ij",
                     "Morris, Fox & Zhu 1997", fmt::format("mu {} Pa s", l->dynamic_viscosity)});
  if (const auto& law = p.power_law)
    terms.push_back({"power law", "eta = m gdot^(n-1), harmonic mean of a pair",
                     "Ostwald 1925, de Waele 1923",
                     fmt::format("m {} Pa s^n, n {}, {} to {} Pa s", law->consistency, law->exponent,
                                 law->smallest_viscosity, law->largest_viscosity)});
  if (const auto& law = p.carreau)
    terms.push_back(
        {"Carreau", "eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda gdot)^2)^((n-1)/2)", "Carreau 1972",
         fmt::format("eta_0 {} Pa s, eta_inf {} Pa s, lambda {} s, n {}", law->zero_shear_viscosity,
                     law->infinite_shear_viscosity, law->relaxation_time, law->exponent)});
}

void add_walls(Terms& terms, const Parameters& p, const std::optional<WorkPieceFriction>& friction) {
  if (const auto& r = p.wall_repulsion)
    terms.push_back({"wall repulsion", "m_i m_w/(rho_0 d_0^2) B c_0^2/d_0 (1 - r/r_0), r < r_0",
                     "in the manner of Monaghan & Kajtar 2009",
                     fmt::format("B {}, r_0 {} d_0", r->strength, r->range)});
  if (friction)
    terms.push_back({"friction", "F_s = mu_A sum_f V_f max(p_f, 0) d_s v_fs/sqrt(v_fs^2 + eps^2) W_sf",
                     "eq. 33, mended", friction->parameters()});
  terms.push_back({"walls", "pressure and velocity extrapolated from the fluid",
                   "Adami, Hu & Adams 2012, eq. 27-29",
                   fmt::format("{}{}", p.wall_model.slip == WallSlip::no_slip ? "no slip" : "free slip",
                               p.wall_model.suction ? "" : ", no suction")});
}

void add_choices_of_discretisation(Terms& terms, const Parameters& p) {
  if (p.particle_shifting)
    terms.push_back({"particle shifting", "-A h u_max dt sum_j V_j [1 + R (W_ij/W(d_0))^4] gradW_ij",
                     "Lind et al. 2012, Sun et al. 2017",
                     fmt::format("A {}", p.particle_shifting->strength)});
  if (p.tensile_control)
    terms.push_back({"tensile control", "p_j/rho_j^2 - p_i/rho_i^2 where p_i < 0 inside the fluid",
                     "Sun et al. 2018", ""});
  if (p.consistent_gradients)
    terms.push_back({"consistent gradients", "sum_j V_j (f_j - f_i) L_i gradW_ij of velocity and pressure",
                     "Randles & Libersky 1996", ""});
}

void add_body_forces(Terms& terms, const Parameters& p, const Vec& gravity) {
  if (const auto& force = p.central_force)
    terms.push_back({"central force", "-Omega^2 (x - x_c)", "Monaghan & Rafiee 2013",
                     fmt::format("Omega {} 1/s", force->rate)});
  if (gravity.norm() > 0)
    terms.push_back({"gravity", "g", "", fmt::format("({}, {}) m/s2", gravity[0], gravity[1])});
}

}  // namespace

std::vector<ActiveTerm> Dynamics::active_terms() const {
  Terms terms;
  add_medium(terms, parameters_, state_);
  add_viscosities(terms, parameters_);
  add_walls(terms, parameters_, friction_);
  add_choices_of_discretisation(terms, parameters_);
  add_body_forces(terms, parameters_, body_force_.gravity);
  return terms;
}

}  // namespace toryu::fluid
