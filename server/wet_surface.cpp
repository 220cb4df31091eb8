#include "server/wet_surface.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sluice::server {

namespace {

constexpr double kOutermost = 0.8;  // of a spacing: depth of the layer next to the surface, half a spacing

double largest_eigenvalue(const Eigen::Matrix<double, 6, 6>& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

// I^-1/2, without what is about axes that are not free; inertia that is not there counts as such.
Eigen::Matrix3d inverse_root(const Eigen::Matrix3d& inertia, const Eigen::Vector3d& free) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(free.asDiagonal() * inertia *
                                                              free.asDiagonal());
  const Eigen::Vector3d roots = solver.eigenvalues().unaryExpr(
      [&](double i) { return i > 1e-12 * inertia.trace() ? 1 / std::sqrt(i) : 0.0; });
  return solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

WetSurface::WetSurface(const fluid::Boundary& body, const Inertia& inertia, const Medium& medium)
    : dimension_(medium.dimension), spacing_(medium.spacing) {
  const Eigen::Vector3d light = inertia.free / std::sqrt(inertia.properties.mass);
  const Eigen::Matrix3d turning = inverse_root(inertia.properties.inertia, inertia.free_rotation);
  low_ = high_ = Eigen::Vector3d::Zero();
  for (std::size_t w = 0; w < body.position.size(); ++w) {
    const Eigen::Vector3d& way = body.to_surface[w];
    const double depth = way.norm();
    if (!(depth > 0) || depth > kOutermost * spacing_) continue;
    const Eigen::Vector3d normal = way / depth, at = body.position[w] + way;
    Twist direction;
    direction << light.cwiseProduct(normal), turning * at.cross(normal);
    // A particle's cell is twice as deep as its place in it.
    const double area = body.volume[w] / (2 * depth);
    patches_.push_back({at + spacing_ * normal, direction, medium.impedance * area});
    low_ = low_.cwiseMin(patches_.back().before);
    high_ = high_.cwiseMax(patches_.back().before);
  }
  low_.head(dimension_).array() -= 2 * spacing_;
  high_.head(dimension_).array() += 2 * spacing_;
  for (int a = 0; a < 3; ++a)
    cells_[a] = a < dimension_ ? static_cast<int>(std::ceil((high_[a] - low_[a]) / spacing_)) + 1 : 1;
  occupied_.resize(static_cast<std::size_t>(cells_.prod()));
}

double WetSurface::whole_rate() const {
  Matrix sum = Matrix::Zero();
  for (const Patch& patch : patches_) sum += patch.impedance * patch.direction * patch.direction.transpose();
  return largest_eigenvalue(sum);
}

double WetSurface::rate(const std::vector<double>& liquid, const fluid::Kinematics& body) {
  mark(liquid, body);
  Matrix sum = Matrix::Zero();
  for (const Patch& patch : patches_)
    if (is_wet(patch)) sum += patch.impedance * patch.direction * patch.direction.transpose();
  return largest_eigenvalue(sum);
}

void WetSurface::mark(const std::vector<double>& liquid, const fluid::Kinematics& body) {
  std::fill(occupied_.begin(), occupied_.end(), 0);
  const double reach = low_.cwiseAbs().cwiseMax(high_.cwiseAbs()).norm();
  const Eigen::Quaterniond to_body = body.orientation.conjugate();
  for (std::size_t i = 0; i + 2 < liquid.size(); i += 3) {
    const Eigen::Vector3d from_body = Eigen::Map<const Eigen::Vector3d>(&liquid[i]) - body.position;
    if (from_body.squaredNorm() > reach * reach) continue;
    const Eigen::Vector3d x = to_body * from_body;
    if ((x.array() >= low_.array()).all() && (x.array() <= high_.array()).all())
      occupied_[index(cell_of(x))] = 1;
  }
}

// Whether a cell at the place before it, or one beside that, holds liquid.
bool WetSurface::is_wet(const Patch& patch) const {
  const Eigen::Vector3i middle = cell_of(patch.before);
  const int deep = dimension_ == 3 ? 1 : 0;
  for (int c = -deep; c <= deep; ++c)
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a)
        if (occupied_[index(middle + Eigen::Vector3i(a, b, c))] != 0) return true;
  return false;
}

Eigen::Vector3i WetSurface::cell_of(const Eigen::Vector3d& x) const {
  return ((x - low_) / spacing_).array().floor().cast<int>();
}

std::size_t WetSurface::index(const Eigen::Vector3i& cell) const {
  return static_cast<std::size_t>((cell.z() * cells_.y() + cell.y()) * cells_.x() + cell.x());
}

}  // namespace sluice::server
