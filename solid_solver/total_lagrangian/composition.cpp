#include "solid_solver/total_lagrangian/composition.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace toryu::solid {

static_assert(dim == 2, "laminates are those of the plane");

namespace {

/// The jump is found so far, over itself, in at most so many rounds.
constexpr double jump_tolerance = 1e-10;
constexpr int most_rounds = 30;
/// Shares of another material below this are rounding.
constexpr double least_share = 1e-6;

/// H + c (x) N.
Tensor<double> bent(const Tensor<double>& H, const Vec& c, const Vec& N) {
  return {H[0] + c[0] * N[0], H[1] + c[0] * N[1], H[2] + c[1] * N[0], H[3] + c[1] * N[1]};
}

/// The rotation in I + H.
Mat rotation(const Tensor<double>& H) {
  const double cosine = 2.0 + H[0] + H[3], sine = H[2] - H[1], length = std::hypot(cosine, sine);
  Mat R;
  R << cosine, -sine, sine, cosine;
  return length > 0 ? Mat(R / length) : Mat(Mat::Identity());
}

/// What the particle in a slot sees of another material.
struct Sight {
  Mat kink = Mat::Zero();       ///< sum_j V_j (1 - s) X_ij (x) gradW_ij
  Mat crossings = Mat::Zero();  ///< the same of s^2 |gradW|/R
  Vec first = Vec::Zero();      ///< sum of s X_ij with that weight
  void add(double weight, double s, const Vec& X_ij) {
    kink += weight * (1 - s) * X_ij * X_ij.transpose();
    crossings -= weight * s * s * X_ij * X_ij.transpose();
    first += weight * s * X_ij;
  }
  /// Towards the other material: of the line that lies best on all crossings, of one alone the way itself.
  Vec normal() const {
    const bool line = crossings.determinant() > 1e-6 * crossings.trace() * crossings.trace();
    return (line ? Vec(crossings.inverse() * first) : first).normalized();
  }
};

}  // namespace

Composition::Composition(const Parameters& parameters, const Body& body,
                         const std::vector<std::uint32_t>& number, std::size_t slots)
    : materials_(parameters.all_materials()), used_(materials_.size(), 0), in_(slots / lane_count) {
  for (const Material& material : materials_) {
    laws_.push_back(law_of(material));
    penalty_of_.push_back(parameters.hourglass ? parameters.hourglass->stiffness(material.elastic) : 0.0);
  }
  for (auto* field : {&index_, &penalty_, &density_, &sound_speed_}) field->resize(slots);
  for (std::size_t k = 0; k < slots; ++k) {
    const std::uint32_t m = body.material[number[std::min(k, number.size() - 1)]];
    const ElasticMaterial& elastic = materials_[m].elastic;
    used_[m] = 1;
    material_.push_back(m);
    index_[k] = m;
    penalty_[k] = penalty_of_[m];
    density_[k] = elastic.density;
    sound_speed_[k] = elastic.bulk_sound_speed();
    auto& in_cluster = in_[k / lane_count];
    if (std::find(in_cluster.begin(), in_cluster.end(), m) == in_cluster.end()) in_cluster.push_back(m);
  }
  uniform_ = std::count(used_.begin(), used_.end(), 1) == 1;
  laminate_of_.assign(slots, 0);
}

void Composition::find_laminates(const VecField& X, std::size_t count, const Held& held, const Field& volume,
                                 const ReferencePairs& pairs, double reach) {
  if (uniform_) return;
  for (std::uint32_t other = 0; other < materials_.size(); ++other) {
    if (!uses(other)) continue;
    Field outside(material_.size());
    for (std::size_t k = 0; k < outside.size(); ++k) outside[k] = material_[k] == other ? 0.0 : 1.0;
    const ClampFaces faces(X, count, {outside, held.cells, held.fitted}, pairs.neighbours(), reach);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (material_[i] == other || held.mobile[i] == 0) continue;
      Sight sight;
      pairs.over_neighbours(i, [&](std::uint32_t j, double weight, const Vec& X_ij) {
        if (material_[j] == other && held.mobile[j] != 0) sight.add(weight, *faces.share(i, j), X_ij);
      });
      if (sight.first.isZero(0)) continue;
      const Tensor<Lanes> shape = pairs.shape(i / lane_count);
      const auto of_lane = [&](std::size_t n) { return shape[n][i % lane_count]; };
      Mat L;
      L << of_lane(0), of_lane(1), of_lane(2), of_lane(3);
      const Vec N = sight.normal();
      const double share = -N.dot(sight.kink * L * N);
      if (share > least_share) laminates_.push_back({i, other, std::min(share, 1.0), N});
    }
  }
  // Where three meet, the one that has most.
  std::sort(laminates_.begin(), laminates_.end(), [](const Laminate& a, const Laminate& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.share > b.share;
  });
  laminates_.erase(std::unique(laminates_.begin(), laminates_.end(),
                               [](const Laminate& a, const Laminate& b) { return a.slot == b.slot; }),
                   laminates_.end());
  laminate_of_.assign(material_.size(), static_cast<std::uint32_t>(laminates_.size()));
  for (std::uint32_t n = 0; n < laminates_.size(); ++n) laminate_of_[laminates_[n].slot] = n;
  balance(volume);
  // The penalty knows no jump of the strain: there it is that of the softer.
  for (const Laminate& laminate : laminates_)
    penalty_[laminate.slot] = std::min(penalty_[laminate.slot], penalty_of_[laminate.other]);
}

void Composition::balance(const Field& volume) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> given;  // from a material, to another [m2]
  for (const Laminate& laminate : laminates_)
    given[{material_[laminate.slot], laminate.other}] += laminate.share * volume[laminate.slot];
  for (Laminate& laminate : laminates_) {
    const std::uint32_t own = material_[laminate.slot], other = laminate.other;
    laminate.share *= std::min(1.0, given[{other, own}] / given[{own, other}]);
  }
}

Tensor<double> Composition::stress_of(std::uint32_t material, const Tensor<double>& H) const {
  return std::visit([&](const auto& law) { return law.stress(H); }, laws_[material]);
}

Composition::Layers Composition::layers(const Laminate& laminate, const Tensor<double>& H) const {
  const std::uint32_t material = material_[laminate.slot], other = laminate.other;
  const double phi = laminate.share;
  const Vec& N = laminate.normal;
  const ElasticMaterial &own = materials_[material].elastic, &beyond = materials_[other].elastic;
  const auto stiffness = [&](auto modulus) { return phi * modulus(own) + (1 - phi) * modulus(beyond); };
  const double G = stiffness([](const ElasticMaterial& m) { return m.shear_modulus(); });
  const double M =
      stiffness([](const ElasticMaterial& m) { return m.lame_lambda() + 2.0 * m.shear_modulus(); });
  // Broyden's method (1965), from what the slope is for small strains.
  const Mat R = rotation(H), NN = N * N.transpose();
  Mat inverse = R * (NN / M + (Mat::Identity() - NN) / G) * R.transpose();
  Layers both;
  const auto layer = [this](std::uint32_t of, const Tensor<double>& gradient) -> Layer {
    return {gradient, stress_of(of, gradient)};
  };
  const auto residual = [&](const Vec& c) {
    both = {layer(material, bent(H, -phi * c, N)), layer(other, bent(H, (1 - phi) * c, N))};
    const Tensor<double>&P_1 = both.own.P, &P_2 = both.other.P;
    return Vec((P_2[0] - P_1[0]) * N[0] + (P_2[1] - P_1[1]) * N[1],
               (P_2[2] - P_1[2]) * N[0] + (P_2[3] - P_1[3]) * N[1]);
  };
  Vec c = Vec::Zero(), r = residual(c);
  for (int round = 0; round < most_rounds; ++round) {
    const Vec step = -inverse * r;
    c += step;
    const Vec before = r;
    r = residual(c);
    if (!(step.norm() > jump_tolerance * c.norm())) break;
    const Vec image = inverse * (r - before);
    const Eigen::RowVector2d row = step.transpose() * inverse;
    const double scale = step.dot(image);
    if (scale != 0) inverse += (step - image) * row / scale;
  }
  return both;
}

Tensor<Lanes> Composition::stress(std::size_t cluster, const Tensor<Lanes>& H) const {
  const std::size_t first = cluster * lane_count;
  const Lanes index = load(index_, first);
  Tensor<Lanes> P{0.0, 0.0, 0.0, 0.0};
  for (const std::uint32_t m : in_[cluster]) {
    const Tensor<Lanes> of_m = std::visit([&](const auto& law) { return law.stress(H); }, laws_[m]);
    const auto here = (index >= Lanes(m - 0.5)) & (index <= Lanes(m + 0.5));
    for (std::size_t n = 0; n < P.size(); ++n) P[n] = select(here, of_m[n], P[n]);
  }
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (laminate_of_[first + lane] == laminates_.size()) continue;
    const Laminate& laminate = laminates_[laminate_of_[first + lane]];
    const auto both = layers(laminate, {H[0][lane], H[1][lane], H[2][lane], H[3][lane]});
    for (std::size_t n = 0; n < P.size(); ++n)
      P[n].value[lane] = (1 - laminate.share) * both.own.P[n] + laminate.share * both.other.P[n];
  }
  return P;
}

double Composition::energy(std::size_t slot, const Tensor<double>& H) const {
  const auto of = [&](std::uint32_t material, const Tensor<double>& gradient) {
    return std::visit([&](const auto& law) { return law.energy(gradient); }, laws_[material]);
  };
  if (uniform_ || laminate_of_[slot] == laminates_.size()) return of(material_[slot], H);
  const Laminate& laminate = laminates_[laminate_of_[slot]];
  const auto both = layers(laminate, H);
  return (1 - laminate.share) * of(material_[slot], both.own.H) +
         laminate.share * of(laminate.other, both.other.H);
}

Tensor<double> Composition::own_gradient(std::size_t slot, const Tensor<double>& H) const {
  if (uniform_ || laminate_of_[slot] == laminates_.size()) return H;
  return layers(laminates_[laminate_of_[slot]], H).own.H;
}

double Composition::stiffening(const Tensor<Field>& H, std::size_t count) const {
  double largest = 1;
  for (std::uint32_t m = 0; m < materials_.size(); ++m) {
    if (!uses(m)) continue;
    const double stiffest = std::visit(
        [&](const auto& law) {
          double found = law.longitudinal_modulus(1.0, 1.0);
          const double unloaded = found;
          for (std::size_t i = 0; i < count; i += lane_count) {
            const auto [larger, smaller] = principal_stretches(load(H, i));
            const Lanes modulus =
                max(law.longitudinal_modulus(larger, smaller), law.longitudinal_modulus(smaller, larger));
            // idle lanes stand still among particles that move: what they hold is no stretch
            for (std::size_t k = i; k < std::min(i + lane_count, count); ++k)
              if (material_[k] == m) found = std::max(found, modulus[k - i]);
          }
          return found / unloaded;
        },
        laws_[m]);
    largest = std::max(largest, stiffest);
  }
  return largest;
}

}  // namespace toryu::solid
