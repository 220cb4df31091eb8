#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::test {

// A fenced block of a Markdown document. One that the tests cannot run says so in the line above it:
// <!-- not run: reason -->
struct Block {
  int line = 0;  // of its fence
  std::string language;
  std::string text;
  bool run = true;
};

std::vector<Block> fenced_blocks(const std::filesystem::path& document);

// The lines of a block that call sluice, in words, without redirections, comments and what follows a & or |.
std::vector<std::vector<std::string>> sluice_calls(const Block& block);

}  // namespace sluice::test
