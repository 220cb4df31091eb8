#pragma once

namespace sluice::clients::h5 {

// How the rows of a recording are stored.
enum class Storage { kPlain, kCompressed };

}  // namespace sluice::clients::h5
