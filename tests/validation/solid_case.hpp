/// A solid case of the project, run inside the test.
#pragma once

#include "common/case/case_file.hpp"
#include "tests/unit/solid_solver/samples.hpp"

namespace toryu::solid {

/// `overrides` as after --set: "solid.spacing=0.002".
inline std::unique_ptr<SolidModel> solid_case(const std::string& name,
                                              const std::vector<std::string>& overrides = {}) {
  CaseFile file(std::string(CASES "/") + name, overrides);
  const Scene scene = read_scene(file);
  Parameters parameters;
  file.read("solid", parameters, "");
  file.ignore_sections({"fluid", "coupling"});
  take_motions(file, scene, parameters);
  file.throw_if_faulty();
  return model_of(parameters, scene);
}

}  // namespace toryu::solid
