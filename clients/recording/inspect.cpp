#include "clients/recording/inspect.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clients/recording/ledger.hpp"
#include "clients/recording/selection.hpp"
#include "protocol/body_kind.hpp"

namespace sluice::clients {
namespace {

using Json = nlohmann::ordered_json;

const char* text(Ending ending) {
  switch (ending) {
    case Ending::kFinished:
      return "finished";
    case Ending::kBeingWritten:
      return "being written";
    case Ending::kCutShort:
      return "cut short";
  }
  return "";
}

double seconds(std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns);
}

const char* shape_name(const Body& body) {
  switch (body.shape_case()) {
    case Body::kBox:
      return "box";
    case Body::kBall:
      return "ball";
    case Body::kPolygon:
      return "polygon";
    case Body::kCylinder:
      return "cylinder";
    case Body::kMesh:
      return body.mesh().convex_hull() ? "convex hull" : "mesh";
    case Body::kCompound:
      return "compound";
    case Body::SHAPE_NOT_SET:
      break;
  }
  return "none";
}

const char* motion_kind(const Body& body) {
  if (!body.has_prescribed()) return "free";
  if (body.prescribed().has_release()) return "prescribed, then free";
  return protocol::is_partly_free(body) ? "prescribed along some axes" : "prescribed";
}

Json bodies(const Scene& scene) {
  Json list = Json::array();
  for (const auto& body : scene.body()) {
    list.push_back({{"name", body.name()}, {"shape", shape_name(body)}, {"motion", motion_kind(body)}});
  }
  return list;
}

Json energy(const Reader& recording, std::uint64_t frame) {
  const Header header = recording.frame_header(frame);
  const Energy& values = header.frame().energy();
  return {{"time", seconds(header.time_ns())},
          {"kinetic", values.kinetic()},
          {"potential", values.potential()},
          {"elastic", values.elastic()},
          {"boundary_work", values.boundary_work()},
          {"max_speed", values.max_speed()},
          {"max_compression", values.max_compression()}};
}

// The probes' values in the last frame.
Json probes(const Reader& recording) {
  Json list = Json::array();
  const Scene& scene = recording.scene();
  if (scene.probe().empty() || recording.frames() == 0) return list;
  const protocol::Message frame = recording.frame(recording.frames() - 1);
  const auto values = frame.array<double>("probe");
  for (int p = 0; p < scene.probe_size(); ++p) {
    const double* row = values.data() + 6 * static_cast<std::size_t>(p);
    Json probe = {{"name", scene.probe(p).name()}};
    if (scene.probe(p).has_point()) {
      probe["pressure"] = row[0];
      probe["velocity"] = {row[1], row[2], row[3]};
      probe["wetness"] = row[4];
    } else if (scene.probe(p).has_surface()) {
      probe["height"] = row[1] == 0 ? Json(nullptr) : Json(row[0]);
    } else if (scene.probe(p).has_flow()) {
      probe["rate"] = row[0];
      probe["mass_in"] = row[1];
      probe["mass_out"] = row[2];
    } else {
      probe["force"] = {row[0], row[1], row[2]};
      probe["moment"] = {row[3], row[4], row[5]};
    }
    list.push_back(std::move(probe));
  }
  return list;
}

Json vector(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

Json ledger_json(const std::vector<BodyLedger>& bodies) {
  Json list = Json::array();
  for (const BodyLedger& body : bodies) {
    Json entry = {{"body", body.name}, {"since", body.since}, {"time", body.since + body.time}};
    for (const auto& [name, part] : body.impulses)
      entry["impulse"][name] = {{"force", vector(part.force)}, {"moment", vector(part.moment)}};
    entry["work_of_liquid"] = body.work_of_liquid;
    if (body.is_free) {
      entry["momentum_change"] = vector(body.momentum_change);
      entry["third_law_residual"] = body.third_law_residual;
      entry["energy_created"] = body.energy_created;
      for (const auto& [name, work] : body.works) entry["work"][name] = work;
      entry["largest_indicator"] = {{"value", body.largest_indicator}, {"time", body.largest_indicator_time}};
      entry["iterations"] = {{"mean", body.mean_iterations}, {"most", body.most_iterations}};
      entry["largest_residual"] = body.largest_residual;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

std::string vector_text(const Json& v) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

std::string probe_text(const Json& probe) {
  if (probe.contains("pressure"))
    return fmt::format("{:.6g} Pa, {} m/s, wetness {:.3g}", probe["pressure"].get<double>(),
                       vector_text(probe["velocity"]), probe["wetness"].get<double>());
  if (probe.contains("force"))
    return fmt::format("{} N, {} N m", vector_text(probe["force"]), vector_text(probe["moment"]));
  if (probe.contains("rate"))
    return fmt::format("{:.6g} kg/s into the tank; {:.6g} kg came in, {:.6g} kg left",
                       probe["rate"].get<double>(), probe["mass_in"].get<double>(),
                       probe["mass_out"].get<double>());
  return probe["height"].is_null() ? "no liquid" : fmt::format("{:.6g} m", probe["height"].get<double>());
}

// Everything there is to say; the text shows the same.
Json describe(const Reader& recording) {
  const Welcome& welcome = recording.welcome();
  const Scene& scene = recording.scene();
  const std::uint64_t frames = recording.frames();
  Json result = {{"file", recording.path().string()},
                 {"bytes", std::filesystem::file_size(recording.path())},
                 {"run_id", recording.run_id()},
                 {"ending", text(recording.ending())},
                 {"reason", recording.reason()},
                 {"detail", recording.detail()},
                 {"wall_seconds", recording.wall_seconds()},
                 {"scene", scene.name()},
                 {"dimension", scene.dimension()},
                 {"spacing", scene.spacing()},
                 {"fluid_particles", welcome.fluid_particles()},
                 {"boundary_particles", welcome.boundary_particles()},
                 {"selection", selection_text(recording)},
                 {"bodies", bodies(scene)},
                 {"sound_speed", welcome.sound_speed()},
                 {"steps", welcome.steps()},
                 {"frames", frames},
                 {"exchanges", recording.exchanges()},
                 {"build",
                  {{"version", welcome.build().version()},
                   {"compiler", welcome.build().compiler()},
                   {"processor", welcome.build().processor()},
                   {"threads", welcome.build().threads()}}}};
  if (frames > 0) {
    result["last_step"] = recording.frame_header(frames - 1).step();
    result["first"] = energy(recording, 0);
    result["last"] = energy(recording, frames - 1);
    result["probes"] = probes(recording);
  }
  if (recording.exchanges() > 0 && recording.frames() > 0 && recording.scene().body_size() > 0)
    result["ledger"] = ledger_json(read_ledgers(recording));
  return result;
}

std::string line(const std::string& name, const std::string& value) {
  return fmt::format("{:<11}{}\n", name, value);
}

std::string ending_line(const Reader& recording) {
  switch (recording.ending()) {
    case Ending::kFinished:
      return recording.reason() + (recording.detail().empty() ? "" : " - " + recording.detail());
    case Ending::kBeingWritten:
      return "still being written";
    case Ending::kCutShort:
      return "cut short: the recorder was killed; all that it acknowledged is here";
  }
  return "";
}

std::string energy_line(const Json& at) {
  return fmt::format(
      "t = {:.6g} s: kinetic {:.6g}, potential {:.6g}, elastic {:.6g}, boundary work {:.6g} J; "
      "fastest {:.4g} m/s",
      at["time"].get<double>(), at["kinetic"].get<double>(), at["potential"].get<double>(),
      at["elastic"].get<double>(), at["boundary_work"].get<double>(), at["max_speed"].get<double>());
}

std::string frames_line(const Json& all, const Reader& recording) {
  if (recording.frames() == 0) return "none";
  return fmt::format("{} from t = {:.6g} to {:.6g} s, step {} of {}", recording.frames(),
                     all["first"]["time"].get<double>(), all["last"]["time"].get<double>(),
                     all["last_step"].get<std::uint64_t>(), recording.welcome().steps());
}

}  // namespace

std::string inspect_json(const Reader& recording) {
  return describe(recording).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string inspect(const Reader& recording) {
  const Json all = describe(recording);
  const Welcome& welcome = recording.welcome();
  std::string result;
  result += line("file",
                 fmt::format("{} ({:.1f} MB)", recording.path().string(), 1e-6 * all["bytes"].get<double>()));
  result += line("scene", fmt::format("{}, {}D, spacing {} m", recording.scene().name(),
                                      recording.scene().dimension(), recording.scene().spacing()));
  result += line("particles", fmt::format("{} fluid, {} boundary", welcome.fluid_particles(),
                                          welcome.boundary_particles()));
  if (const std::string selected = selection_text(recording); !selected.empty())
    result += line("recorded", selected);
  for (const auto& body : all["bodies"]) {
    result += line("body", fmt::format("{}: {}, {}", body["name"].get<std::string>(),
                                       body["shape"].get<std::string>(), body["motion"].get<std::string>()));
  }
  result += line("frames", frames_line(all, recording));
  if (recording.scene().body_size() > 0)
    result += line("exchanges", fmt::format("steps 1 to {}", recording.exchanges()));
  if (recording.frames() > 0) {
    result += line("first", energy_line(all["first"]));
    result += line("last", energy_line(all["last"]));
    for (const auto& probe : all["probes"])
      result += line("probe", fmt::format("{}: {}", probe["name"].get<std::string>(), probe_text(probe)));
  }
  if (recording.exchanges() > 0 && recording.frames() > 0 && recording.scene().body_size() > 0)
    for (const BodyLedger& body : read_ledgers(recording)) result += to_text(body);
  result += line("ended", ending_line(recording));
  result += line("run", fmt::format("{}, {:.1f} s wall clock", recording.run_id(), recording.wall_seconds()));
  result += line("build", fmt::format("sluice {}, {}, {}, {} threads", welcome.build().version(),
                                      welcome.build().compiler(), welcome.build().processor(),
                                      welcome.build().threads()));
  return result;
}

}  // namespace sluice::clients
