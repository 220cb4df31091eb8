#pragma once

#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/exchange.hpp"
#include "server/simulation.hpp"

namespace sluice::server {

// Those who move the bodies, `sluice rigid` (the owner "") and participants of other names: an Exchange with
// each, and what they sent put together in the scene's order. Only `sluice rigid` repeats exchanges; the
// others' kinematics hold through all of its iterations, and they are answered when it has accepted.
class Owners {
 public:
  // What the probes measure at the last step answered.
  using Probes = std::function<std::vector<double>()>;
  struct Reply {
    std::string owner;
    protocol::Message message;
  };

  explicit Owners(const Simulation& simulation);

  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] bool has_others() const;
  [[nodiscard]] Exchange& of(const std::string& owner) { return find(owner).exchange; }

  // A participant takes the seat, and starts over if another had it before the run began.
  void join(const std::string& owner, bool wants_probes);

  // Who has sent no kinematics of the step yet; null when all have.
  [[nodiscard]] const std::string* late_with(std::uint64_t step) const;
  // Precondition of the rest: nobody is late with the step.
  void take(std::uint64_t step);
  // Of the step taken, in the scene's order; ledgers are zero of bodies with an owner.
  [[nodiscard]] std::span<const double> rows() const { return rows_; }
  [[nodiscard]] std::span<const double> ledger() const { return ledger_; }
  [[nodiscard]] std::span<const fluid::Kinematics> kinematics() const { return kinematics_; }

  // Notes the fluid's action at the end of the step; the replies that are due by that.
  std::vector<Reply> answer(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                            const Probes& probes);
  // The replies that an iterated exchange, now accepted, was waited for with.
  std::vector<Reply> answer_others(std::uint64_t step, std::span<const fluid::Wrench> wrenches,
                                   const Probes& probes);

 private:
  struct Owner {
    std::string name;
    std::vector<int> bodies;  // indices into Scene.body
    Exchange exchange;
    bool wants_probes = false;
  };

  [[nodiscard]] Owner& find(const std::string& name);
  [[nodiscard]] Exchange make_exchange(const std::string& name, std::size_t bodies) const;
  void answer(Owner& owner, std::uint64_t step, std::span<const fluid::Wrench> wrenches, const Probes& probes,
              std::vector<Reply>& replies);

  const Simulation& simulation_;
  std::deque<Owner> owners_;  // an Exchange is not copied
  std::vector<double> rows_, ledger_;
  std::vector<fluid::Kinematics> kinematics_;
};

}  // namespace sluice::server
