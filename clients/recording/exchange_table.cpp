#include "clients/recording/exchange_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/recording/array_check.hpp"
#include "clients/recording/checksum.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::ProtocolError;

h5::Shape rows(std::uint64_t count, const h5::Shape& row) {
  h5::Shape shape{count};
  shape.insert(shape.end(), row.begin(), row.end());
  return shape;
}

// One for each step of the log.
std::vector<std::uint64_t> checksums(const Message& log, const std::vector<layout::Field>& fields) {
  const ExchangeLog& range = log.header.exchange_log();
  std::vector<std::uint64_t> result;
  for (std::uint64_t k = 0; k < range.count(); ++k) {
    Checksum sum;
    sum.add<std::uint64_t>(range.first_step() + k);
    for (const auto& field : fields) {
      const hsize_t width = h5::elements(field.row);
      sum.add(log.array<double>(field.array).subspan(k * width, width));
    }
    result.push_back(sum.value());
  }
  return result;
}

}  // namespace

template <typename Make>
ExchangeTable::ExchangeTable(std::vector<layout::Field> fields, Make make) : fields_(std::move(fields)) {
  using Row = h5::Shape;
  step_ = make.template operator()<std::uint64_t>(layout::kExchangeStep, Row{}, "");
  time_ns_ = make.template operator()<std::int64_t>(layout::kExchangeTimeNs, Row{}, "ns");
  checksum_ = make.template operator()<std::uint64_t>(layout::kExchangeChecksum, Row{}, "");
  for (const auto& field : fields_)
    data_.push_back(make.template operator()<double>(field.dataset, field.row, field.unit));
}

ExchangeTable ExchangeTable::create(hid_t file, hsize_t bodies, h5::Storage storage) {
  return {layout::exchange_fields(bodies),
          [&]<typename T>(const std::string& path, const h5::Shape& row, const std::string& unit) {
            return h5::Series::create<T>(file, path, row, unit, storage);
          }};
}

ExchangeTable ExchangeTable::open(hid_t file, hsize_t bodies, int format) {
  return {layout::exchange_fields(bodies, format),
          [&]<typename T>(const std::string& path, const h5::Shape& row, const std::string& /*unit*/) {
            return h5::Series::open(file, path, row);
          }};
}

void ExchangeTable::check(const Message& message) const {
  const ExchangeLog& log = message.header.exchange_log();
  for (std::size_t i = 0; i < fields_.size(); ++i)
    check_array(message, static_cast<int>(i), fields_[i].array, rows(log.count(), fields_[i].row));
  if (log.first_step() != length() + 1)
    throw ProtocolError(
        fmt::format("exchanges from step {} came, expected from step {}", log.first_step(), length() + 1));
}

void ExchangeTable::append(const Message& message, const protocol::StepClock& clock) {
  check(message);
  const ExchangeLog& log = message.header.exchange_log();
  std::vector<std::int64_t> times;
  std::vector<std::uint64_t> steps;
  for (std::uint64_t step = log.first_step(); step < log.first_step() + log.count(); ++step) {
    times.push_back(clock.time(step));
    steps.push_back(step);
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) data_[i].append(message.array<double>(fields_[i].array));
  checksum_.append(std::span<const std::uint64_t>(checksums(message, fields_)));
  time_ns_.append(std::span<const std::int64_t>(times));
  step_.append(std::span<const std::uint64_t>(steps));
}

std::uint64_t ExchangeTable::length() const {
  std::uint64_t shortest = std::min({step_.length(), time_ns_.length(), checksum_.length()});
  for (const auto& series : data_)
    if (!series.absent()) shortest = std::min(shortest, series.length());
  return shortest;
}

Message ExchangeTable::read(std::uint64_t first_step, std::uint32_t count) const {
  Message message;
  message.header.set_step(first_step + count - 1);
  if (count > 0) message.header.set_time_ns(time_ns_.read_one<std::int64_t>(first_step + count - 2));
  message.header.mutable_exchange_log()->set_first_step(first_step);
  message.header.mutable_exchange_log()->set_count(count);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const h5::Shape shape = rows(count, fields_[i].row);
    message.add_array<double>(fields_[i].array, data_[i].read<double>(first_step - 1, count),
                              {shape.begin(), shape.end()});
  }
  return message;
}

bool ExchangeTable::intact(const Message& message) const {
  const ExchangeLog& log = message.header.exchange_log();
  return checksum_.read<std::uint64_t>(log.first_step() - 1, log.count()) == checksums(message, fields_);
}

}  // namespace sluice::clients
