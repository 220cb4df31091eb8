#include "protocol/field_check.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sluice::protocol {
namespace {

namespace pb = google::protobuf;

constexpr double kLargest = 1e12;  // no quantity of a scene in SI units comes near

}  // namespace

void FieldCheck::report(std::string field, std::string text) {
  problems_.push_back({{}, std::move(field), std::move(text)});
}

void FieldCheck::positive(double value, const std::string& field, const std::string& unit,
                          const std::string& advice) {
  if (!std::isfinite(value) || value > 0) return;
  report(field, fmt::format("{} {} is not positive; {}", value, unit, advice));
}

void FieldCheck::not_negative(double value, const std::string& field, const std::string& unit) {
  if (value < 0) report(field, fmt::format("{} {} is negative; give 0 or more", value, unit));
}

void FieldCheck::within(double value, double least, double most, const std::string& field) {
  if (value < least || value > most)
    report(field, fmt::format("{} is outside {} to {}; leave it out for the default", value, least, most));
}

bool FieldCheck::entries(const Vector& vector, int needed, const std::string& field,
                         const std::string& what) {
  if (vector.size() == needed) return true;
  if (vector.empty())
    report(field, fmt::format("is missing; give {} with {} entries", what, needed));
  else
    report(field, fmt::format("{} entries, but {} needs {} in {} dimensions", vector.size(), what, needed,
                              dimension_));
  return false;
}

bool FieldCheck::vector(const Vector& vector, const std::string& field, const std::string& what) {
  return entries(vector, dimension_, field, what);
}

void FieldCheck::optional_vector(const Vector& vector, const std::string& field, const std::string& what) {
  if (!vector.empty()) entries(vector, dimension_, field, what);
}

void FieldCheck::optional_rotation(const Vector& vector, const std::string& field, const std::string& what) {
  if (!vector.empty()) entries(vector, dimension_ == 2 ? 1 : 3, field, what);
}

bool FieldCheck::count(int entries, int most, const std::string& field) {
  if (entries <= most) return true;
  report(field, fmt::format("{} entries, at most {} are supported", entries, most));
  return false;
}

void check_numbers(const pb::Message& message, const std::string& prefix, FieldCheck& check) {
  const auto* reflection = message.GetReflection();
  std::vector<const pb::FieldDescriptor*> fields;
  reflection->ListFields(message, &fields);
  const auto check_number = [&](double value, const std::string& field) {
    if (!std::isfinite(value))
      check.report(field, fmt::format("{} is not a finite number", value));
    else if (std::abs(value) > kLargest)
      check.report(field, fmt::format("{} is beyond {}; all quantities are in SI units", value, kLargest));
  };
  for (const auto* field : fields) {
    const bool number = field->cpp_type() == pb::FieldDescriptor::CPPTYPE_DOUBLE;
    const bool nested = field->cpp_type() == pb::FieldDescriptor::CPPTYPE_MESSAGE;
    const std::string path = prefix + field->name();
    if (!field->is_repeated()) {
      if (number) check_number(reflection->GetDouble(message, field), path);
      if (nested) check_numbers(reflection->GetMessage(message, field), path + ".", check);
      continue;
    }
    for (int i = 0; (number || nested) && i < reflection->FieldSize(message, field); ++i) {
      const std::string entry = fmt::format("{}[{}]", path, i);
      if (number) check_number(reflection->GetRepeatedDouble(message, field, i), entry);
      if (nested) check_numbers(reflection->GetRepeatedMessage(message, field, i), entry + ".", check);
    }
  }
}

}  // namespace sluice::protocol
