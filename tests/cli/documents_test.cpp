// What the documents say is done: their commands run, their options exist, their scenes pass, and every field
// of a scene is explained.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>

#include <set>

#include "scene.pb.h"
#include "tests/cli/command.hpp"
#include "tests/cli/documents.hpp"
#include "tests/cli/scenes.hpp"

namespace sluice::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kSource = SLUICE_SOURCE;

struct Page {
  const char* name;
  const char* file;
  int scripts;  // blocks of commands that it has at least
};

class Document : public testing::TestWithParam<Page> {
 protected:
  const fs::path file = kSource / GetParam().file;
};

// The scenes as the documents run them, only coarser or shorter.
constexpr const char* kQuickSluice = R"(#!/bin/sh
case "$*" in
  replay*|check*) exec {0}/sluice "$@" ;;
  *rising_gate.scene*) exec {0}/sluice "$@" --set spacing=0.004 ;;
  python*hold_level.py*) exec {0}/sluice "$@" --spacing 0.02 --until 0.5 ;;
  python*sweep_density.py*) exec {0}/sluice "$@" --spacing 0.022 --until 0.05 ;;
  *) exec {0}/sluice "$@" ;;
esac
)";

TEST_P(Document, ItsCommandsRunOneAfterTheOther) {
  const TemporaryDirectory directory;
  fs::create_directory(directory.path() / "bin");
  fs::create_directory_symlink(kSource / "clients", directory.path() / "clients");
  const fs::path quick = directory.write("bin/sluice", fmt::format(fmt::runtime(kQuickSluice), SLUICE_BIN));
  fs::permissions(quick, fs::perms::owner_all);

  int run = 0;
  for (const Block& block : fenced_blocks(file)) {
    if (block.language != "sh" || !block.run) continue;
    const Outcome outcome = run_script(block.text, directory.path(), directory.path() / "bin");
    EXPECT_EQ(outcome.code, 0) << file << ":" << block.line << "\n" << block.text << outcome.out;
    ++run;
  }
  EXPECT_GE(run, GetParam().scripts) << "the blocks of " << file << " are not found any more";
}

TEST_P(Document, EveryCommandAndOptionExists) {
  const TemporaryDirectory directory;
  for (const Block& block : fenced_blocks(file)) {
    if (block.language != "sh") continue;
    for (const auto& call : sluice_calls(block)) {
      const Outcome help = run_program("sluice", {call.at(1), "--help"}, directory.path());
      EXPECT_EQ(help.code, 0) << file << ":" << block.line << " " << call[1];
      for (const std::string& word : call) {
        if (!word.starts_with("-")) continue;
        EXPECT_THAT(help.out, HasSubstr(word)) << file << ":" << block.line << " " << call[1];
      }
    }
  }
}

TEST_P(Document, ItsScenesPassTheCheck) {
  for (const Block& block : fenced_blocks(file)) {
    if (block.language != "textproto") continue;
    const TemporaryDirectory directory;
    const bool whole = block.text.starts_with("name:");
    // Motions are shown on their own: each stands for that of the gate.
    std::vector<std::string> scenes;
    for (std::string rest = whole ? "" : block.text; !rest.empty();) {
      const auto end = rest.find("\n\n");
      scenes.push_back(
          with(kSmallScene, "prescribed { constant { velocity: [0, 0.7] } }", rest.substr(0, end)));
      rest = end == std::string::npos ? "" : rest.substr(end + 2);
    }
    if (whole) scenes.push_back(block.text);
    for (const std::string& scene : scenes) {
      directory.write("shown.scene", scene);
      const Outcome outcome = run_program("sluice", {"check", "shown.scene"}, directory.path());
      EXPECT_EQ(outcome.code, 0) << file << ":" << block.line << "\n" << scene << outcome.err;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cli, Document,
                         testing::Values(Page{"Front", "README.md", 4},
                                         Page{"Clients", "clients/README.md", 4},
                                         Page{"Tutorial", "clients/TUTORIAL.md", 6},
                                         Page{"Benchmark", "tests/benchmark/README.md", 1}),
                         [](const auto& document) { return document.param.name; });

TEST(Scenes, TheOnesShippedPassTheCheck) {
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(kSource / "clients/scenes")) {
    if (entry.path().extension() != ".scene") continue;
    const TemporaryDirectory directory;
    const Outcome outcome = run_program("sluice", {"check", entry.path().string()}, directory.path());
    EXPECT_EQ(outcome.code, 0) << entry.path() << outcome.err;
    ++seen;
  }
  EXPECT_GE(seen, 4);
}

// All message types that a scene is made of.
void collect(const google::protobuf::Descriptor& type, std::set<const google::protobuf::Descriptor*>& seen) {
  if (!seen.insert(&type).second) return;
  for (int i = 0; i < type.field_count(); ++i)
    if (const auto* part = type.field(i)->message_type()) collect(*part, seen);
}

TEST(Reference, ExplainsEveryFieldOfASceneAndNoOther) {
  const std::string text = read_text(kSource / "clients/README.md");
  std::set<const google::protobuf::Descriptor*> types;
  collect(*Scene::descriptor(), types);
  for (const auto* type : types) {
    const auto begin = text.find("\n### " + type->name() + "\n");
    ASSERT_NE(begin, std::string::npos) << type->name();
    const std::string section = text.substr(begin, text.find("\n### ", begin + 1) - begin);
    std::size_t rows = 0;
    for (auto at = section.find("\n| `"); at != std::string::npos; at = section.find("\n| `", at + 1)) ++rows;
    EXPECT_EQ(rows, static_cast<std::size_t>(type->field_count())) << type->name();
    for (int i = 0; i < type->field_count(); ++i)
      EXPECT_THAT(section, HasSubstr("\n| `" + type->field(i)->name() + "` |")) << type->name();
  }
}

}  // namespace
}  // namespace sluice::test
