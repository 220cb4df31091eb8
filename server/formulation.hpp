#pragma once

#include "fluid/setup.hpp"
#include "protocol/scene_file.hpp"

namespace sluice::server {

// The solver's form of the scene's choices. Fields that are left out keep the solver's defaults.
fluid::Formulation to_formulation(const Formulation& formulation);

}  // namespace sluice::server
