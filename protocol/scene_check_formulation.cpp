#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

// Names of the values of an enumeration but the unspecified one, e.g. "A, B or C".
std::string names(const google::protobuf::EnumDescriptor& values) {
  std::string list;
  for (int k = 1; k < values.value_count(); ++k)
    list += (k == 1 ? "" : k + 1 == values.value_count() ? " or " : ", ") + values.value(k)->name();
  return list;
}

// Every enumeration of the message has a value that exists.
void check_choices(const Formulation& formulation, FieldCheck& check) {
  const google::protobuf::Descriptor& message = *formulation.GetDescriptor();
  for (int k = 0; k < message.field_count(); ++k) {
    const google::protobuf::FieldDescriptor& field = *message.field(k);
    if (field.enum_type() == nullptr) continue;
    const int number = formulation.GetReflection()->GetEnumValue(formulation, &field);
    if (field.enum_type()->FindValueByNumber(number) == nullptr)
      check.report("formulation." + field.name(),
                   fmt::format("{} is none; give {}", number, names(*field.enum_type())));
  }
}

void check_ranges(const Formulation& f, FieldCheck& check) {
  const auto within = [&check](bool given, double value, double least, double most, const char* field) {
    if (given) check.within(value, least, most, std::string("formulation.") + field);
  };
  within(f.has_smoothing(), f.smoothing(), 1, 4, "smoothing");
  within(f.has_density_diffusion(), f.density_diffusion(), 0, 1, "density_diffusion");
  within(f.has_artificial_viscosity(), f.artificial_viscosity(), 0, 10, "artificial_viscosity");
  within(f.has_moment_floor(), f.moment_floor(), 0.01, 1, "moment_floor");
  within(f.has_shifting(), f.shifting(), 0, 20, "shifting");
  within(f.has_spreading(), f.spreading(), 0, 0.1, "spreading");
  within(f.has_courant(), f.courant(), 0.001, 1, "courant");
  within(f.has_isobaric_scale(), f.isobaric_scale(), 0.001, 1, "isobaric_scale");
  within(f.has_multistep_beta1(), f.multistep_beta1(), 0, 2, "multistep_beta1");
  within(f.has_multistep_beta2(), f.multistep_beta2(), 0, 2, "multistep_beta2");
  within(f.has_interpolated_motion(), f.interpolated_motion(), 0, 1, "interpolated_motion");
  if (f.has_boundary_pressure())
    check.positive(f.boundary_pressure(), "formulation.boundary_pressure", "Pa",
                   "leave it out for the default");
}

bool is_mls(const Formulation& f) {
  return f.approximation() == APPROXIMATION_UNSPECIFIED || f.approximation() == MLS;
}

bool has_sum_one(const Formulation& f) {
  return f.approximation() != SPH && f.approximation() != CORRECTED_SPH;
}

// Choices that need another one.
void check_combinations(const Scene& scene, FieldCheck& check) {
  const Formulation& f = scene.formulation();
  const auto needs = [&check](bool chosen, bool met, const char* field, const char* reason) {
    if (chosen && !met) check.report(std::string("formulation.") + field, reason);
  };
  const bool wendland = f.kernel() == KERNEL_UNSPECIFIED || f.kernel() == WENDLAND;
  needs(!is_mls(f), wendland, "approximation",
        "other ones than MLS are built with the kernel WENDLAND only; leave kernel out");
  needs(f.weights() == KERNEL_ALONE, has_sum_one(f), "weights",
        "KERNEL_ALONE belongs to the fit of MLS, MLS_FULL_DERIVATIVE or SHEPARD; SPH has no fit");
  needs(f.tension_control(), is_mls(f), "tension_control",
        "takes the pressure relative to the particle's own in the gradients of MLS; leave approximation out");
  const bool nodal = f.quadrature() == QUADRATURE_UNSPECIFIED || f.quadrature() == NODAL;
  needs(f.spreading() > 0, is_mls(f) && nodal, "spreading",
        "measures crowding with the fit of MLS at particles; leave approximation and quadrature out");
  const bool weightless =
      !scene.gravity().empty() &&
      std::all_of(scene.gravity().begin(), scene.gravity().end(), [](double g) { return g == 0; });
  needs(f.spreading() > 0, !weightless, "spreading", "acts on crowds that gravity pulls down; leave it out");
  needs(f.internal_force() == SYMMETRIZED, is_mls(f), "internal_force",
        "SYMMETRIZED is built for MLS, to compare with; SPH is symmetrized as it is");
  needs(f.internal_force() == ISOBARIC, f.approximation() == SPH, "internal_force",
        "ISOBARIC is a sum over kernel gradients; set approximation to SPH");
  const bool galerkin = f.internal_force() == INTERNAL_FORCE_UNSPECIFIED || f.internal_force() == GALERKIN;
  needs(!nodal, is_mls(f) && wendland && galerkin, "quadrature",
        "other ones than NODAL are built for MLS with the kernel WENDLAND and the internal force GALERKIN; "
        "leave approximation, kernel and internal_force out");
  needs(!nodal, !f.tension_control(), "quadrature",
        "other ones than NODAL have their pressures off the particles, which tension_control does not know; "
        "leave one out");
  needs(f.quadrature() == BACKGROUND_CELLS, f.weights() != KERNEL_ALONE && f.mass() != LUMPED, "quadrature",
        "BACKGROUND_CELLS takes its weights from the particles' volumes and is built for their own masses; "
        "leave weights and mass out");
  needs(f.has_isobaric_scale(), f.internal_force() == ISOBARIC, "isobaric_scale",
        "belongs to internal_force ISOBARIC; set that or leave this out");
  const bool unweighted = f.weights() == WEIGHTS_UNSPECIFIED || f.weights() == KERNEL_AND_VOLUME;
  if (scene.liquid().surface_tension() > 0 &&
      !(is_mls(f) && galerkin && unweighted && nodal && f.mass() != LUMPED))
    check.report("liquid.surface_tension",
                 "is a stress in the Galerkin force of MLS at particles of their own mass; leave "
                 "approximation, internal_force, weights, quadrature and mass out");
  needs(f.viscous_force() == DAMPED, scene.liquid().viscosity() > 0, "viscous_force",
        "DAMPED without viscosity does nothing; set liquid.viscosity");
  needs(f.viscous_force() == DAMPED, wendland, "viscous_force",
        "DAMPED needs the Laplacian of the kernel, which only WENDLAND has; leave kernel out");
  needs(f.has_multistep_beta1() || f.has_multistep_beta2(), f.integrator() == MULTISTEP,
        f.has_multistep_beta1() ? "multistep_beta1" : "multistep_beta2",
        "belongs to integrator MULTISTEP; set that or leave this out");
  needs(f.mass() == LUMPED, has_sum_one(f), "mass",
        "LUMPED needs shape functions whose sum is one, CF (57); set approximation to MLS, "
        "MLS_FULL_DERIVATIVE or SHEPARD");
  needs(f.interpolated_motion() > 0, has_sum_one(f), "interpolated_motion",
        "needs shape functions whose sum is one, else a uniform velocity is not kept; set approximation to "
        "MLS, MLS_FULL_DERIVATIVE or SHEPARD");
  needs(f.initial_parameters(), f.interpolated_motion() > 0, "initial_parameters",
        "makes sense where particles move with the interpolated velocity; set interpolated_motion");
  const bool forces = f.boundary() == FORCES;
  needs(f.has_boundary_pressure(), forces, "boundary_pressure",
        "belongs to boundary FORCES; set that or leave this out");
  needs(f.force_on_receding(), forces, "force_on_receding",
        "belongs to boundary FORCES; set that or leave this out");
}

}  // namespace

void check_formulation(const Scene& scene, FieldCheck& check) {
  check_choices(scene.formulation(), check);
  check_ranges(scene.formulation(), check);
  check_combinations(scene, check);
  if (scene.formulation().boundary() == FORCES) check_boundary_forces(scene, check);
}

}  // namespace sluice::protocol
