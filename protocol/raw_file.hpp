#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace sluice::protocol {

// An open file whose reads and writes are whole. All throw std::system_error that names the file.
class RawFile {
 public:
  enum Use { kRead, kCreate };  // the second empties a file that exists

  RawFile(const std::filesystem::path& path, Use use);
  ~RawFile();
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;

  void write(const void* data, std::size_t count);
  // False when the file ends before.
  bool read(void* data, std::size_t count);
  void rewind();
  // Throws InputError unless it is a regular file.
  [[nodiscard]] std::uint64_t size() const;
  // Returns when all is on the disk; of a directory, the names in it.
  void synchronise();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace sluice::protocol
