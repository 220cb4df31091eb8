#include "server/particle_arrays.hpp"

#include <optional>
#include <stdexcept>

#include "protocol/frame_layout.hpp"

namespace sluice::server {
namespace {

using protocol::Message;
using protocol::ParticleArray;
using Rows = std::vector<std::size_t>;

// Of the particles inside the region; nothing where there is none, so that all are told of.
std::optional<Rows> chosen(const Output& output, const fluid::Snapshot& state) {
  if (!output.has_region()) return std::nullopt;
  const Span& region = output.region();
  Rows rows;
  for (std::size_t i = 0; i < state.density.size(); ++i) {
    bool inside = true;
    for (int axis = 0; axis < region.min_size(); ++axis) {
      const double x = state.position[3 * i + static_cast<std::size_t>(axis)];
      inside = inside && region.min(axis) <= x && x <= region.max(axis);
    }
    if (inside) rows.push_back(i);
  }
  return rows;
}

std::span<const double> values_of(const fluid::Snapshot& state, ParticleField field) {
  switch (field) {
    case POSITION:
      return state.position;
    case VELOCITY:
      return state.velocity;
    case DENSITY:
      return state.density;
    case PRESSURE:
      return state.pressure;
    default:
      throw std::logic_error("a snapshot has no " + ParticleField_Name(field));
  }
}

std::vector<std::int64_t> ids_of(const fluid::Snapshot& state, const Rows* rows) {
  if (rows == nullptr) return {state.id.begin(), state.id.end()};
  std::vector<std::int64_t> ids;
  for (const std::size_t i : *rows) ids.push_back(state.id[i]);
  return ids;
}

std::vector<std::int64_t> liquids_of(const fluid::Snapshot& state, const Rows* rows) {
  if (rows == nullptr) return {state.liquid.begin(), state.liquid.end()};
  std::vector<std::int64_t> liquids;
  for (const std::size_t i : *rows) liquids.push_back(state.liquid[i]);
  return liquids;
}

template <typename Real>
void add(Message& frame, const ParticleArray& array, std::span<const double> all, const Rows* rows) {
  const std::size_t width = array.components;
  const std::size_t n = rows != nullptr ? rows->size() : all.size() / width;
  std::vector<std::uint64_t> shape{n};
  if (width > 1) shape.push_back(width);
  if constexpr (std::is_same_v<Real, double>)
    if (rows == nullptr) return frame.add_array<double>(array.name, all, shape);
  std::vector<Real> values(n * width);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = rows != nullptr ? (*rows)[k] : k;
    for (std::size_t c = 0; c < width; ++c) values[k * width + c] = static_cast<Real>(all[i * width + c]);
  }
  frame.add_array<Real>(array.name, values, shape);
}

}  // namespace

void add_particles(Message& frame, const Scene& scene, const fluid::Snapshot& state) {
  const std::optional<Rows> rows = chosen(scene.output(), state);
  for (const ParticleArray& array : protocol::particle_arrays(scene)) {
    if (array.field == LIQUID) {
      const std::vector<std::int64_t> liquids = liquids_of(state, rows ? &*rows : nullptr);
      frame.add_array<std::int64_t>(array.name, liquids, {liquids.size()});
    } else if (array.name == protocol::kParticleId) {
      const std::vector<std::int64_t> ids = ids_of(state, rows ? &*rows : nullptr);
      frame.add_array<std::int64_t>(array.name, ids, {ids.size()});
    } else if (array.type == Array::FLOAT32) {
      add<float>(frame, array, values_of(state, array.field), rows ? &*rows : nullptr);
    } else {
      add<double>(frame, array, values_of(state, array.field), rows ? &*rows : nullptr);
    }
  }
}

}  // namespace sluice::server
