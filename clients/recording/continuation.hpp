#pragma once

#include <filesystem>

#include "clients/recording/writer.hpp"

namespace sluice::clients {

// Begins the recording of a run that goes on, from a recorder's Welcome of it: `output` gets what `recording`
// holds up to Welcome.done, whatever comes after that, and the writer goes on from there. The two may be one
// file, which is replaced when all that is kept has been copied. Throws InputError when the recording is not
// of that run, does not go as far, is damaged before or is being written.
Writer continue_recording(const std::filesystem::path& recording, const std::filesystem::path& output,
                          bool force, protocol::Message welcome);

}  // namespace sluice::clients
