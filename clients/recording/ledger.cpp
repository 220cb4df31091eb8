#include "clients/recording/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

using Row = std::span<const double>;

constexpr std::size_t kKinematics = 19, kWrench = 6, kParts = 12, kLedger = 29;
// Where in a body's ledger each cause begins.
constexpr std::size_t kContact = 6, kJoints = 15, kDrive = 22;
constexpr std::size_t kMass = 14;
constexpr std::uint32_t kBlock = 256;  // steps read at once

double dot(Row a, Row b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double norm(Row a) {
  return std::sqrt(dot(a, a));
}

// The sums over the steps of one body.
class Sums {
 public:
  Sums(const Body& body, Row kinematics, Row wrench) {
    result_.name = body.name();
    std::copy_n(kinematics.begin(), 3, running_.place.begin());
    std::copy(wrench.begin(), wrench.end(), wrench_.begin());
  }

  // A step begins an exchange: what the body had then. From where it is free the sums are those since.
  void begin(Row ledger, double time) {
    const bool is_free = ledger[kMass] > 0;
    if (is_free && !is_free_) {
      result_.since = time;
      std::copy(ledger.begin(), ledger.end(), first_.begin());
      start_ = running_.place;
      running_ = {};
      running_.place = start_;
      steps_ = 0;
      iterations_ = 0;
    }
    is_free_ = is_free;
    std::copy(ledger.begin(), ledger.end(), last_.begin());
    settled_ = running_;
  }

  void add(double dt, Row kinematics, Row wrench, Row parts, Row coupling) {
    ++steps_;
    running_.time += dt;
    std::array<double, 6> mean{};
    for (std::size_t c = 0; c < 6; ++c) {
      mean[c] = 0.5 * (wrench_[c] + wrench[c]);
      const double viscous = 0.5 * (parts_[c] + parts[c]), guard = 0.5 * (parts_[6 + c] + parts[6 + c]);
      running_.viscous[c] += dt * viscous;
      running_.guard[c] += dt * guard;
      running_.all[c] += dt * mean[c];
    }
    const Row m(mean);
    const double work =
        dt * (dot(m.first(3), kinematics.subspan(7)) + dot(m.subspan(3), kinematics.subspan(10)));
    running_.work += work;
    running_.passed += std::abs(work);
    running_.given += dt * norm(m);
    std::copy_n(kinematics.begin(), 3, running_.place.begin());
    std::copy(wrench.begin(), wrench.end(), wrench_.begin());
    std::copy(parts.begin(), parts.end(), parts_.begin());
    iterations_ += coupling[0];
    result_.most_iterations = std::max(result_.most_iterations, static_cast<int>(coupling[0]));
    result_.largest_residual = std::max(result_.largest_residual, coupling[1]);
  }

  void note_indicator(double indicator, double time) {
    if (indicator <= result_.largest_indicator) return;
    result_.largest_indicator = indicator;
    result_.largest_indicator_time = time;
  }

  BodyLedger finish(Row gravity) {
    const Totals& sum = is_free_ ? settled_ : running_;
    result_.is_free = is_free_;
    result_.time = sum.time;
    result_.work_of_liquid = sum.work;
    std::array<double, 6> pressure{};
    for (std::size_t c = 0; c < 6; ++c) pressure[c] = sum.all[c] - sum.viscous[c] - sum.guard[c];
    add_impulse("pressure", pressure);
    add_impulse("viscous", sum.viscous);
    add_impulse("penetration", sum.guard);
    if (is_free_ && sum.time > 0) balance(sum, gravity);
    return std::move(result_);
  }

 private:
  struct Totals {
    double time = 0, work = 0, passed = 0, given = 0;
    std::array<double, 6> all{}, viscous{}, guard{};
    std::array<double, 3> place{};
  };

  void add_impulse(const char* name, const std::array<double, 6>& sum) {
    BodyLedger::Impulse impulse;
    std::copy_n(sum.begin(), 3, impulse.force.begin());
    std::copy_n(sum.begin() + 3, 3, impulse.moment.begin());
    result_.impulses.emplace_back(name, impulse);
  }

  void balance(const Totals& sum, Row gravity) {
    const double mass = last_[kMass];
    std::array<double, 6> weight{}, constraints{};
    double fall = 0, residual = 0, work = 0;
    for (std::size_t c = 0; c < 3; ++c) weight[c] = mass * gravity[c] * sum.time;
    add_impulse("gravity", weight);
    const auto add_given = [&](const char* name, std::size_t at) {
      std::array<double, 6> given{};
      for (std::size_t c = 0; c < 6; ++c) {
        given[c] = last_[at + c] - first_[at + c];
        constraints[c] += given[c];
      }
      const double done = last_[at + 6] - first_[at + 6];
      work += done;
      add_impulse(name, given);
      result_.works.emplace_back(name, done);
    };
    add_given("contact", kContact);
    add_given("joints", kJoints);
    add_given("drive and locks", kDrive);
    for (std::size_t c = 0; c < 3; ++c) {
      result_.momentum_change[c] = last_[c] - first_[c];
      fall += mass * gravity[c] * (sum.place[c] - start_[c]);
      const double missing = result_.momentum_change[c] - sum.all[c] - weight[c] - constraints[c];
      residual += missing * missing;
    }
    if (sum.given > 0) result_.third_law_residual = std::sqrt(residual) / sum.given;
    const double gained = last_[13] - first_[13] - work - fall;
    if (sum.passed > 0) result_.energy_created = (gained - sum.work) / sum.passed;
    result_.mean_iterations = iterations_ / static_cast<double>(steps_);
  }

  bool is_free_ = false;
  BodyLedger result_;
  std::uint64_t steps_ = 0;
  double iterations_ = 0;
  std::array<double, 3> start_{};
  std::array<double, kWrench> wrench_{};
  std::array<double, kParts> parts_{};
  std::array<double, kLedger> first_{}, last_{};
  Totals running_, settled_;  // settled: up to the last exchange whose outcome for the body is known
};

std::array<double, 3> gravity_of(const Scene& scene) {
  std::array<double, 3> g{};
  std::copy_n(scene.gravity().begin(), std::min(scene.gravity().size(), 3), g.begin());
  return g;
}

std::vector<Sums> make_sums(const Reader& recording) {
  const protocol::Message start = recording.frame(0);
  const Row kinematics = start.array<double>("body/kinematics"), wrench = start.array<double>("body/wrench");
  std::vector<Sums> sums;
  for (int b = 0; b < recording.scene().body_size(); ++b)
    sums.emplace_back(recording.scene().body(b),
                      kinematics.subspan(static_cast<std::size_t>(b) * kKinematics, kKinematics),
                      wrench.subspan(static_cast<std::size_t>(b) * kWrench, kWrench));
  return sums;
}

std::string row(const std::string& name, const BodyLedger::Impulse& i) {
  return fmt::format("  {:<20}{:>12.5g}{:>12.5g}{:>12.5g} N s{:>12.5g}{:>12.5g}{:>12.5g} N m s\n", name,
                     i.force[0], i.force[1], i.force[2], i.moment[0], i.moment[1], i.moment[2]);
}

}  // namespace

std::vector<BodyLedger> read_ledgers(const Reader& recording) {
  std::vector<Sums> sums = make_sums(recording);
  const Welcome& welcome = recording.welcome();
  const protocol::StepClock clock(welcome.interval_ns(), welcome.steps_per_interval(), welcome.steps());
  const std::uint64_t most = std::max<std::uint64_t>(1, welcome.coupling().steps_per_exchange());
  std::uint64_t next_exchange = 1;
  for (std::uint64_t first = 1; first <= recording.exchanges(); first += kBlock) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(kBlock, recording.exchanges() - first + 1));
    const protocol::Message log = recording.exchange_log(first, count);
    const Row kinematics = log.array<double>("kinematics"), wrenches = log.array<double>("wrenches"),
              parts = log.array<double>("wrench_parts"), ledger = log.array<double>("ledger"),
              coupling = log.array<double>("coupling"), indicators = log.array<double>("indicator");
    for (std::uint32_t k = 0; k < count; ++k) {
      const bool begins = first + k == next_exchange;
      const double start = protocol::seconds(clock.time(first + k - 1));
      if (begins) next_exchange = clock.exchange_end(next_exchange, most) + 1;
      for (std::size_t b = 0; b < sums.size(); ++b) {
        const std::size_t r = k * sums.size() + b;
        if (begins) sums[b].begin(ledger.subspan(r * kLedger, kLedger), start);
        sums[b].note_indicator(indicators[r], protocol::seconds(clock.time(first + k)));
        sums[b].add(protocol::seconds(clock.duration(first + k)),
                    kinematics.subspan(r * kKinematics, kKinematics), wrenches.subspan(r * kWrench, kWrench),
                    parts.subspan(r * kParts, kParts), coupling.subspan(2 * k, 2));
      }
    }
  }
  std::vector<BodyLedger> result;
  const std::array<double, 3> gravity = gravity_of(recording.scene());
  for (Sums& body : sums) result.push_back(body.finish(gravity));
  return result;
}

std::string to_text(const BodyLedger& ledger) {
  std::string text =
      fmt::format("ledger     {}, {}to t = {:.6g} s; impulses and their moments\n", ledger.name,
                  ledger.since > 0 ? fmt::format("free, from t = {:.6g} ", ledger.since) : "",
                  ledger.since + ledger.time);
  for (const auto& [name, impulse] : ledger.impulses) text += row(name, impulse);
  text += fmt::format("  {:<20}{:>12.5g} J\n", "work of liquid", ledger.work_of_liquid);
  if (!ledger.is_free) return text;
  for (const auto& [name, work] : ledger.works)
    text += fmt::format("  {:<20}{:>12.5g} J\n", "work of " + name, work);
  text += fmt::format("  {:<20}{:>12.5g}{:>12.5g}{:>12.5g} N s\n", "change of momentum",
                      ledger.momentum_change[0], ledger.momentum_change[1], ledger.momentum_change[2]);
  text += fmt::format("  {:<20}{:>12.2g} of the liquid's impulse\n", "third-law residual",
                      ledger.third_law_residual);
  text += fmt::format("  {:<20}{:>12.2g} of the work that passed\n", "energy created", ledger.energy_created);
  text += fmt::format("  {:<20}{:>12.3g} with what was wet at t = {:.6g} s\n", "largest indicator",
                      ledger.largest_indicator, ledger.largest_indicator_time);
  text += fmt::format("  {:<20}{:>12.2f} an exchange, at most {}, residual up to {:.2g}\n", "iterations",
                      ledger.mean_iterations, ledger.most_iterations, ledger.largest_residual);
  return text;
}

}  // namespace sluice::clients
