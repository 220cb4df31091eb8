#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::clients {

// The program of that name beside this one's executable. Throws InputError when it is not there.
std::filesystem::path sibling(const std::string& name);

// Where the Python package stands: <executable>/../lib/sluice/python.
std::filesystem::path python_directory();

// Replaces this process by the program. Returns only by an exception.
[[noreturn]] void become(const std::filesystem::path& program, std::vector<std::string> arguments);

// Replaces this process by `/usr/bin/python3 arguments...`, with the package on its path.
[[noreturn]] void become_python(std::vector<std::string> arguments);

}  // namespace sluice::clients
