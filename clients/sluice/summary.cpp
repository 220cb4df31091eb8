#include "clients/sluice/summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace sluice::clients {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("  {:<20}{}\n", name, value);
}

double total(const Energy& energy) {
  return energy.kinetic() + energy.potential() + energy.elastic();
}

std::string energy_text(const Energy& energy, const char* unit) {
  return fmt::format("{:.6g} {} (kinetic {:.4g}, potential {:.6g}, elastic {:.4g})", total(energy), unit,
                     energy.kinetic(), energy.potential(), energy.elastic());
}

Json energy_json(const std::optional<Energy>& energy) {
  if (!energy) return nullptr;
  return {{"kinetic", energy->kinetic()},
          {"potential", energy->potential()},
          {"elastic", energy->elastic()},
          {"boundary_work", energy->boundary_work()},
          {"total", total(*energy)}};
}

std::string size_text(std::uint64_t bytes) {
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", 1e-3 * static_cast<double>(bytes));
  return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

}  // namespace

double Summary::particle_steps_per_second() const {
  if (wall_seconds <= 0) return 0;
  return static_cast<double>(fluid_particles) * static_cast<double>(step - done_before) / wall_seconds;
}

std::string to_table(const Summary& summary) {
  const char* unit = summary.dimension == 2 ? "J/m" : "J";
  std::string table;
  table += row("scene", fmt::format("{} ({})", summary.scene, summary.file));
  table += row("particles",
               fmt::format("{} fluid, {} boundary", summary.fluid_particles, summary.boundary_particles));
  table += row("steps", fmt::format("{} of {}", summary.step, summary.steps));
  table += row("simulated time", fmt::format("{:.6g} of {:.6g} s", summary.time, summary.duration));
  table += row("wall time", fmt::format("{:.2f} s", summary.wall_seconds));
  table += row("speed",
               fmt::format("{:.3g} million particle steps/s", 1e-6 * summary.particle_steps_per_second()));
  if (summary.start) table += row("energy at start", energy_text(*summary.start, unit));
  if (summary.end) {
    table += row("energy at end", energy_text(*summary.end, unit));
    table += row("work of boundaries", fmt::format("{:.4g} {}", summary.end->boundary_work(), unit));
  }
  if (!summary.not_computed.empty())
    table += row("not computed", fmt::format("{}", fmt::join(summary.not_computed, ", ")));
  table += row("status", summary.detail.empty() ? summary.status : summary.status + " - " + summary.detail);
  if (!summary.recording.empty())
    table += row("recording", fmt::format("{} ({})", summary.recording, size_text(summary.recording_bytes)));
  return table;
}

std::string to_json(const Summary& summary) {
  Json json{{"scene", summary.scene},
            {"file", summary.file},
            {"dimension", summary.dimension},
            {"fluid_particles", summary.fluid_particles},
            {"boundary_particles", summary.boundary_particles},
            {"step", summary.step},
            {"steps", summary.steps},
            {"done_before", summary.done_before},
            {"time", summary.time},
            {"duration", summary.duration},
            {"wall_seconds", summary.wall_seconds},
            {"particle_steps_per_second", summary.particle_steps_per_second()},
            {"energy", {{"start", energy_json(summary.start)}, {"end", energy_json(summary.end)}}},
            {"not_computed", summary.not_computed},
            {"status", summary.status},
            {"detail", summary.detail},
            {"exit_code", summary.exit_code},
            {"recording", nullptr}};
  if (!summary.recording.empty())
    json["recording"] = {{"path", summary.recording}, {"bytes", summary.recording_bytes}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sluice::clients
