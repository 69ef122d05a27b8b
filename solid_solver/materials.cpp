/// What the regions of a solid are made of.
#include <algorithm>
#include <limits>

#include "solid_solver/parameters.hpp"

namespace toryu::solid {

double Parameters::largest_speed() const {
  if (limits.speed > 0) return limits.speed;
  return formulation == Formulation::rigid ? std::numeric_limits<double>::infinity() : fastest_sound();
}

std::vector<Material> Parameters::all_materials() const {
  std::vector<Material> all{{.law = law, .yeoh = yeoh, .elastic = material}};
  all.insert(all.end(), materials.begin(), materials.end());
  return all;
}

std::vector<std::uint32_t> Parameters::materials_of_regions() const {
  std::vector<std::uint32_t> indices;
  for (const Region& region : regions) {
    const auto named = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& each) { return each.name == region.material; });
    const bool own = region.material.empty() || named == materials.end();
    indices.push_back(own ? 0 : static_cast<std::uint32_t>(named - materials.begin()) + 1);
  }
  return indices;
}

double Parameters::fastest_sound() const {
  const auto all = all_materials();
  double fastest = 0;
  for (const auto index : materials_of_regions())
    fastest = std::max(fastest, all[index].elastic.longitudinal_sound_speed());
  return fastest;
}

ElasticMaterial Parameters::material_in_contact() const {
  const auto all = all_materials();
  std::optional<ElasticMaterial> softest;
  double lightest = std::numeric_limits<double>::infinity();
  for (const auto index : materials_of_regions()) {
    const ElasticMaterial& each = all[index].elastic;
    if (!softest || each.bulk_modulus() < softest->bulk_modulus()) softest = each;
    lightest = std::min(lightest, each.density);
  }
  return {lightest, softest->youngs_modulus, softest->poissons_ratio};
}

}  // namespace toryu::solid
