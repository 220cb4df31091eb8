#include "fluid/halo.hpp"

#include <cmath>

namespace sluice::fluid {

template <int Dim>
Halo<Dim>::Halo(const Period& period, double width)
    : lower_(narrow<Dim>(period.lower)),
      length_(narrow<Dim>(period.length)),
      width_(width),
      is_used_((length_.array() > 0.0).any()) {}

template <int Dim>
void Halo<Dim>::wrap(Particles<Dim>& fluid) const {
  if (!is_used()) return;
  for (Node<Dim>& node : fluid.node)
    for (int a = 0; a < Dim; ++a)
      if (length_[a] > 0.0) node.x[a] -= length_[a] * std::floor((node.x[a] - lower_[a]) / length_[a]);
}

template <int Dim>
void Halo<Dim>::remove(Particles<Dim>& fluid) {
  fluid.node.resize(fluid.size());
}

// Axis by axis, images of images included, which fills the corners.
template <int Dim>
std::vector<Node<Dim>> Halo<Dim>::find(const Particles<Dim>& fluid) {
  std::vector<Node<Dim>> nodes;
  image_.clear();
  const auto add = [&](std::uint32_t of, const Vec<Dim>& x, const Vec<Dim>& shift, int axis) {
    for (const double way : {1.0, -1.0}) {
      const double beyond = way > 0 ? x[axis] - lower_[axis] : lower_[axis] + length_[axis] - x[axis];
      if (beyond >= width_) continue;
      Vec<Dim> whole = shift;
      whole[axis] += way * length_[axis];
      image_.push_back({of, whole});
      nodes.push_back(fluid.node[of]);
      nodes.back().x += whole;
    }
  };
  for (int axis = 0; axis < Dim; ++axis) {
    if (length_[axis] <= 0.0) continue;
    const std::size_t images = image_.size();
    for (std::uint32_t i = 0; i < fluid.size(); ++i) add(i, fluid.node[i].x, Vec<Dim>::Zero(), axis);
    for (std::size_t k = 0; k < images; ++k)
      add(image_[k].of, Vec<Dim>(nodes[k].x), Vec<Dim>(image_[k].shift), axis);
  }
  return nodes;
}

template <int Dim>
void Halo<Dim>::append(Particles<Dim>& fluid, const std::vector<std::uint32_t>& order) {
  std::vector<Image> sorted;
  for (const std::uint32_t k : order) sorted.push_back(image_[k]);
  image_.swap(sorted);
  const std::size_t all = fluid.size() + image_.size();
  fluid.node.resize(all);
  fluid.pressure.resize(all);
  fluid.fit.resize(all);
  fluid.source.resize(all);
  if (!fluid.stress.empty()) fluid.stress.resize(all);
  if (!fluid.slope_source.empty()) fluid.slope_source.resize(all);
  if (!fluid.point_source.empty()) fluid.point_source.resize(Particles<Dim>::kPoints * all);
  refresh_nodes(fluid);
}

template <int Dim>
void Halo<Dim>::refresh_nodes(Particles<Dim>& fluid) const {
  for (std::size_t k = 0; k < image_.size(); ++k) {
    Node<Dim>& node = fluid.node[fluid.size() + k];
    node = fluid.node[image_[k].of];
    node.x += image_[k].shift;
  }
}

template <int Dim>
void Halo<Dim>::refresh_sources(Particles<Dim>& fluid) const {
  for (std::size_t k = 0; k < image_.size(); ++k) {
    const std::size_t to = fluid.size() + k;
    fluid.node[to].rho = fluid.node[image_[k].of].rho;
    fluid.pressure[to] = fluid.pressure[image_[k].of];
    fluid.fit[to] = fluid.fit[image_[k].of];
    fluid.source[to] = fluid.source[image_[k].of];
    if (!fluid.stress.empty()) fluid.stress[to] = fluid.stress[image_[k].of];
    if (!fluid.slope_source.empty()) fluid.slope_source[to] = fluid.slope_source[image_[k].of];
    if (fluid.point_source.empty()) continue;
    constexpr std::size_t kPoints = Particles<Dim>::kPoints;
    for (std::size_t s = 0; s < kPoints; ++s)
      fluid.point_source[kPoints * to + s] = fluid.point_source[kPoints * image_[k].of + s];
  }
}

template class Halo<2>;
template class Halo<3>;

}  // namespace sluice::fluid
