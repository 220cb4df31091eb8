#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "clients/recording/output_file.hpp"
#include "clients/recording/storage.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// Writes a recording (README.md has the layout). What flush() has returned for stays readable however the
// process ends; what comes after may be lost.
class Writer {
 public:
  // Creates the file with all its datasets from the Welcome of a recorder. Throws ProtocolError when the
  // Welcome is incomplete and InputError when the file cannot be written.
  // A compressed file is for what is copied from another: what is not finished is lost.
  Writer(OutputFile file, const protocol::Message& welcome, h5::Storage storage = h5::Storage::kPlain);
  ~Writer();
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) = delete;

  // Appends a Frame or an ExchangeLog. Throws ProtocolError, having written nothing, when the message is not
  // the next of its kind or its arrays are not what the Welcome announced; std::runtime_error when writing
  // fails.
  void write(const protocol::Message& message);
  // Hands everything written so far to the operating system.
  void flush();
  // Records how the run ended and closes the file.
  void finish(const std::string& reason, const std::string& detail, double wall_seconds = 0);

 private:
  class File;
  template <typename Action>
  void guarded(Action action);
  std::unique_ptr<File> file_;
};

}  // namespace sluice::clients
