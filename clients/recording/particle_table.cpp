#include "clients/recording/particle_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/recording/array_check.hpp"
#include "clients/recording/element.hpp"
#include "protocol/frame_layout.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::ProtocolError;

constexpr std::int64_t kEmpty = h5::empty_slot<std::int64_t>();

void require_identities(std::span<const std::int64_t> ids) {
  std::int64_t last = -1;
  for (const std::int64_t id : ids) {
    if (id <= last)
      throw ProtocolError(
          fmt::format("array {}: {} follows {}; identities ascend from 0", protocol::kParticleId, id, last));
    last = id;
  }
}

}  // namespace

template <typename Make>
ParticleTable::ParticleTable(const Welcome& welcome, Make make)
    : fields_(layout::particle_fields(welcome.scene(), welcome.fluid_particles())),
      every_(protocol::particles_every(welcome.scene())),
      particles_(welcome.fluid_particles()),
      vary_(protocol::particles_vary(welcome.scene())) {
  for (const layout::Field& field : fields_)
    data_.push_back(with_element(
        field.type, [&]<typename T>(T /*element*/) { return make.template operator()<T>(field, vary_); }));
  if (every_ == 1) return;
  step_ = make.template operator()<std::uint64_t>(layout::Field{"", layout::kParticleStep, {}, ""}, false);
  time_ = make.template operator()<double>(layout::Field{"", layout::kParticleTime, {}, "s"}, false);
}

ParticleTable ParticleTable::create(hid_t file, const Welcome& welcome, h5::Storage storage) {
  ParticleTable table(welcome, [&]<typename T>(const layout::Field& field, bool in_slots) {
    return in_slots ? h5::Series::create_slots<T>(file, field.dataset, field.row, field.unit, storage)
                    : h5::Series::create<T>(file, field.dataset, field.row, field.unit, storage);
  });
  for (const layout::Field& field : table.fields_) {
    const std::string group = field.dataset.substr(0, field.dataset.rfind('/'));
    if (table.every_ > 1 && group + "/step" == layout::kParticleStep) continue;
    h5::link(file, table.every_ > 1 ? layout::kParticleStep : layout::kFrameStep, group + "/step");
    h5::link(file, table.every_ > 1 ? layout::kParticleTime : layout::kFrameTime, group + "/time");
  }
  return table;
}

ParticleTable ParticleTable::open(hid_t file, const Welcome& welcome) {
  return {welcome, [&]<typename T>(const layout::Field& field, bool in_slots) {
            return in_slots ? h5::Series::open_slots(file, field.dataset, field.row)
                            : h5::Series::open(file, field.dataset, field.row);
          }};
}

h5::Shape ParticleTable::shape(const layout::Field& field, std::uint64_t particles) const {
  h5::Shape shape = field.row;
  shape[0] = particles;
  return shape;
}

void ParticleTable::check(const Message& message) const {
  std::uint64_t particles = particles_;
  if (vary_ && message.has_array(protocol::kParticleId)) {
    const auto ids = message.array<std::int64_t>(protocol::kParticleId);
    require_identities(ids);
    particles = ids.size();
  }
  for (std::size_t i = 0; i < fields_.size(); ++i)
    check_array(message, static_cast<int>(i), fields_[i].array, shape(fields_[i], particles),
                fields_[i].type);
}

void ParticleTable::append(const Message& message) {
  for (std::size_t i = 0; i < fields_.size(); ++i)
    with_element(fields_[i].type,
                 [&]<typename T>(T /*element*/) { data_[i].append_row(message.array<T>(fields_[i].array)); });
  if (every_ == 1) return;
  time_.append_one<double>(protocol::seconds(message.header.time_ns()));
  step_.append_one<std::uint64_t>(message.header.step());
}

std::uint64_t ParticleTable::count(std::uint64_t frame) const {
  if (!vary_) return particles_;
  const auto ids = data_.front().read_row<std::int64_t>(frame / every_, data_.front().slots());
  return static_cast<std::uint64_t>(std::find(ids.begin(), ids.end(), kEmpty) - ids.begin());
}

void ParticleTable::read(std::uint64_t frame, Message& message) const {
  const std::uint64_t particles = count(frame);
  for (std::size_t i = 0; i < fields_.size(); ++i)
    with_element(fields_[i].type, [&]<typename T>(T /*element*/) {
      const h5::Shape extents = shape(fields_[i], particles);
      message.add_array<T>(fields_[i].array, data_[i].read_row<T>(frame / every_, particles),
                           {extents.begin(), extents.end()});
    });
}

std::uint64_t ParticleTable::frames() const {
  std::uint64_t rows = std::numeric_limits<std::uint64_t>::max() / every_;
  for (const h5::Series& series : data_)
    if (!series.absent()) rows = std::min(rows, series.length());
  if (every_ > 1) rows = std::min({rows, step_.length(), time_.length()});
  return rows * every_;
}

}  // namespace sluice::clients
