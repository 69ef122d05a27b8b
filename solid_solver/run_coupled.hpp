/// The solid's time loop with a fluid: windows granted by the coupler.
#pragma once

#include "common/link/participant.hpp"
#include "common/scene/scene.hpp"
#include "solid_solver/solid_run.hpp"

namespace toryu {

/// Joins the run and takes windows until it is over. In each window the load is constant and the solid takes
/// as many equal sub-steps as its stability needs.
void run_coupled(SolidLink& link, SolidRun& run);

}  // namespace toryu
