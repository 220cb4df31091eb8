#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "protocol/error.hpp"

namespace sluice::benchmark {

// The named ones of `all`, all of them when no name is given. Throws InputError for a name that is not there.
template <typename Named>
std::vector<Named> select(const std::vector<Named>& all, const std::vector<std::string>& names,
                          const std::string& what) {
  if (names.empty()) return all;
  std::vector<Named> chosen;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Named& candidate) { return candidate.name == name; });
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const Named& candidate : all) known.push_back(candidate.name);
      throw protocol::InputError(
          fmt::format("there is no {} '{}'; there are {}", what, name, fmt::join(known, ", ")));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace sluice::benchmark
