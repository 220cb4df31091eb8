#include "tests/fuzz/mutation.hpp"

#include <algorithm>

namespace sluice::test {
namespace {

class Mutation {
 public:
  Mutation(std::string& bytes, std::mt19937_64& random) : bytes_(bytes), random_(random) {}

  void change() {
    switch (below(7)) {
      case 0:
      case 1:
        return flip_bits();
      case 2:
        return overwrite(static_cast<char>(below(2) == 0 ? 0 : 0xFF));
      case 3:
        return scramble();
      case 4:
        return copy_piece();
      case 5:
        return cut_piece();
      default:
        return change_length();
    }
  }

 private:
  std::size_t below(std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, std::max<std::size_t>(limit, 1) - 1)(random_);
  }
  // The first kilobytes hold what everything else hangs on: half of the changes are there.
  std::size_t place() {
    return below(below(2) == 0 ? bytes_.size() : std::min<std::size_t>(bytes_.size(), 4096));
  }
  std::size_t length_from(std::size_t at) {
    return std::min(bytes_.size() - at, std::size_t{1} << below(13));
  }

  void flip_bits() {
    for (std::size_t n = std::size_t{1} << below(5); n > 0 && !bytes_.empty(); --n) {
      char& byte = bytes_[place()];
      byte = static_cast<char>(byte ^ (1 << below(8)));
    }
  }
  void overwrite(char with) {
    const std::size_t at = place();
    std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at), length_from(at), with);
  }
  void scramble() {
    const std::size_t at = place();
    std::generate_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at), length_from(at),
                    [this] { return static_cast<char>(below(256)); });
  }
  void copy_piece() {
    const std::size_t from = place(), to = place();
    bytes_.replace(to, length_from(from), bytes_.substr(from, length_from(from)));
  }
  void cut_piece() {
    const std::size_t at = place();
    bytes_.erase(at, length_from(at));
  }
  void change_length() {
    if (below(4) == 0)
      bytes_.append(below(5000), static_cast<char>(below(256)));
    else
      bytes_.resize(below(bytes_.size()));
  }

  std::string& bytes_;
  std::mt19937_64& random_;
};

}  // namespace

std::string mutated(std::string bytes, std::mt19937_64& random) {
  Mutation mutation(bytes, random);
  for (std::size_t n = 1 + random() % 3; n > 0; --n) mutation.change();
  return bytes;
}

}  // namespace sluice::test
