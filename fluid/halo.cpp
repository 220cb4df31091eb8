#include "fluid/halo.hpp"

#include <algorithm>

#include "fluid/permute.hpp"

namespace sluice::fluid {

template <int Dim>
Halo<Dim>::Halo(const Period& period, const Mirrors& mirrors, double width) : width_(width) {
  for (int a = 0; a < Dim; ++a) {
    const double lower = period.lower[a], length = period.length[a];
    if (length > 0.0) {
      sides_.push_back({a, lower, 1.0, 1.0, length});
      sides_.push_back({a, lower + length, -1.0, 1.0, -length});
    }
    const auto side = static_cast<std::size_t>(2 * a);
    if (mirrors.at[side]) sides_.push_back({a, mirrors.lower[a], 1.0, -1.0, 2.0 * mirrors.lower[a]});
    if (mirrors.at[side + 1]) sides_.push_back({a, mirrors.upper[a], -1.0, -1.0, 2.0 * mirrors.upper[a]});
  }
}

template <int Dim>
bool Halo<Dim>::has_mirrors() const {
  return std::any_of(sides_.begin(), sides_.end(), [](const Side& side) { return side.flip < 0.0; });
}

template <int Dim>
Node<Dim> Halo<Dim>::Image::node(const Node<Dim>& original) const {
  Node<Dim> node = original;
  node.x = vector(original.x) + shift;
  node.v = vector(original.v);
  return node;
}

template <int Dim>
void Halo<Dim>::wrap(Particles<Dim>& fluid) {
  for (const Side& side : sides_)
    for (std::size_t i = 0; i < fluid.size(); ++i) {
      if (side.distance(fluid.node[i].x) >= 0.0) continue;
      if (side.flip < 0.0) {
        reflect(side, fluid.mass[i], fluid.node[i]);
      } else {
        while (side.distance(fluid.node[i].x) < 0.0) fluid.node[i].x[side.axis] += side.shift;
      }
    }
}

template <int Dim>
void Halo<Dim>::reflect(const Side& side, double mass, Node<Dim>& node) {
  const auto count = [&](double sign) {
    const Eigen::Vector3d momentum = sign * mass * widen<Dim>(node.v);
    impulse_.linear += momentum;
    impulse_.angular += widen<Dim>(node.x).cross(momentum);
  };
  count(1.0);
  node.x[side.axis] = side.shift - node.x[side.axis];
  node.v[side.axis] = -node.v[side.axis];
  count(-1.0);
}

template <int Dim>
void Halo<Dim>::remove(Particles<Dim>& fluid) {
  fluid.node.resize(fluid.size());
  if (!fluid.liquid.empty()) fluid.liquid.resize(fluid.size());
}

// Axis by axis, images of images included, which fills the corners.
template <int Dim>
std::vector<Node<Dim>> Halo<Dim>::find(const Particles<Dim>& fluid,
                                       const std::function<bool(const Vec<Dim>&)>& needed) {
  image_.clear();
  const auto add = [&](const Side& side, const Image& original) {
    const Node<Dim> node = original.node(fluid.node[original.of]);
    if (side.distance(node.x) >= width_) return;
    Image image = original;
    image.flip[side.axis] = side.flip;
    image.shift[side.axis] = side.shift;
    image_.push_back(image);
  };
  std::size_t other_axes = 0;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (s > 0 && sides_[s].axis != sides_[s - 1].axis) other_axes = image_.size();
    for (std::uint32_t i = 0; i < fluid.size(); ++i) add(sides_[s], {i, Vec<Dim>::Ones(), Vec<Dim>::Zero()});
    for (std::size_t k = 0; k < other_axes; ++k) add(sides_[s], Image(image_[k]));
  }
  std::vector<Node<Dim>> nodes;
  std::vector<Image> kept;
  for (const Image& image : image_) {
    const Node<Dim> node = image.node(fluid.node[image.of]);
    if (!needed(node.x)) continue;
    nodes.push_back(node);
    kept.push_back(image);
  }
  image_.swap(kept);
  return nodes;
}

template <int Dim>
bool Halo<Dim>::is_within(const Vec<Dim>& x, double reach) const {
  return std::all_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return side.distance(x) > -reach; });
}

template <int Dim>
void Halo<Dim>::append(Particles<Dim>& fluid, const std::vector<std::uint32_t>& order) {
  permute(image_, order);
  const std::size_t all = fluid.size() + image_.size();
  const auto resize = [](auto& values, std::size_t count) {
    if (values.capacity() < count) values.reserve(count + count / 32);
    values.resize(count);
  };
  const auto resize_used = [resize](auto& values, std::size_t count) {
    if (!values.empty()) resize(values, std::max<std::size_t>(count, 1));
  };
  resize(fluid.node, all);
  resize(fluid.pressure, all);
  resize(fluid.fit, all);
  resize(fluid.gradients, all);
  resize_used(fluid.source, all);
  resize_used(fluid.stress, all);
  resize_used(fluid.slope_source, all);
  resize_used(fluid.point_source, Particles<Dim>::kPoints * all);
  if (fluid.has_several_liquids()) {
    fluid.own.resize(all);
    for (const Image& image : image_) fluid.liquid.push_back(fluid.liquid[image.of]);
  }
  refresh_nodes(fluid);
}

template <int Dim>
void Halo<Dim>::refresh_nodes(Particles<Dim>& fluid) const {
  for (std::size_t k = 0; k < image_.size(); ++k)
    fluid.node[fluid.size() + k] = image_[k].node(fluid.node[image_[k].of]);
}

template <int Dim>
void Halo<Dim>::refresh_fits(Particles<Dim>& fluid) const {
  for (std::size_t k = 0; k < image_.size(); ++k) {
    const Image& image = image_[k];
    Fit<Dim>& fit = fluid.fit[fluid.size() + k];
    fit = fluid.fit[image.of];
    fit.g = image.vector(fit.g);
    fit.G = image.tensor(fit.G);
  }
}

template <int Dim>
void Halo<Dim>::refresh_sources(Particles<Dim>& fluid, const Parallel& parallel) const {
  parallel.for_each(image_.size(), [&](std::size_t k) {
    const Image& image = image_[k];
    const std::size_t to = fluid.size() + k;
    fluid.node[to].rho = fluid.node[image.of].rho;
    fluid.pressure[to] = fluid.pressure[image.of];
    fluid.fit[to] = fluid.fit[image.of];
    fluid.fit[to].g = image.vector(fluid.fit[image.of].g);
    fluid.fit[to].G = image.tensor(fluid.fit[image.of].G);
    if (!fluid.source.empty()) {
      const Source<Dim>& source = fluid.source[image.of];
      fluid.source[to] = {image.vector(source.s), image.tensor(source.S)};
    }
    const FlowGradients<Dim>& flow = fluid.gradients[image.of];
    fluid.gradients[to] = {image.vector(flow.half_grad_rho), image.tensor(flow.half_strain), flow.V_sigma};
    if (!fluid.stress.empty()) fluid.stress[to] = image.tensor(fluid.stress[image.of]);
    if (fluid.has_several_liquids()) {
      const OwnLiquid<Dim>& own = fluid.own[image.of];
      fluid.own[to].s = image.vector(own.s);
      fluid.own[to].S = image.tensor(own.S);
    }
    if (!fluid.slope_source.empty()) {
      const SlopeSource<Dim>& slope = fluid.slope_source[image.of];
      fluid.slope_source[to] = {image.tensor(slope.sigma_V), slope.a, image.vector(slope.b)};
    }
    if (fluid.point_source.empty()) return;
    constexpr std::size_t kPoints = Particles<Dim>::kPoints;
    for (std::size_t s = 0; s < kPoints; ++s)
      fluid.point_source[kPoints * to + s] = fluid.point_source[kPoints * image_[k].of + s];
  });
}

template class Halo<2>;
template class Halo<3>;

}  // namespace sluice::fluid
