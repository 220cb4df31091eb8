#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace sluice::fluid {

// What a state is made of, for StateWriter and StateReader, which visit the same parts in the same order:
//   a class with state(), which gives a tuple of references to what changes in a run;
//   a std::vector of any of these;
//   a plain value: numbers, fixed-size vectors and matrices, structures of them.
// The bytes are those in memory: they fit the program that wrote them, on its processor, and no other.
template <typename T>
concept HasState = requires(T& value) {
  value.state();
};

template <typename T>
concept Plain = !HasState<T> && std::is_trivially_destructible_v<T> && std::is_standard_layout_v<T> &&
                !std::is_pointer_v<T>;

class StateWriter {
 public:
  // Appends to `bytes`.
  explicit StateWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <HasState T>
  void visit(T& value) {
    visit(value.state());
  }
  template <typename... Parts>
  void visit(std::tuple<Parts&...> parts) {
    std::apply([this](auto&... part) { (visit(part), ...); }, parts);
  }
  template <typename T>
  void visit(const std::vector<T>& values) {
    static_assert(Plain<T>);
    visit(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  template <HasState T>
  void visit(std::vector<T>& values) {
    visit(static_cast<std::uint64_t>(values.size()));
    for (T& value : values) visit(value);
  }
  template <Plain T>
  void visit(const T& value) {
    append(&value, sizeof(T));
  }

 private:
  void append(const void* data, std::size_t count) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), from, from + count);
  }

  std::vector<std::byte>& bytes_;
};

class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  // All throw std::invalid_argument when the bytes end too early.
  template <HasState T>
  void visit(T& value) {
    visit(value.state());
  }
  template <typename... Parts>
  void visit(std::tuple<Parts&...> parts) {
    std::apply([this](auto&... part) { (visit(part), ...); }, parts);
  }
  template <typename T>
  void visit(std::vector<T>& values) {
    static_assert(Plain<T> || HasState<T>);
    const std::uint64_t count = read_count(HasState<T> ? 1 : sizeof(T));
    if constexpr (std::default_initializable<T>)
      values.resize(count);
    else if (values.size() != count)
      throw std::invalid_argument("state: " + std::to_string(count) + " entries where there are " +
                                  std::to_string(values.size()));
    if constexpr (HasState<T>)
      for (T& value : values) visit(value);
    else
      take(values.data(), count * sizeof(T));
  }
  template <Plain T>
  void visit(T& value) {
    take(&value, sizeof(T));
  }

  // Throws std::invalid_argument when bytes are left over.
  void finish() const {
    if (!bytes_.empty())
      throw std::invalid_argument("state: " + std::to_string(bytes_.size()) + " bytes too many");
  }

 private:
  // Of a vector whose entries take at least `size` bytes each.
  std::uint64_t read_count(std::size_t size) {
    std::uint64_t count = 0;
    visit(count);
    if (count > bytes_.size() / size) fail();
    return count;
  }

  void take(void* data, std::size_t count) {
    if (count > bytes_.size()) fail();
    if (count > 0) std::memcpy(data, bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
  }

  [[noreturn]] static void fail() { throw std::invalid_argument("state: the bytes end too early"); }

  std::span<const std::byte> bytes_;
};

}  // namespace sluice::fluid
