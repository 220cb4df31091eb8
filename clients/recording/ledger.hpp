#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

// What acted on a body over a recorded run, from the exchanges; world frame, moments about the centre of
// mass, per metre of depth in two dimensions.
struct BodyLedger {
  struct Impulse {
    std::array<double, 3> force{}, moment{};  // [N s], [N m s]
  };

  std::string name;
  bool is_free = false;
  double since = 0,
         time = 0;  // when it begins, at the start or where the body is released; that it covers [s]
  // By name: pressure, viscous, penetration; of a free body gravity, contact, joints, drive and locks. In
  // recordings before format 3 what joints gave is under contact.
  std::vector<std::pair<std::string, Impulse>> impulses;
  double work_of_liquid = 0;  // on the body, as the liquid's steps did it [J]

  // Of a free body only.
  std::vector<std::pair<std::string, double>> works;         // of contact, joints, drive and locks [J]
  double largest_indicator = 0, largest_indicator_time = 0;  // of BodyStability with what was wet [-], [s]
  std::array<double, 3> momentum_change{};                   // [kg m/s]
  double third_law_residual = 0;  // momentum change less all impulses, over those of the liquid [-]
  double energy_created = 0;      // at the interface, over the work that passed through it [-]
  double mean_iterations = 0, largest_residual = 0;
  int most_iterations = 0;
};

// One for each body. Precondition: the recording has bodies, a frame and an exchange.
std::vector<BodyLedger> read_ledgers(const Reader& recording);

std::string to_text(const BodyLedger& ledger);

}  // namespace sluice::clients
