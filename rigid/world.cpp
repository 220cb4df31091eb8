#include "rigid/world.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "rigid/contact_drift.hpp"
#include "rigid/free_body.hpp"

namespace sluice::rigid {
namespace {

// Bullet turns a body by no more than this in a step [rad].
constexpr double kLargestTurn = std::numbers::pi / 4;

void check(const BodySpec& body) {
  if (!body.motion) {
    if (!(body.mass > 0) || !std::isfinite(body.mass))
      throw std::invalid_argument(
          fmt::format("body '{}' is free and has a mass of {:g} kg; give it a positive mass "
                      "or density, or a prescribed motion",
                      body.name, body.mass));
    return;
  }
  try {
    check_starts_at_zero(*body.motion);
  } catch (const MotionError& error) {
    throw std::invalid_argument(fmt::format("body '{}': {}", body.name, error.what()));
  }
}

void check_turn(const std::string& name, const FreeBody::Drift& drift, double dt) {
  const double turn = drift.angular_velocity.norm() * dt;
  if (turn < kLargestTurn && drift.velocity.allFinite()) return;
  throw std::runtime_error(
      fmt::format("body '{}' moves at {:g} m/s and would turn by {:g} rad in one step of {:g} s, "
                  "more than pi/4; check the forces on it",
                  name, drift.velocity.norm(), turn, dt));
}

Kinematics prescribed(const BodySpec& body, const Offset& start, const Offset& end, double dt) {
  Kinematics step;
  step.position = body.pose.position + end.position;
  step.orientation = rotation(end.rotation) * body.pose.orientation;
  step.velocity = (end.position - start.position) / dt;
  step.angular_velocity = (end.rotation - start.rotation) / dt;
  step.acceleration = end.acceleration;
  step.angular_acceleration = end.angular_acceleration;
  return step;
}

}  // namespace

struct World::Parts {
  WorldSpec spec;
  std::vector<std::optional<FreeBody>> free;
  std::vector<Offset> offset;             // of prescribed bodies, at the end of the last step
  std::unique_ptr<ContactDrift> contact;  // absent where no body is free
  std::vector<std::optional<FreeBody>> saved_free;
  std::vector<Offset> saved_offset;

  explicit Parts(WorldSpec s) : spec(std::move(s)), free(spec.bodies.size()), offset(spec.bodies.size()) {
    std::vector<const FreeBody*> pointers(spec.bodies.size(), nullptr);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      check(spec.bodies[b]);
      if (spec.bodies[b].motion) {
        offset[b] = spec.bodies[b].motion->at(0);
      } else {
        free[b].emplace(spec.bodies[b], spec.gravity, spec.dimension);
        pointers[b] = &*free[b];
      }
    }
    if (has_free()) contact = std::make_unique<ContactDrift>(spec, pointers);
  }

  [[nodiscard]] bool has_free() const {
    return std::any_of(free.begin(), free.end(), [](const auto& body) { return body.has_value(); });
  }

  void set_wrenches(std::span<const Wrench> wrenches) {
    if (wrenches.size() != free.size())
      throw std::invalid_argument(fmt::format("{} wrenches for {} bodies", wrenches.size(), free.size()));
    for (std::size_t b = 0; b < free.size(); ++b) {
      if (!free[b]) continue;
      if (!wrenches[b].force.allFinite() || !wrenches[b].moment.allFinite())
        throw std::invalid_argument(
            fmt::format("the wrench on body '{}' is not finite", spec.bodies[b].name));
      free[b]->set_wrench(wrenches[b]);
    }
  }
};

World::World(WorldSpec spec) : parts_(std::make_unique<Parts>(std::move(spec))) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::start(std::span<const Wrench> wrenches) {
  parts_->set_wrenches(wrenches);
}

std::vector<Kinematics> World::predict(double end, double dt) {
  const std::vector<BodySpec>& bodies = parts_->spec.bodies;
  std::vector<Kinematics> steps(bodies.size());
  std::vector<FreeBody::Drift> before(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (auto& free = parts_->free[b]) {
      free->kick(dt / 2);
      before[b] = free->begin_drift(dt);
      check_turn(bodies[b].name, before[b], dt);
    } else {
      const Offset start = parts_->offset[b];
      parts_->offset[b] = bodies[b].motion->at(end);
      steps[b] = prescribed(bodies[b], start, parts_->offset[b], dt);
      before[b] = {
          {bodies[b].pose.position + start.position, rotation(start.rotation) * bodies[b].pose.orientation},
          steps[b].velocity,
          steps[b].angular_velocity};
    }
  }
  if (!parts_->contact) return steps;

  std::vector<FreeBody::Drift> after = before;
  parts_->contact->step(dt, after);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (auto& free = parts_->free[b]) steps[b] = free->finish_drift(dt, before[b], after[b]);
  return steps;
}

void World::correct(double dt, std::span<const Wrench> wrenches) {
  parts_->set_wrenches(wrenches);
  for (auto& free : parts_->free)
    if (free) free->kick(dt / 2);
}

void World::push(std::span<const Wrench> impulses) {
  for (std::size_t b = 0; b < impulses.size(); ++b)
    if (auto& free = parts_->free[b]) free->push(impulses[b]);
}

void World::save() {
  parts_->saved_free = parts_->free;
  parts_->saved_offset = parts_->offset;
  if (parts_->contact) parts_->contact->drop_contacts();
}

void World::restore() {
  parts_->free = parts_->saved_free;
  parts_->offset = parts_->saved_offset;
  if (parts_->contact) parts_->contact->drop_contacts();
}

std::size_t World::size() const {
  return parts_->free.size();
}
bool World::has_free_bodies() const {
  return parts_->has_free();
}
bool World::is_free(std::size_t body) const {
  return parts_->free.at(body).has_value();
}
double World::mass(std::size_t body) const {
  return parts_->free.at(body).value().mass();
}
double World::impulse_energy(std::size_t body, const Wrench& impulse) const {
  return parts_->free.at(body).value().impulse_energy(impulse);
}
Kinematics World::state(std::size_t body) const {
  return parts_->free.at(body).value().state();
}
Account World::account(std::size_t body) const {
  return parts_->free.at(body).value().account();
}
double World::kinetic_energy(std::size_t body) const {
  return parts_->free.at(body).value().kinetic_energy();
}

}  // namespace sluice::rigid
