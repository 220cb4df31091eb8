#include "protocol/scene_file.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string where(const SceneFile& file, const char* field) {
  const Location at = file.locate(field);
  return std::filesystem::path(at.file).filename().string() + ":" + std::to_string(at.line) + ":" +
         std::to_string(at.column);
}

TEST(SceneFile, ReadsText) {
  const TemporaryDirectory directory;
  const auto file = SceneFile::load(directory.write("a.scene", kScene));
  EXPECT_EQ(file.scene().spacing(), 0.01);
  EXPECT_EQ(file.scene().body_size(), 2);
  EXPECT_THAT(file.scene().domain().max(), ElementsAre(1, 0.5));
}

TEST(SceneFile, ReadsJsonAsTheSameScene) {
  const TemporaryDirectory directory;
  const auto text = SceneFile::load(directory.write("a.scene", kScene));
  std::string json;
  ASSERT_TRUE(google::protobuf::util::MessageToJsonString(text.scene(), &json).ok());
  const auto same = SceneFile::load(directory.write("a.json", json));
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(same.scene(), text.scene()));
  EXPECT_EQ(where(same, "spacing"), "a.json:0:0");
}

TEST(SceneFile, KnowsWhereEveryFieldStands) {
  const TemporaryDirectory directory;
  const auto file = SceneFile::load(directory.write("a.scene", kScene));
  EXPECT_EQ(where(file, "dimension"), "a.scene:2:1");
  EXPECT_EQ(where(file, "liquid.viscosity"), "a.scene:5:10");
  EXPECT_EQ(where(file, "fluid[0].box.max"), "a.scene:7:27");
  EXPECT_EQ(where(file, "body[0]"), "a.scene:8:1");
  EXPECT_EQ(where(file, "body[1]"), "a.scene:14:1");
  EXPECT_EQ(where(file, "body[1].ball.radius"), "a.scene:16:10");
  EXPECT_EQ(where(file, "body[1].prescribed.keyframes.key[1].offset[1]"), "a.scene:19:21");
}

TEST(SceneFile, LocatesAnAbsentFieldAtItsNearestAncestor) {
  const TemporaryDirectory directory;
  const auto file = SceneFile::load(directory.write("a.scene", kScene));
  EXPECT_EQ(where(file, "liquid.sound_speed"), "a.scene:5:1");
  EXPECT_EQ(where(file, "body[1].prescribed.keyframes.key[1].angle"), "a.scene:19:5");
  EXPECT_EQ(where(file, "body[1].mass"), "a.scene:14:1");
  EXPECT_EQ(where(file, "output.rate"), "a.scene:0:0");
}

TEST(SceneFile, ShowsTheExampleOfTheDocumentation) {
  EXPECT_EQ(
      errors_of(with_line(12, "  density: -5")),
      "a.scene:12:3: body[0].density: -5 kg/m^3 is not positive; give the body's density, water is 1000");
}

TEST(SceneFile, FindsUnknownFields) {
  EXPECT_EQ(errors_of(with_line(12, "  densty: 500 mass: 3")),
            "a.scene:12:3: densty: Body has no such field; did you mean density?");
  EXPECT_EQ(errors_of(with_line(12, "\tdensty : 500 mass: 3")),
            "a.scene:12:2: densty: Body has no such field; did you mean density?");
  EXPECT_EQ(
      errors_of(with_line(6, "domain { max: [1, 0.5] whatever { x: [1] } }")),
      "a.scene:6:24: whatever: Domain has no such field; it has min, max, open, periodic, surface, moving");
}

TEST(SceneFile, FindsWhatIsNoText) {
  EXPECT_EQ(errors_of(with_line(3, "spacing: \"small\"")), "a.scene:3:10: Expected double, got: \"small\"");
  EXPECT_EQ(errors_of(with_line(6, "domain { max: [1, 0.5] open: SKY }")),
            "a.scene:6:30: Unknown enumeration value of \"SKY\" for field \"open\".");
  EXPECT_EQ(errors_of(with_line(4, "spacing: 0.02")),
            "a.scene:4:1: Non-repeated field \"spacing\" is specified multiple times.");
  EXPECT_EQ(errors_of(with_line(10, "  box { } ball { }")),
            "a.scene:10:11: Field \"ball\" is specified along with field \"box\", another member of oneof "
            "\"shape\".");
  EXPECT_THAT(errors_of(kScene + "body {"), StartsWith("a.scene:21:7: Expected identifier"));
}

TEST(SceneFile, ReportsEverythingAtOnceInReadingOrder) {
  std::string text = with_line(12, "  density: nan");
  text.replace(text.find("0.01"), 4, "-inf");
  text.replace(text.find("viscosity"), 9, "visocsity");
  EXPECT_EQ(
      errors_of(text, {"liquid.density=0", "foo=1"}),
      "--set foo=1: foo: the scene has no field \"foo\"; it has name, dimension, spacing, duration, gravity, "
      "liquid, other_liquid, domain, fluid, body, output, formulation, joint, contact, probe, opening, "
      "coupling\n"
      "--set liquid.density=0: liquid.density: 0 kg/m^3 is not positive; leave it out for water, 1000\n"
      "a.scene:3:1: spacing: -inf is not a finite number\n"
      "a.scene:5:10: visocsity: Liquid has no such field; did you mean viscosity?\n"
      "a.scene:12:3: body[0].density: nan is not a finite number");
}

TEST(SceneFile, FindsFaultsOfJson) {
  EXPECT_THAT(errors_of("{\"spacng\": 3}", {}, "a.json"), AllOf(StartsWith("a.json: "), HasSubstr("spacng")));
  EXPECT_THAT(errors_of("{\"spacing\": ", {}, "a.json"), StartsWith("a.json: "));
  EXPECT_THAT(errors_of("{\"spacing\": -1}", {}, "a.json"),
              HasSubstr("a.json: spacing: -1 m is not positive"));
  EXPECT_THAT(errors_of("{\"spacing\": \"NaN\"}", {}, "a.json"),
              HasSubstr("a.json: spacing: nan is not a finite number"));
}

TEST(SceneFile, FindsFilesThatAreNone) {
  EXPECT_THAT(
      [] { SceneFile::load("/nowhere/a.scene"); },
      testing::ThrowsMessage<SceneError>("/nowhere/a.scene: cannot be read: No such file or directory"));
  EXPECT_THAT([] { SceneFile::load("/"); }, testing::ThrowsMessage<SceneError>(HasSubstr("is a directory")));
  EXPECT_EQ(errors_of(std::string((16 << 20) + 1, ' ')),
            "a.scene: is larger than 16 MiB, which no scene needs");
}

TEST(SceneFile, RefusesDeepNesting) {
  std::string text = kScene;
  for (int i = 0; i < 100'000; ++i) text += "a{";
  EXPECT_THAT(errors_of(text), HasSubstr("too deep"));
}

// No text crashes the reader; whatever is wrong carries the file's name.
RC_GTEST_PROP(SceneFileFuzz, DamagedText, ()) {
  std::string text = kScene;
  const auto hits = *rc::gen::inRange(1, 6);
  for (int i = 0; i < hits; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto piece = *rc::gen::element<std::string>("{", "}", "[", "]", "-", "nan", "1e999", "\"", "body {",
                                                      ":", "\n", "#", "\xff", "9");
    text.replace(at, *rc::gen::inRange<std::size_t>(0, 4), piece);
  }
  const std::string errors = errors_of(text);
  RC_ASSERT(errors.empty() || errors.starts_with("a.scene"));
}

RC_GTEST_PROP(SceneFileFuzz, RandomJson, (const std::string& text)) {
  const std::string errors = errors_of(text, {}, "a.json");
  RC_ASSERT(errors.starts_with("a.json: "));
}

}  // namespace
}  // namespace sluice::protocol
