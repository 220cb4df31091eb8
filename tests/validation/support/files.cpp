#include "validation/support/files.hpp"

#include <fmt/format.h>

namespace sluice::validation {

namespace {

std::filesystem::path shared_files() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share" / "sluice";
}

}  // namespace

std::filesystem::path case_file(const std::string& name) {
  return shared_files() / "validation" / name;
}

std::filesystem::path shipped_scene(const std::string& name) {
  return shared_files() / "scenes" / (name + ".scene");
}

std::vector<std::string> with_spacing(double spacing, const std::vector<std::string>& overrides) {
  std::vector<std::string> all{fmt::format("spacing={}", spacing)};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return all;
}

}  // namespace sluice::validation
