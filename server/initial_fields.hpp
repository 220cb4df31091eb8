#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "fluid/equation_of_state.hpp"
#include "protocol/formula.hpp"
#include "protocol/scene_file.hpp"

namespace sluice::server {

// Velocity, pressure and displacement that a region of liquid starts with, at a lattice point. `scene` has
// its defaults filled in. All throw SceneError naming formula and place for a value that is not usable.
class InitialFields {
 public:
  InitialFields(const Scene& scene, int region);

  [[nodiscard]] Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;  // [m]
  [[nodiscard]] Eigen::Vector3d velocity(const Eigen::Vector3d& x) const;      // [m/s]
  [[nodiscard]] double pressure(const Eigen::Vector3d& x) const;               // [Pa]

 private:
  struct NamedFormula {
    std::string field;
    protocol::Formula formula;
    [[nodiscard]] double at(const Eigen::Vector3d& x) const;
  };
  using VectorFormula = std::array<NamedFormula, 3>;

  static NamedFormula parse(const std::string& field, const std::string& text);
  static VectorFormula parse(const std::string& field, const Field& formulas);
  static Eigen::Vector3d at(const VectorFormula& formula, const Eigen::Vector3d& x);

  const Scene& scene_;
  const FluidRegion& region_;
  int number_;  // of the region
  fluid::EquationOfState eos_;
  Eigen::Vector3d gravity_;
  VectorFormula displacement_, velocity_;
  NamedFormula pressure_;
};

}  // namespace sluice::server
