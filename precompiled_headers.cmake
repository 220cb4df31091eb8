# Headers of libraries that most sources need, parsed once for a target, or for a family of targets with the same
# options, instead of once for every source. Sources include what they use all the same:
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without, and shows what one forgot.
set(standard_headers
  <algorithm> <array> <chrono> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map> <memory>
  <numbers> <numeric> <optional> <random> <span> <sstream> <stdexcept> <string> <tuple> <vector>)
set(math_headers ${standard_headers} <Eigen/Dense>)
set(message_headers ${math_headers} <fmt/format.h> <google/protobuf/text_format.h> <messages.pb.h> <scene.pb.h>)
set(test_headers ${message_headers} <gmock/gmock.h> <gtest/gtest.h>)

# Declares a family, message or test; the libraries that its headers are of follow. What these define, every target
# of the family must.
function(sluice_header_family family)
  set(empty ${CMAKE_BINARY_DIR}/${family}_headers.cpp)
  file(TOUCH ${empty})
  add_library(sluice_${family}_headers OBJECT ${empty})
  target_link_libraries(sluice_${family}_headers PRIVATE sluice_options ${ARGN})
  target_precompile_headers(sluice_${family}_headers PRIVATE ${${family}_headers})
endfunction()

function(sluice_precompile target family)
  target_precompile_headers(${target} REUSE_FROM sluice_${family}_headers)
endfunction()
