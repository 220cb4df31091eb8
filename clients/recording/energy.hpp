#pragma once

#include <string>
#include <vector>

#include "messages.pb.h"

namespace sluice::clients {

// A field of Energy by its name, as numbers; vectors are filled up with zeros to `count`.
std::vector<double> energy_values(const Energy& energy, const std::string& field, std::size_t count);
void set_energy_values(Energy& energy, const std::string& field, const std::vector<double>& values);

}  // namespace sluice::clients
