#include "pair_sph.hpp"

#include <limits>
#include <stdexcept>

#include "neighbour_request.hpp"
#include "pair_sweeps.ipp"

namespace toryu::lammps_fluid {

PairSph::~PairSph() {
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairSph::coeff(int, char**) {
  const int n = atom->ntypes + 1;
  if (!allocated) {
    memory->create(setflag, n, n, "pair:setflag");
    memory->create(cutsq, n, n, "pair:cutsq");
  }
  allocated = 1;
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) setflag[i][j] = 1;
}

void PairSph::init_style() {
  comm_forward = 3;  // the most that is sent at a time
  request_full_list(*neighbor, this, instance_me);
}

double* PairSph::custom(const char* name) const {
  int is_double = 0, columns = 0;
  const int index = atom->find_custom(name, is_double, columns);
  if (index < 0 || !is_double) throw std::logic_error(std::string("LAMMPS holds no ") + name);
  return atom->dvector[index];
}

int PairSph::pack_forward_comm(int count, int* which, double* buffer, int, int*) {
  int n = 0;
  for (int k = 0; k < count; ++k)
    for (const auto* field : sent_) buffer[n++] = (*field)[static_cast<std::size_t>(which[k])];
  return n;
}

void PairSph::unpack_forward_comm(int count, int first, double* buffer) {
  for (int i = first; i < first + count; ++i)
    for (auto* field : sent_) (*field)[static_cast<std::size_t>(i)] = *buffer++;
}

void PairSph::send(std::vector<std::vector<double>*> fields) {
  sent_ = std::move(fields);
  comm_forward = static_cast<int>(sent_.size());
  comm->forward_comm_pair(this);
}

void PairSph::sort_lists() {
  const auto size = static_cast<std::size_t>(atom->nmax);
  first_wall_.resize(size);
  first_interface_.resize(size);
  const auto* tag = atom->tag;
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    int *begin = list->firstneigh[i], *end = begin + list->numneigh[i];
    for (int* j = begin; j != end; ++j) *j &= NEIGHMASK;
    std::sort(begin, end, [&](int a, int b) { return tag[a] < tag[b]; });
    const auto first = [&](int number) {
      return static_cast<int>(std::partition_point(begin, end, [&](int j) { return tag[j] <= number; }) -
                              begin);
    };
    first_wall_[static_cast<std::size_t>(i)] = first(physics.fluid_count);
    first_interface_[static_cast<std::size_t>(i)] = first(physics.fluid_count + physics.wall_count);
  }
}

void PairSph::find_pressures() {
  const auto all = static_cast<std::size_t>(atom->nlocal + atom->nghost),
             own = static_cast<std::size_t>(atom->nlocal);
  for (auto* field : {&rho_, &p_, &p_rho2_, &V_, &m_, &wx_, &wy_, &gx_, &gy_, &from_x_, &from_y_, &fx_, &fy_})
    if (field->size() < all) field->resize(static_cast<std::size_t>(atom->nmax));
  std::copy_n(custom("rho"), own, rho_.begin());
  std::copy_n(atom->rmass, all, m_.begin());
  send({&rho_});
  for (std::size_t i = 0; i < all; ++i) {
    V_[i] = m_[i] / rho_[i];
    if (atom->type[i] != Type::fluid) continue;
    p_[i] = physics.pressure(rho_[i]);
    p_rho2_[i] = p_[i] / (rho_[i] * rho_[i]);
  }
}

void PairSph::evaluate(RatesOf rates_of) {
  if (first_wall_.empty() || neighbor->ago == 0) sort_lists();
  find_pressures();
  const bool density = rates_of != RatesOf::velocity, velocity = rates_of != RatesOf::density;
  with_kernel([&]<class W>(const W& kernel) {
    if (velocity) {
      extrapolate(kernel);
      send({&p_, &wx_, &wy_});
      const auto all = static_cast<std::size_t>(atom->nlocal + atom->nghost);
      for (std::size_t i = 0; i < all; ++i) p_rho2_[i] = p_[i] / (rho_[i] * rho_[i]);
    }
    if (density && physics.renormalised) {
      density_gradients(kernel);
      send({&gx_, &gy_});
    }
    if (density && velocity)
      physics.renormalised ? rates<W, true, true, true>(kernel) : rates<W, true, true, false>(kernel);
    else if (velocity)
      rates<W, false, true, false>(kernel);
    else if (physics.renormalised)
      rates<W, true, false, true>(kernel);
    else
      rates<W, true, false, false>(kernel);
    if (velocity && physics.interface_count > 0) reaction(kernel);
  });
}

void PairSph::add_load(double dt) {
  double *pressure = custom("load_p"), *load_x = custom("load_x"), *load_y = custom("load_y");
  for (int i = 0; i < atom->nlocal; ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (atom->type[i] == Type::interface) {
      pressure[i] += p_[n] * dt;
      load_x[i] += fx_[n] * dt;
      load_y[i] += fy_[n] * dt;
    } else if (atom->type[i] == Type::fluid && first_interface_[n] < neighbours(i)) {
      received_.add(0, m_[n] * from_x_[n] * dt);
      received_.add(1, m_[n] * from_y_[n] * dt);
    }
  }
}

void PairSph::give_impulse(const double* impulse) {
  double *load_x = custom("load_x"), *load_y = custom("load_y");
  find_pressures();
  with_kernel([&](const auto& kernel) {
    for (int i = 0; i < atom->nlocal; ++i) {
      const auto n = static_cast<std::size_t>(i);
      wx_[n] = wy_[n] = 0;
      if (atom->type[i] != Type::interface) continue;
      const double* J = impulse + dim * place(i);
      double sum = 0;
      over(i, 0, neighbours(i), kernel,
           [&](std::size_t j, double, double, double r, double) { sum += m_[j] * kernel.value(r); });
      if (sum > smallest_share * m_[n] * kernel.value(0)) {
        wx_[n] = -J[0] / sum;
        wy_[n] = -J[1] / sum;
      } else {
        load_x[i] -= J[0];
        load_y[i] -= J[1];
      }
    }
    send({&wx_, &wy_});
    for (int i = 0; i < atom->nlocal; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (atom->type[i] != Type::fluid || first_interface_[n] == neighbours(i)) continue;
      double dv[dim] = {};
      over(i, first_interface_[n], neighbours(i), kernel,
           [&](std::size_t j, double, double, double r, double) {
             const double W = kernel.value(r);
             dv[0] += wx_[j] * W;
             dv[1] += wy_[j] * W;
           });
      double work = 0;
      for (int a = 0; a < dim; ++a) {
        received_.add(static_cast<std::size_t>(a), m_[n] * dv[a]);
        work += m_[n] * dv[a] * (atom->v[i][a] + 0.5 * dv[a]);
        atom->v[i][a] += dv[a];
      }
      received_.add(dim, work);
    }
  });
}

void PairSph::add_impedance(double* by_place) const {
  with_kernel([&](const auto& kernel) {
    for (int i = 0; i < atom->nlocal; ++i) {
      if (atom->type[i] != Type::interface) continue;
      double sum[dim] = {};
      over(i, 0, neighbours(i), kernel, [&](std::size_t j, double x, double y, double, double G) {
        sum[0] += V_[j] * G * x;
        sum[1] += V_[j] * G * y;
      });
      const double factor = 2 * physics.rho_0 * physics.c_0 * V_[static_cast<std::size_t>(i)];
      for (int a = 0; a < dim; ++a) by_place[dim * place(i) + a] += factor * sum[a];
    }
  });
}

}  // namespace toryu::lammps_fluid
