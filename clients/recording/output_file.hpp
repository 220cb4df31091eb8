#pragma once

#include <filesystem>

namespace sluice::clients {

// The file that a recording is going to be written to. Construction makes sure that it can be written and
// takes a lock, which other programs see; an existing file keeps its content until a Writer replaces it.
class OutputFile {
 public:
  // Throws InputError when the file exists and `force` is not set, when another process writes to it, when it
  // is no regular file, or when it cannot be created.
  OutputFile(std::filesystem::path path, bool force);
  // Removes the file again if this object created it and nobody called keep().
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void keep() { created_ = false; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool created_ = false;
};

// Whether a process holds the file as an OutputFile.
bool is_being_written(const std::filesystem::path& path);

}  // namespace sluice::clients
