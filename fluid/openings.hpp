#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "fluid/equation_of_state.hpp"
#include "fluid/kernel.hpp"
#include "fluid/neighbor_search.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"
#include "fluid/solver.hpp"

namespace sluice::fluid {

// Openings in the sides of the tank. Behind each stands a buffer of particles as deep as two supports, so
// that the fluid in the tank sees liquid with complete supports of its own. Buffer particles take part in all
// sweeps, but their velocity and density are set here and not by the forces on them:
//   given speed, pressure or level: as given (a level sets the hydrostatic pressure below it);
//   else: that of the flow in the tank at the plane of the opening, by a fit of the particles there.
// One that crosses the plane inward becomes fluid, one of the fluid that crosses it outward becomes a buffer
// particle, which ends at the buffer's outer end. At an inflow new ones are made there, column by column of a
// lattice, so that what comes in is a lattice. After M. Lastiwka, M. Basa, N. Quinlan (Int. J. Numer. Meth.
// Fluids 61, 2009), I. Federico et al. (Eur. J. Mech. B 34, 2012), A. Tafuni et al. (Comput. Methods Appl.
// Mech. Engrg. 342, 2018); README.md, "Openings".
template <int Dim>
class Openings {
 public:
  // `support` and `skin` [m] are those of the neighbour search.
  Openings(const Setup& setup, double support, double skin);

  [[nodiscard]] bool is_used() const { return !gates_.empty(); }

  // Puts the first buffer particles in: an outflow's go on from the fluid beside it.
  void fill(Particles<Dim>& fluid);

  // Time and the lattices go on by dt [s].
  void advance(double dt);
  // Particles cross, come and go. Before a rebuild of the neighbour lists; images are removed.
  void exchange(Particles<Dim>& fluid);
  // Finds the particles that the next steps ask for. After a rebuild.
  void list(const Particles<Dim>& fluid);

  // Sets what buffer particles have, from the fluid's present velocities and densities.
  // `dt` [s] is the time since the last time; 0 at the start.
  void impose_velocity(double dt, Particles<Dim>& fluid, const Parallel& parallel);
  void impose_density(Particles<Dim>& fluid, const Parallel& parallel);
  // Takes the acceleration off the buffers.
  void stop_acceleration(Particles<Dim>& fluid, const Parallel& parallel) const;
  // Counts their work on the fluid in a step [s], from their power [W] at its end.
  void count_work(double dt, double power);

  // Calls visit(b, i) for buffer particles and fluid particles near them; maybe for some a little farther
  // than the support.
  template <typename Visit>
  void for_pairs(const Visit& visit) const {
    for (std::size_t k = 0; k < touching_.size(); ++k)
      for (const std::uint32_t i : pairs_.of(k)) visit(touching_[k], i);
  }

  // Energy brought in less energy taken out, and the buffers' work on the fluid [J].
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] std::vector<Passage> passages(const Particles<Dim>& fluid) const;

  // Whether x [m] is on the tank's side of all planes.
  [[nodiscard]] bool is_inside(const Vec<Dim>& x) const;

  auto state() {
    return std::tie(time_, work_, power_, next_id_, passage_, column_, hold_, beside_, near_, touching_,
                    pairs_);
  }

 private:
  // What does not change in a run.
  struct Gate {
    Opening given;
    Eigen::Index axis;
    double plane, inward;  // coordinate of the plane [m]; 1 at a lower side, -1 at an upper one
    Vec<Dim> min, cell;  // lower corner of the rectangle and its cells; along the axis the lattice's spacing
    Eigen::Matrix<std::size_t, Dim, 1> cells;  // of the rectangle, 1 along the axis
    std::size_t layers, first;                 // of the buffer; first of the columns

    [[nodiscard]] double depth() const { return static_cast<double>(layers) * cell[axis]; }
    [[nodiscard]] double distance(const Vec<Dim>& x) const { return inward * (x[axis] - plane); }
    [[nodiscard]] Vec<Dim> normal() const { return inward * Vec<Dim>::Unit(axis); }
    [[nodiscard]] std::size_t columns() const { return cells.prod(); }
    [[nodiscard]] Vec<Dim> foot(std::size_t column) const;
    // That at x, or the nearest.
    [[nodiscard]] std::size_t column(const Vec<Dim>& x) const;
    // Whether x is in front of or behind the rectangle, or at most `margin` [m] beyond its edges.
    [[nodiscard]] bool is_across(const Vec<Dim>& x, double margin) const;
    [[nodiscard]] bool takes_velocity() const { return !given.inflow || !given.speed; }
    [[nodiscard]] bool takes_density() const { return !given.level && !given.pressure; }
  };
  // A line across the opening, through the middle of a cell of the rectangle; its foot is in the plane.
  struct Column {
    Vec<Dim> velocity = Vec<Dim>::Zero();  // [m/s]
    double rho = 0;                        // at the foot [kg/m^3]
    double share = 0;                      // to which these are the flow's; 0 where the opening is dry
    double way = 0;  // at an inflow, of the newest particle from the buffer's outer end [m]
  };

  // Of an inflow that holds a level: opening_flow.cpp.
  struct Hold {
    double depth = 0;  // of the liquid in front [m], without its quick changes
    double speed = 0;  // into the tank, without its changes [m/s]
  };

  [[nodiscard]] Gate make_gate(const Opening& opening) const;
  [[nodiscard]] double head(const Gate& gate, const Vec<Dim>& x) const;
  [[nodiscard]] bool is_wet(const Gate& gate, std::size_t column) const;

  void add(Particles<Dim>& fluid, std::size_t gate, const Node<Dim>& node, double mass);
  void fill_inflow(Particles<Dim>& fluid, std::size_t gate);
  void fill_outflow(Particles<Dim>& fluid, std::size_t gate);
  void cross(Particles<Dim>& fluid, std::size_t i);
  void count(const Particles<Dim>& fluid, std::size_t i, std::size_t gate, double sign);
  [[nodiscard]] bool has_left(const Particles<Dim>& fluid, std::size_t i) const;
  void remove_left(Particles<Dim>& fluid);
  void find_newest(const Particles<Dim>& fluid);
  void feed(Particles<Dim>& fluid, std::size_t gate);

  void find_velocity(std::size_t gate, double dt, const Particles<Dim>& fluid, const Parallel& parallel);
  void find_density(std::size_t gate, const Particles<Dim>& fluid, const Parallel& parallel);
  [[nodiscard]] double mean_speed(std::size_t gate, const Particles<Dim>& fluid) const;
  [[nodiscard]] double water_depth(std::size_t gate, const Particles<Dim>& fluid) const;
  double hold_level(std::size_t gate, double dt, const Particles<Dim>& fluid);
  void take_velocity(const Gate& gate, const Particles<Dim>& fluid, std::size_t column);
  void take_density(const Gate& gate, const Particles<Dim>& fluid, std::size_t column);
  template <typename Visit>
  void for_buffers(const Particles<Dim>& fluid, const Parallel& parallel, const Visit& visit);

  WendlandC2<Dim> kernel_;
  EquationOfState eos_;
  Vec<Dim> gravity_;
  double spacing_, volume_, support_, skin_;
  double moment_floor_;  // [m^2]
  std::vector<Gate> gates_;

  double time_ = 0, work_ = 0, power_ = 0;  // [s], [J], [W]
  std::uint32_t next_id_ = 0;
  std::vector<Passage> passage_;
  std::vector<Column> column_;           // of the gates, one after the other
  std::vector<Hold> hold_;               // of the gates
  NeighborList beside_, near_;           // fluid particles at the gates, and near the feet of the columns
  std::vector<std::uint32_t> touching_;  // buffer particles within a support of a plane
  NeighborList pairs_;                   // fluid particles near those
};

extern template class Openings<2>;
extern template class Openings<3>;

}  // namespace sluice::fluid
