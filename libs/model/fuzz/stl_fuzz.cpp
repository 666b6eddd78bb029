// libFuzzer target: whatever the bytes, the reader of STL files returns a surface of finite triangles or a fault.
// seeds: examples/cam_follower/cam.stl libs/model/fuzz/seeds/binary.stl
// longest: 4096
#include <cstdint>
#include <cstdlib>
#include <string>

#include "../src/interpret/files/stl_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const hersey::model::StlResult result = hersey::model::parse_stl({data, data + size});
  if (!result.fault.empty()) return 0;
  if (result.mesh.triangles.empty() || result.facets != result.mesh.triangles.size() + result.flat) std::abort();
  for (const hersey::Vector3& corner : result.mesh.corners)
    if (!corner.allFinite()) std::abort();
  for (const auto& triangle : result.mesh.triangles)
    for (const int corner : triangle)
      if (corner < 0 || corner >= static_cast<int>(result.mesh.corners.size())) std::abort();
  return 0;
}
