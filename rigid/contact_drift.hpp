#pragma once

#include <memory>
#include <span>
#include <vector>

#include "rigid/free_body.hpp"
#include "rigid/world.hpp"

namespace sluice::rigid {

// The drift of all bodies over a step under contact. Bullet is behind it and keeps nothing but its cache of
// contacts from one step to the next.
class ContactDrift {
 public:
  // `free[b]` is null for prescribed bodies.
  ContactDrift(const WorldSpec& spec, std::span<const FreeBody* const> free);
  ~ContactDrift();
  ContactDrift(const ContactDrift&) = delete;
  ContactDrift& operator=(const ContactDrift&) = delete;

  // Body `b`, prescribed so far, is free from now on.
  void release(std::size_t b, const FreeBody& free);
  // The opposite.
  void hold(std::size_t b);

  // In: poses at the start of the step and velocities over it. Out: for free bodies, the pose at its end and
  // the velocities after contact.
  void step(double dt, std::span<FreeBody::Drift> bodies);

  // Forgets the contact points of the step before.
  void drop_contacts();

 private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace sluice::rigid
