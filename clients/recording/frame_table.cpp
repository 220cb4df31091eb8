#include "clients/recording/frame_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/recording/array_check.hpp"
#include "clients/recording/checksum.hpp"
#include "clients/recording/energy.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::ProtocolError;

// Of what the hash over the arrays leaves out.
std::uint64_t checksum(const Header& header, const std::vector<layout::Observable>& observables) {
  Checksum sum;
  sum.add(header.step()).add(header.time_ns()).add(header.frame().hash());
  for (const auto& observable : observables)
    sum.add(std::span<const double>(energy_values(header.frame().energy(), observable.name, 3)));
  return sum.value();
}

// Every element of H5MD has its own step and time; here they are the same datasets by hard links.
void link_times(hid_t file, const std::string& group) {
  h5::link(file, layout::kFrameStep, group + "/step");
  h5::link(file, layout::kFrameTime, group + "/time");
}

}  // namespace

template <typename Make>
FrameTable::FrameTable(const Welcome& welcome, Make make)
    : fields_(layout::frame_fields(static_cast<hsize_t>(welcome.scene().body_size()),
                                   static_cast<hsize_t>(welcome.scene().probe_size()))),
      observables_(layout::observables()) {
  using Row = h5::Shape;
  step_ = make.template operator()<std::uint64_t>(layout::kFrameStep, Row{}, "");
  time_ = make.template operator()<double>(layout::kFrameTime, Row{}, "s");
  time_ns_ = make.template operator()<std::int64_t>(layout::kFrameTimeNs, Row{}, "ns");
  hash_ = make.template operator()<std::uint64_t>(layout::kFrameHash, Row{}, "");
  checksum_ = make.template operator()<std::uint64_t>(layout::kFrameChecksum, Row{}, "");
  for (const auto& field : fields_)
    data_.push_back(make.template operator()<double>(field.dataset, field.row, field.unit));
  for (const auto& observable : observables_)
    energy_.push_back(make.template operator()<double>(layout::energy_group(observable) + "/value",
                                                       observable.row, observable.unit));
}

// The frames' step and time come first: what else has them is linked to these.
FrameTable FrameTable::create(hid_t file, const Welcome& welcome, h5::Storage storage) {
  const auto make = [&]<typename T>(const std::string& path, const h5::Shape& row, const std::string& unit) {
    return h5::Series::create<T>(file, path, row, unit, storage);
  };
  FrameTable table(welcome, make);
  table.particles_ = ParticleTable::create(file, welcome, storage);
  if (welcome.scene().probe_size() > 0) link_times(file, layout::kProbes);
  for (const auto& observable : table.observables_) link_times(file, layout::energy_group(observable));
  return table;
}

FrameTable FrameTable::open(hid_t file, const Welcome& welcome) {
  FrameTable table(
      welcome, [&]<typename T>(const std::string& path, const h5::Shape& row, const std::string& /*unit*/) {
        return h5::Series::open(file, path, row);
      });
  table.particles_ = ParticleTable::open(file, welcome);
  return table;
}

void FrameTable::check(const Message& message) const {
  const Frame& frame = message.header.frame();
  int array = 0;
  if (particles_.has(frame.index())) {
    particles_.check(message);
    array = particles_.arrays();
  }
  for (const layout::Field& field : fields_) check_array(message, array++, field.array, field.row);
  if (message.header.array_size() != array)
    throw ProtocolError(fmt::format("frame {} has {} arrays, expected {}; the next is {}", frame.index(),
                                    message.header.array_size(), array, message.header.array(array).name()));
  if (frame.index() != length())
    throw ProtocolError(fmt::format("frame {} came, expected {}", frame.index(), length()));
  if (frame.hash() != message.hash_arrays())
    throw ProtocolError(fmt::format("frame {} does not have the hash it announces", frame.index()));
}

// The step last: who finds it there finds the rest.
void FrameTable::append(const Message& message) {
  check(message);
  const Header& header = message.header;
  if (particles_.has(header.frame().index())) particles_.append(message);
  for (std::size_t i = 0; i < fields_.size(); ++i) data_[i].append(message.array<double>(fields_[i].array));
  for (std::size_t i = 0; i < observables_.size(); ++i)
    energy_[i].append(
        std::span<const double>(energy_values(header.frame().energy(), observables_[i].name, 3)));
  hash_.append_one<std::uint64_t>(header.frame().hash());
  checksum_.append_one<std::uint64_t>(checksum(header, observables_));
  time_ns_.append_one<std::int64_t>(header.time_ns());
  time_.append_one<double>(protocol::seconds(header.time_ns()));
  step_.append_one<std::uint64_t>(header.step());
}

std::uint64_t FrameTable::length() const {
  std::uint64_t shortest = std::min(step_.length(), particles_.frames());
  for (const auto* series : {&time_, &time_ns_, &hash_, &checksum_})
    shortest = std::min(shortest, series->length());
  for (const auto* group : {&data_, &energy_})
    for (const auto& series : *group)
      if (!series.absent()) shortest = std::min(shortest, series.length());
  return shortest;
}

std::uint64_t FrameTable::particles(std::uint64_t index) const {
  return particles_.has(index) ? particles_.count(index) : 0;
}

Header FrameTable::header(std::uint64_t index) const {
  Header header;
  header.set_step(step_.read_one<std::uint64_t>(index));
  header.set_time_ns(time_ns_.read_one<std::int64_t>(index));
  Frame& frame = *header.mutable_frame();
  frame.set_index(index);
  frame.set_hash(hash_.read_one<std::uint64_t>(index));
  for (std::size_t i = 0; i < observables_.size(); ++i)
    set_energy_values(*frame.mutable_energy(), observables_[i].name, energy_[i].read<double>(index, 1));
  return header;
}

Message FrameTable::read(std::uint64_t index) const {
  Message message;
  message.header = header(index);
  if (particles_.has(index)) particles_.read(index, message);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto data = data_[i].read<double>(index, 1);
    message.add_array<double>(fields_[i].array, data, {fields_[i].row.begin(), fields_[i].row.end()});
  }
  return message;
}

bool FrameTable::intact(const Message& message) const {
  const Frame& frame = message.header.frame();
  return frame.hash() == message.hash_arrays() &&
         checksum_.read_one<std::uint64_t>(frame.index()) == checksum(message.header, observables_);
}

}  // namespace sluice::clients
