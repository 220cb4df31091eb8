#include "server/kinematics_rows.hpp"

#include <cassert>

namespace sluice::server {

namespace {

Eigen::Vector3d vector_at(std::span<const double> row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

void append(std::vector<double>& rows, const Eigen::Vector3d& v) {
  rows.insert(rows.end(), {v.x(), v.y(), v.z()});
}

}  // namespace

fluid::Kinematics read_kinematics(std::span<const double> row) {
  assert(row.size() == kKinematicsRow);
  return {.position = vector_at(row, 0),
          .orientation = Eigen::Quaterniond(row[3], row[4], row[5], row[6]),
          .velocity = vector_at(row, 7),
          .angular_velocity = vector_at(row, 10),
          .acceleration = vector_at(row, 13),
          .angular_acceleration = vector_at(row, 16)};
}

void append(std::vector<double>& rows, const fluid::Kinematics& k) {
  append(rows, k.position);
  const Eigen::Quaterniond& q = k.orientation;
  rows.insert(rows.end(), {q.w(), q.x(), q.y(), q.z()});
  append(rows, k.velocity);
  append(rows, k.angular_velocity);
  append(rows, k.acceleration);
  append(rows, k.angular_acceleration);
}

void append(std::vector<double>& rows, const fluid::Wrench& wrench) {
  append(rows, wrench.force);
  append(rows, wrench.moment);
}

}  // namespace sluice::server
