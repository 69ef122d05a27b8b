/// The solid's time loop without a fluid.
#pragma once

#include "common/scene/scene.hpp"
#include "solid_solver/solid_run.hpp"

namespace toryu {

/// Runs to the end time of the scene; no messages, no other process.
void run_alone(const Scene& scene, SolidRun& run);

}  // namespace toryu
