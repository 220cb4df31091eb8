#pragma once

#include <string>
#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::protocol {

using Vector = google::protobuf::RepeatedField<double>;

// Collects what is wrong with the fields of a scene. Values that are not finite are reported once, by the
// sweep over all fields; the range checks pass them over.
class FieldCheck {
 public:
  explicit FieldCheck(int dimension) : dimension_(dimension) {}

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

  void report(std::string field, std::string text);
  // `unit` stands after the value; `advice` says what to give instead.
  void positive(double value, const std::string& field, const std::string& unit, const std::string& advice);
  void not_negative(double value, const std::string& field, const std::string& unit);
  void within(double value, double least, double most, const std::string& field);
  // As many entries as the scene has dimensions; false otherwise.
  bool vector(const Vector& vector, const std::string& field, const std::string& what);
  void optional_vector(const Vector& vector, const std::string& field, const std::string& what);
  // Nothing, one entry in 2D, three in 3D.
  void optional_rotation(const Vector& vector, const std::string& field, const std::string& what);
  // At most `most` entries of a list; false otherwise.
  bool count(int entries, int most, const std::string& field);

 private:
  bool entries(const Vector& vector, int needed, const std::string& field, const std::string& what);

  int dimension_;
  std::vector<Problem> problems_;
};

// The parts of check_fields.
void check_numbers(const google::protobuf::Message& message, const std::string& prefix, FieldCheck& check);
void check_polygon(const Polygon& polygon, const std::string& field, FieldCheck& check);
void check_output(const Scene& scene, FieldCheck& check);
void check_formulation(const Scene& scene, FieldCheck& check);
// What boundary FORCES do not go with.
void check_boundary_forces(const Scene& scene, FieldCheck& check);
void check_coupling(const Scene& scene, FieldCheck& check);
void check_domain(const Scene& scene, FieldCheck& check);
// Whether it is one, of the scene's dimension.
bool check_side(Side side, const std::string& field, FieldCheck& check);
void check_other_liquids(const Scene& scene, FieldCheck& check);
void check_openings(const Scene& scene, FieldCheck& check);
void check_fluid(const FluidRegion& region, const std::string& field, FieldCheck& check);
void check_bodies(const Scene& scene, FieldCheck& check);
// Those that are locked, and free beside a prescribed motion.
void check_axes(const Body& body, const std::string& field, FieldCheck& check);
void check_body_shape(const Body& body, const std::string& field, FieldCheck& check);
// A rotation: by angle in two dimensions, by a quaternion in three.
void check_turn(double angle, const Vector& orientation, const std::string& field, FieldCheck& check);
void check_probes(const Scene& scene, FieldCheck& check);
void check_joints(const Scene& scene, FieldCheck& check);
void check_contact(const Contact& contact, const std::string& field, FieldCheck& check);
void check_motion(const Motion& motion, const std::string& field, FieldCheck& check);
void check_counts(const Scene& scene, FieldCheck& check);

}  // namespace sluice::protocol
