#include "tests/cli/documents.hpp"

#include <fstream>
#include <sstream>

namespace sluice::test {

std::vector<Block> fenced_blocks(const std::filesystem::path& document) {
  std::vector<Block> blocks;
  std::ifstream stream(document);
  std::string line, before;
  bool inside = false;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.starts_with("```") && !inside) {
      blocks.push_back({number, line.substr(3), "", !before.starts_with("<!-- not run:")});
      inside = true;
    } else if (line.starts_with("```")) {
      inside = false;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
    before = line;
  }
  return blocks;
}

std::vector<std::vector<std::string>> sluice_calls(const Block& block) {
  std::vector<std::vector<std::string>> calls;
  std::istringstream lines(block.text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream stream(line.substr(0, line.find_first_of("#&|>")));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (!words.empty() && words.front() == "sluice") calls.push_back(std::move(words));
  }
  return calls;
}

}  // namespace sluice::test
