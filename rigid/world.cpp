#include "rigid/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "rigid/contact_drift.hpp"
#include "rigid/free_body.hpp"
#include "rigid/joint_solver.hpp"
#include "rigid/state_numbers.hpp"

namespace sluice::rigid {
namespace {

// Bullet turns a body by no more than this in a step [rad].
constexpr double kLargestTurn = std::numbers::pi / 4;

bool is_ever_free(const BodySpec& body) {
  return !body.motion || std::isfinite(body.release) || is_guided(body);
}

void check(const BodySpec& body) {
  if (is_ever_free(body) && (!(body.mass > 0) || !std::isfinite(body.mass)))
    throw std::invalid_argument(
        fmt::format("body '{}' is free and has a mass of {:g} kg; give it a positive mass "
                    "or density, or a prescribed motion",
                    body.name, body.mass));
  if (!body.motion) return;
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

// The body as its motion leaves it at `offset`.
BodySpec released(const BodySpec& body, const Offset& offset) {
  BodySpec free = body;
  free.motion = nullptr;
  free.pose = {body.pose.position + offset.position, rotation(offset.rotation) * body.pose.orientation};
  free.velocity = offset.velocity;
  free.angular_velocity = offset.angular_velocity;
  return free;
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

bool is_guided(const BodySpec& body) {
  const auto any = [](const std::array<bool, 3>& axes) { return axes[0] || axes[1] || axes[2]; };
  return body.motion && (any(body.free) || any(body.free_rotation));
}

struct World::Parts {
  WorldSpec spec;
  std::vector<std::optional<FreeBody>> free;
  std::vector<Offset> offset;             // of prescribed bodies, at the end of the last step
  std::vector<Wrench> wrench;             // the last ones
  std::unique_ptr<ContactDrift> contact;  // absent where no body is free
  JointSolver joints;
  std::vector<Wrench> load;  // of springs and dampers, at the end of the last step
  // What save() kept.
  struct Saved {
    std::vector<std::optional<FreeBody>> free;
    std::vector<Offset> offset;
    std::vector<Wrench> wrench, load;
  } saved;

  explicit Parts(WorldSpec s)
      : spec(std::move(s)),
        free(spec.bodies.size()),
        offset(spec.bodies.size()),
        wrench(spec.bodies.size()),
        joints(spec.joints, spec.bodies),
        load(spec.bodies.size()) {
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      check(spec.bodies[b]);
      const BodySpec& body = spec.bodies[b];
      if (body.motion) offset[b] = body.motion->at(0);
      if (!body.motion || is_guided(body)) free[b].emplace(body, spec.gravity, spec.dimension);
    }
    if (is_any_ever_free()) make_contact();
    set_loads(joints.loads(jointed()));
  }

  void make_contact() {
    std::vector<const FreeBody*> pointers;
    for (const std::optional<FreeBody>& body : free) pointers.push_back(body ? &*body : nullptr);
    contact = std::make_unique<ContactDrift>(spec, pointers);
  }

  template <typename Visitor>
  void visit_body(std::size_t b, Visitor& visitor) {
    if (free[b]) free[b]->visit_state(visitor);
    visitor.visit_all(offset[b], wrench[b], load[b]);
  }

  [[nodiscard]] bool is_any_ever_free() const {
    return std::any_of(spec.bodies.begin(), spec.bodies.end(), is_ever_free);
  }

  [[nodiscard]] bool is_moved(std::size_t b) const { return !free[b] || free[b]->is_guided(); }

  // Frees the bodies whose time has come by the beginning of a step [s].
  void release(double start, double dt) {
    for (std::size_t b = 0; b < free.size(); ++b) {
      const BodySpec& body = spec.bodies[b];
      constexpr double kRoundOff = 1e-6;  // of a step
      if (!is_moved(b) || start < body.release - kRoundOff * dt) continue;
      if (free[b])
        free[b]->let_go(body);
      else
        free[b].emplace(released(body, offset[b]), spec.gravity, spec.dimension);
      free[b]->set_wrench(wrench[b]);
      free[b]->set_load(load[b]);
      contact->release(b, *free[b]);
    }
  }

  [[nodiscard]] Pose pose_of(std::size_t b, const Offset& at) const {
    const Pose& start = spec.bodies[b].pose;
    return {start.position + at.position, rotation(at.rotation) * start.orientation};
  }

  // As they stand; prescribed bodies moved from `start` to where they are.
  std::vector<JointedBody> jointed(std::span<const Offset> start = {}) {
    std::vector<JointedBody> bodies(free.size());
    for (std::size_t b = 0; b < free.size(); ++b) {
      if (free[b]) {
        bodies[b].free = &*free[b];
        continue;
      }
      bodies[b].start = pose_of(b, start.empty() ? offset[b] : start[b]);
      bodies[b].end = pose_of(b, offset[b]);
      bodies[b].velocity = offset[b].velocity;
      bodies[b].angular_velocity = offset[b].angular_velocity;
    }
    return bodies;
  }

  void set_loads(std::vector<Wrench> loads) {
    load = std::move(loads);
    for (std::size_t b = 0; b < free.size(); ++b)
      if (free[b]) free[b]->set_load(load[b]);
  }

  void drift(double dt, std::span<const Offset> start, std::vector<FreeBody::Drift>& before,
             std::vector<FreeBody::Drift>& after);
  void drift_joined(double dt, std::vector<JointedBody>& bodies, std::vector<FreeBody::Drift>& before,
                    std::vector<FreeBody::Drift>& after);
  void begin_drifts(double dt, std::vector<FreeBody::Drift>& before) const {
    for (std::size_t b = 0; b < free.size(); ++b)
      if (free[b]) before[b] = free[b]->begin_drift(dt);
  }
  void finish_kick(double dt);

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
    wrench.assign(wrenches.begin(), wrenches.end());
  }
};

// Joints first, then contact with what the joints leave.
void World::Parts::drift(double dt, std::span<const Offset> start, std::vector<FreeBody::Drift>& before,
                         std::vector<FreeBody::Drift>& after) {
  std::vector<JointedBody> bodies = jointed(start);
  if (!joints.empty()) joints.hold(dt, bodies);
  begin_drifts(dt, before);
  for (std::size_t b = 0; b < free.size(); ++b)
    if (free[b]) check_turn(spec.bodies[b].name, before[b], dt);
  after = before;
  contact->step(dt, after);
  if (!joints.empty()) drift_joined(dt, bodies, before, after);
}

// Where contact touches joined bodies, joints and contact take turns; the joints have the last word, and what
// that leaves of a penetration the next steps' contact sees.
void World::Parts::drift_joined(double dt, std::vector<JointedBody>& bodies,
                                std::vector<FreeBody::Drift>& before, std::vector<FreeBody::Drift>& after) {
  constexpr int kTurns = 4;
  for (int turn = 0; turn < kTurns; ++turn) {
    bool touched = false;
    for (std::size_t b = 0; b < free.size(); ++b) {
      if (!free[b] || !joints.holds(b)) continue;
      bodies[b].contact = after[b].velocity - before[b].velocity;
      bodies[b].contact_turn = after[b].angular_velocity - before[b].angular_velocity;
      touched = touched || bodies[b].contact.norm() > 0 || bodies[b].contact_turn.norm() > 0;
    }
    if (!touched) break;
    joints.hold(dt, bodies);
    begin_drifts(dt, before);
    after = before;
    contact->step(dt, after);
  }
  for (std::size_t b = 0; b < free.size(); ++b) {
    if (!free[b] || !joints.holds(b)) continue;
    after[b] = before[b];
    after[b].pose = free[b]->drifted(dt, bodies[b].contact, bodies[b].contact_turn);
    after[b].velocity += bodies[b].contact;
    after[b].angular_velocity += bodies[b].contact_turn;
  }
}

// The second half of a step's kick, with springs and dampers at its end: a damper's force goes with the
// velocity that it makes, found by iteration.
void World::Parts::finish_kick(double dt) {
  constexpr int kIterations = 100;
  constexpr double kTolerance = 1e-13;
  const std::vector<std::optional<FreeBody>> half = free;
  const int iterations = joints.has_dampers() ? kIterations : 1;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<Wrench> before = load;
    set_loads(joints.loads(jointed()));
    double changed = 0, size = 0;
    for (std::size_t b = 0; b < free.size(); ++b) {
      changed += (load[b].force - before[b].force).norm() + (load[b].moment - before[b].moment).norm();
      size += load[b].force.norm() + load[b].moment.norm();
    }
    if (i > 1 && changed <= kTolerance * size) return;
    for (std::size_t b = 0; b < free.size(); ++b) {
      if (!free[b]) continue;
      free[b].emplace(*half[b]);
      free[b]->set_load(load[b]);
      free[b]->kick(dt / 2);
    }
    if (std::vector<JointedBody> bodies = jointed(); !joints.empty()) joints.project(bodies);
  }
  if (iterations > 1)
    throw std::runtime_error(fmt::format(
        "the dampers of the joints are too strong for a step of {:g} s: the velocities at its end "
        "are not found; lower `damping` or make the bodies heavier",
        dt));
}

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
  std::vector<FreeBody::Drift> before(bodies.size()), after;
  parts_->release(end - dt, dt);
  const std::vector<Offset> start = parts_->offset;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (parts_->is_moved(b)) parts_->offset[b] = bodies[b].motion->at(end);
    if (auto& free = parts_->free[b]) {
      if (free->is_guided()) free->set_off(start[b], parts_->offset[b], dt);
      free->begin_step();
      free->kick(dt / 2);
    } else {
      steps[b] = prescribed(bodies[b], start[b], parts_->offset[b], dt);
      before[b] = {parts_->pose_of(b, start[b]), steps[b].velocity, steps[b].angular_velocity};
    }
  }
  if (!parts_->contact) return steps;

  parts_->drift(dt, start, before, after);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    auto& free = parts_->free[b];
    if (!free) continue;
    steps[b] = free->finish_drift(dt, before[b], after[b]);
    if (!free->is_guided()) continue;
    free->arrive(bodies[b], parts_->offset[b]);
    steps[b].position = free->pose().position;
  }
  return steps;
}

void World::correct(double dt, std::span<const Wrench> wrenches) {
  parts_->set_wrenches(wrenches);
  if (!parts_->joints.empty()) return parts_->finish_kick(dt);
  for (auto& free : parts_->free)
    if (free) free->kick(dt / 2);
}

void World::push(std::span<const Wrench> impulses) {
  for (std::size_t b = 0; b < impulses.size(); ++b)
    if (auto& free = parts_->free[b]) free->push(impulses[b]);
}

void World::save() {
  parts_->saved = {parts_->free, parts_->offset, parts_->wrench, parts_->load};
  if (parts_->contact) parts_->contact->drop_contacts();
}

void World::restore() {
  const Parts::Saved& saved = parts_->saved;
  for (std::size_t b = 0; b < saved.free.size(); ++b) {
    if (parts_->free[b] && !saved.free[b]) parts_->contact->hold(b);
    if (saved.free[b] && saved.free[b]->is_guided() && !parts_->free[b]->is_guided())
      parts_->contact->release(b, *saved.free[b]);
  }
  parts_->free = saved.free;
  parts_->offset = saved.offset;
  parts_->wrench = saved.wrench;
  parts_->load = saved.load;
  if (parts_->contact) parts_->contact->drop_contacts();
}

void World::renew_contact() {
  if (parts_->contact) parts_->make_contact();
}

std::vector<double> World::write_state() {
  NumberWriter writer;
  for (std::size_t b = 0; b < parts_->free.size(); ++b) {
    double is_free = parts_->free[b] ? 1 : 0, is_moved = parts_->is_moved(b) ? 1 : 0;
    writer.visit_all(is_free, is_moved);
    parts_->visit_body(b, writer);
  }
  return writer.take();
}

std::span<const double> World::read_state(std::span<const double> row) {
  NumberReader reader(row);
  for (std::size_t b = 0; b < parts_->free.size(); ++b) {
    double is_free = 0, is_moved = 0;
    reader.visit_all(is_free, is_moved);
    const BodySpec& body = parts_->spec.bodies[b];
    if (is_free == 0)
      parts_->free[b].reset();
    else
      parts_->free[b].emplace(body, parts_->spec.gravity, parts_->spec.dimension);
    if (is_free != 0 && is_moved == 0 && is_guided(body)) parts_->free[b]->let_go(body);
    parts_->visit_body(b, reader);
  }
  renew_contact();
  return reader.rest();
}

std::size_t World::size() const {
  return parts_->free.size();
}
bool World::has_free_bodies() const {
  return parts_->is_any_ever_free();
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
