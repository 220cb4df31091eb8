#include "clients/recording/energy.hpp"

#include <algorithm>
#include <stdexcept>

namespace sluice::clients {
namespace {

const google::protobuf::FieldDescriptor& find(const std::string& field) {
  const auto* found = Energy::descriptor()->FindFieldByName(field);
  if (found == nullptr) throw std::logic_error("Energy has no field " + field);
  return *found;
}

}  // namespace

std::vector<double> energy_values(const Energy& energy, const std::string& field, std::size_t count) {
  const auto& descriptor = find(field);
  const auto& reflection = *Energy::GetReflection();
  if (!descriptor.is_repeated()) return {reflection.GetDouble(energy, &descriptor)};
  std::vector<double> values(count, 0.0);
  const auto given = static_cast<std::size_t>(reflection.FieldSize(energy, &descriptor));
  for (std::size_t i = 0; i < std::min(count, given); ++i)
    values[i] = reflection.GetRepeatedDouble(energy, &descriptor, static_cast<int>(i));
  return values;
}

void set_energy_values(Energy& energy, const std::string& field, const std::vector<double>& values) {
  const auto& descriptor = find(field);
  const auto& reflection = *Energy::GetReflection();
  if (!descriptor.is_repeated()) {
    reflection.SetDouble(&energy, &descriptor, values.front());
    return;
  }
  for (const double value : values) reflection.AddDouble(&energy, &descriptor, value);
}

}  // namespace sluice::clients
