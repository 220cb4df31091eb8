#pragma once

#include <vector>

#include "messages.pb.h"

namespace sluice::clients {

// The scene with the bodies that this process moves and their joints alone: others it neither sees nor
// touches. They are those that the server says, of a server that knows no owners all.
Scene own_part(const Welcome& welcome);

// Of these bodies, how stable the explicit scheme is with them (BodyStability.indicator); none where none is
// free.
std::vector<double> own_indicators(const Welcome& welcome);

}  // namespace sluice::clients
