#pragma once

#include <span>
#include <vector>

#include "fluid/kinematics.hpp"

namespace sluice::server {

// Doubles in a row of the arrays `kinematics` and `wrenches`; messages.proto has their layout.
inline constexpr std::size_t kKinematicsRow = 19;
inline constexpr std::size_t kWrenchRow = 6;
inline constexpr std::size_t kLedgerRow = 29;

// Row to struct. Precondition: `row` has 19 entries, the quaternion (3-6) of unit length.
fluid::Kinematics read_kinematics(std::span<const double> row);

void append(std::vector<double>& rows, const fluid::Kinematics& kinematics);
void append(std::vector<double>& rows, const fluid::Wrench& wrench);

}  // namespace sluice::server
