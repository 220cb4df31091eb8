#include "tests/unit/clients/fake_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "clients/recording/writer.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/frame_layout.hpp"
#include "protocol/version.hpp"

namespace sluice::clients::test {
namespace {

using protocol::Message;

// Values with all bits in use; `seed` tells messages and arrays apart.
std::vector<double> noise(std::uint64_t count, std::uint64_t seed) {
  std::vector<double> values(count);
  for (std::uint64_t i = 0; i < count; ++i) values[i] = std::sin(1.0 + static_cast<double>(i + 7919 * seed));
  return values;
}

void add(Message& message, const char* name, const std::vector<double>& data,
         std::vector<std::uint64_t> shape) {
  message.add_array<double>(name, data, std::move(shape));
}

Message start() {
  Message message;
  message.header.set_protocol_version(protocol::kProtocolVersion);
  message.header.set_run_id("fake-run");
  return message;
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = std::filesystem::temp_directory_path() / "sluice-test-XXXXXX";
  path_ = mkdtemp(pattern.data());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Message FakeRun::welcome() const {
  Message message = start();
  Welcome& welcome = *message.header.mutable_welcome();
  Scene& scene = *welcome.mutable_scene();
  scene.set_name("fake \"scene\" & more");
  scene.set_dimension(2);
  scene.set_spacing(0.1);
  for (int axis = 0; axis < 2; ++axis) scene.mutable_domain()->add_max(2);
  scene.mutable_domain()->add_open(Y_MAX);
  if (output.ByteSizeLong() > 0) *scene.mutable_output() = output;
  for (int b = 0; b < bodies; ++b) {
    Body& body = *scene.add_body();
    body.set_name("body" + std::to_string(b));
    body.mutable_ball()->set_radius(0.3);
    body.set_density(500);
  }
  welcome.set_interval_ns(10'000'000);
  welcome.set_steps_per_interval(steps_per_frame);
  welcome.set_steps(steps_per_frame * frames);
  welcome.set_fluid_particles(particles);
  welcome.set_boundary_particles(4 + static_cast<std::uint64_t>(bodies));
  welcome.set_sound_speed(44.3);
  welcome.set_particle_mass(0.1 + 1e-17);
  welcome.mutable_build()->set_version("0.1.0");
  welcome.mutable_build()->set_compiler("a compiler");
  welcome.mutable_build()->set_processor("a processor");
  welcome.mutable_build()->set_threads(2);
  const auto m = static_cast<std::uint64_t>(bodies);
  add(message, "wall/position", noise(12, 1), {4, 3});
  add(message, "boundary/position", noise(3 * m, 2), {m, 3});
  std::vector<std::int32_t> body(m);
  for (std::size_t i = 0; i < m; ++i) body[i] = static_cast<std::int32_t>(i);
  message.add_array<std::int32_t>("boundary/body", body, {m});
  return message;
}

std::uint64_t FakeRun::particles_in(std::uint64_t index) const {
  return output.has_region() ? (37 * index + 5) % (2 * particles) : particles;
}

void FakeRun::add_particles(Message& message, std::uint64_t index) const {
  const Scene scene = welcome().header.welcome().scene();
  if (!protocol::has_particles(scene, index)) return;
  const std::uint64_t n = particles_in(index);
  for (const protocol::ParticleArray& array : protocol::particle_arrays(scene)) {
    std::vector<std::uint64_t> shape{n};
    if (array.components > 1) shape.push_back(array.components);
    const auto values =
        noise(n * array.components, 10 * (index + 1) + static_cast<std::uint64_t>(array.field) - POSITION);
    if (array.type == Array::INT64) {
      std::vector<std::int64_t> ids(n);
      for (std::size_t k = 0; k < n; ++k) ids[k] = static_cast<std::int64_t>(3 * k + index);
      message.add_array<std::int64_t>(array.name, ids, shape);
    } else if (array.type == Array::FLOAT32) {
      message.add_array<float>(array.name, std::vector<float>(values.begin(), values.end()), shape);
    } else {
      message.add_array<double>(array.name, values, shape);
    }
  }
}

Message FakeRun::frame(std::uint64_t index) const {
  Message message = start();
  const auto m = static_cast<std::uint64_t>(bodies);
  message.header.set_step(index * steps_per_frame);
  message.header.set_time_ns(static_cast<std::int64_t>(index) * 10'000'000);
  const std::uint64_t seed = 10 * (index + 1);
  add_particles(message, index);
  add(message, "body/kinematics", noise(19 * m, seed + 4), {m, 19});
  add(message, "body/wrench", noise(6 * m, seed + 5), {m, 6});
  Frame& frame = *message.header.mutable_frame();
  frame.set_index(index);
  frame.set_hash(message.hash_arrays());
  const auto values = noise(12, seed + 6);
  Energy& energy = *frame.mutable_energy();
  energy.set_kinetic(values[0]);
  energy.set_potential(values[1]);
  energy.set_elastic(values[2]);
  energy.set_boundary_work(values[3]);
  energy.set_max_speed(values[4]);
  energy.set_max_compression(values[5]);
  for (int i = 0; i < 3; ++i) energy.add_momentum(values[6 + static_cast<std::size_t>(i)]);
  for (int i = 0; i < 3; ++i) energy.add_angular_momentum(values[9 + static_cast<std::size_t>(i)]);
  return message;
}

Message FakeRun::exchange_log(std::uint64_t index) const {
  Message message = start();
  const auto m = static_cast<std::uint64_t>(bodies);
  message.header.set_step(index * steps_per_frame);
  message.header.set_time_ns(static_cast<std::int64_t>(index) * 10'000'000);
  message.header.mutable_exchange_log()->set_first_step((index - 1) * steps_per_frame + 1);
  message.header.mutable_exchange_log()->set_count(static_cast<std::uint32_t>(steps_per_frame));
  add(message, "kinematics", noise(steps_per_frame * m * 19, 1000 + index), {steps_per_frame, m, 19});
  add(message, "wrenches", noise(steps_per_frame * m * 6, 2000 + index), {steps_per_frame, m, 6});
  const std::uint64_t columns = m > 0 ? 2 : 0;
  add(message, "coupling", noise(steps_per_frame * columns, 3000 + index), {steps_per_frame, columns});
  add(message, "wrench_parts", noise(steps_per_frame * m * 12, 4000 + index), {steps_per_frame, m, 12});
  add(message, "ledger", noise(steps_per_frame * m * 29, 5000 + index), {steps_per_frame, m, 29});
  add(message, "indicator", noise(steps_per_frame * m, 6000 + index), {steps_per_frame, m});
  return message;
}

void record(const FakeRun& run, const std::filesystem::path& path) {
  Writer writer(OutputFile(path, false), run.welcome());
  for (std::uint64_t index = 0; index <= run.frames; ++index) {
    if (index > 0) writer.write(run.exchange_log(index));
    writer.write(run.frame(index));
    writer.flush();
  }
  writer.finish("FINISHED", "all steps done", 1.5);
  write_xdmf(path);
}

void expect_same(const Message& actual, const Message& expected) {
  EXPECT_EQ(actual.header.ShortDebugString(), expected.header.ShortDebugString());
  ASSERT_EQ(actual.frames.size(), expected.frames.size());
  for (std::size_t i = 0; i < actual.frames.size(); ++i)
    EXPECT_EQ(actual.frames[i], expected.frames[i]) << expected.header.array(static_cast<int>(i)).name();
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace sluice::clients::test
