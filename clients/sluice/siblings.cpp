#include "clients/sluice/siblings.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

std::filesystem::path executable_directory() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace

std::filesystem::path sibling(const std::string& name) {
  const auto path = executable_directory() / name;
  if (!std::filesystem::exists(path))
    throw protocol::InputError(path.string() +
                               " is missing; build or install all programs of sluice together");
  return path;
}

std::filesystem::path python_directory() {
  return executable_directory().parent_path() / "lib" / "sluice" / "python";
}

void become(const std::filesystem::path& program, std::vector<std::string> arguments) {
  std::string path = program.string();
  std::vector<char*> argv{path.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(path.c_str(), argv.data());
  throw std::system_error(errno, std::generic_category(), "cannot start " + path);
}

void become_python(std::vector<std::string> arguments) {
  // Debian's modules (h5py, matplotlib) belong to this interpreter, not to another first in PATH.
  const std::filesystem::path interpreter = "/usr/bin/python3";
  std::string path = python_directory().string();
  if (const char* before = std::getenv("PYTHONPATH"); before && *before) path += std::string(":") + before;
  setenv("PYTHONPATH", path.c_str(), 1);
  become(interpreter, std::move(arguments));
}

}  // namespace sluice::clients
