#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/recording/reader.hpp"

namespace sluice::clients {

// A dataset in the file of views: an array of the particles of one frame.
struct FrameView {
  std::string name;     // of the field: position, velocity ...
  std::string dataset;  // /0/position
  std::vector<std::uint64_t> shape;
  Array::Type type = Array::UNKNOWN;
};

// RUN.xdmf.h5 beside RUN.h5: each frame's particles as datasets of their own, for programs that cannot read a
// row of a dataset. They are virtual: they hold no values but say where in RUN.h5 those are, by its name. And
// `vertex`, int32 [n], the numbers of the particles from 0.
class FrameViews {
 public:
  // Writes the file. Throws h5::Error.
  explicit FrameViews(const Reader& recording);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // The views of a frame with particles, those of its fields and the last that of vertex.
  [[nodiscard]] std::vector<FrameView> of(std::uint64_t frame) const;

 private:
  const Reader& recording_;
  std::filesystem::path path_;
};

}  // namespace sluice::clients
