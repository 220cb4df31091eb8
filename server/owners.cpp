#include "server/owners.hpp"

#include <algorithm>
#include <cassert>

#include "protocol/body_kind.hpp"

namespace sluice::server {

namespace {

// Rows of an owner's bodies to their places among all.
void place(std::span<const double> own, std::span<const int> bodies, std::size_t width,
           std::vector<double>& all) {
  for (std::size_t k = 0; k < bodies.size(); ++k)
    std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(k * width), width,
                all.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(bodies[k]) * width));
}

}  // namespace

Owners::Owners(const Simulation& simulation) : simulation_(simulation), kinematics_(simulation.bodies) {
  for (const std::string& name : protocol::owners(simulation.scene)) {
    const std::vector<int> bodies = protocol::bodies_of(simulation.scene, name);
    owners_.push_back({name, bodies, make_exchange(name, bodies.size())});
  }
  for (const fluid::Kinematics& body : simulation.bodies) append(rows_, body);
  ledger_.assign(simulation.bodies.size() * kLedgerRow, 0.0);
}

// Of bodies with an owner nobody says which wait for an answer: they may be sent ahead, as prescribed ones
// are.
Exchange Owners::make_exchange(const std::string& name, std::size_t bodies) const {
  const bool is_rigid = name.empty();
  return {bodies,
          simulation_.clock.steps(),
          {.lock_step = is_rigid && simulation_.has_free_body(),
           .steps_per_exchange = simulation_.coupling.coupling.steps_per_exchange(),
           .steps_per_output = simulation_.clock.steps_per_interval(),
           .is_iterated = is_rigid && simulation_.is_iterated(),
           .done = simulation_.resumed.step}};
}

std::vector<std::string> Owners::names() const {
  std::vector<std::string> names;
  for (const Owner& owner : owners_) names.push_back(owner.name);
  return names;
}

bool Owners::has_others() const {
  return std::any_of(owners_.begin(), owners_.end(), [](const Owner& owner) { return !owner.name.empty(); });
}

Owners::Owner& Owners::find(const std::string& name) {
  const auto owner =
      std::find_if(owners_.begin(), owners_.end(), [&](const Owner& o) { return o.name == name; });
  assert(owner != owners_.end());
  return *owner;
}

void Owners::join(const std::string& name, bool wants_probes) {
  Owner& owner = find(name);
  owner.exchange = make_exchange(name, owner.bodies.size());
  owner.wants_probes = wants_probes;
}

const std::string* Owners::late_with(std::uint64_t step) const {
  for (const Owner& owner : owners_)
    if (!owner.exchange.has(step)) return &owner.name;
  return nullptr;
}

void Owners::take(std::uint64_t step) {
  for (const Owner& owner : owners_) {
    place(owner.exchange.rows(step), owner.bodies, kKinematicsRow, rows_);
    place(owner.exchange.ledger(), owner.bodies, kLedgerRow, ledger_);
  }
  for (std::size_t b = 0; b < kinematics_.size(); ++b)
    kinematics_[b] =
        read_kinematics(std::span<const double>(rows_).subspan(b * kKinematicsRow, kKinematicsRow));
}

std::vector<Owners::Reply> Owners::answer(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                                          const Probes& probes) {
  std::vector<Reply> replies;
  for (Owner& owner : owners_)
    if (owner.name.empty() || !simulation_.is_iterated()) answer(owner, step, wrenches, probes, replies);
  return replies;
}

std::vector<Owners::Reply> Owners::answer_others(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                                                 const Probes& probes) {
  std::vector<Reply> replies;
  for (Owner& owner : owners_)
    if (!owner.name.empty()) answer(owner, step, wrenches, probes, replies);
  return replies;
}

void Owners::answer(Owner& owner, std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                    const Probes& probes, std::vector<Reply>& replies) {
  std::vector<fluid::Wrench> own;
  for (const int b : owner.bodies) own.push_back(wrenches[static_cast<std::size_t>(b)]);
  const bool is_output = step % simulation_.clock.steps_per_interval() == 0;
  const bool has_probes = owner.wants_probes && is_output && step == owner.exchange.last_step();
  const std::vector<double> measured = has_probes ? probes() : std::vector<double>{};
  if (std::optional<protocol::Message> reply = owner.exchange.answer(step, own, measured))
    replies.push_back({owner.name, std::move(*reply)});
}

}  // namespace sluice::server
