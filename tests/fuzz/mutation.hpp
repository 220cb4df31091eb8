#pragma once

#include <random>
#include <string>

namespace sluice::test {

// Something else than the file was: bits flipped, pieces overwritten, moved, doubled or left out, an end that
// is missing or too long; one such change or several.
std::string mutated(std::string bytes, std::mt19937_64& random);

}  // namespace sluice::test
