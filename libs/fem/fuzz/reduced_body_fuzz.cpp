// libFuzzer target: a reduced body whose file is damaged is refused or as it was; one whose numbers another program
// wrote wrong is refused or finite and complete. longest: 64
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "hersey/core/input_error.h"
#include "hersey/fem/reduced_body_file.h"

namespace {

using namespace hersey;
using namespace hersey::fem;

std::filesystem::path scratch() {
  const std::filesystem::path memory = "/dev/shm";
  const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  return folder / ("hersey_fuzz_" + std::to_string(::getpid()) + "_reduced.h5");
}

/// A tetrahedron with one frame, one vibration and everything a file may hold.
ReducedBody tetrahedron() {
  ReducedBody body;
  body.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  body.Phi = Eigen::MatrixXd::Constant(12, 7, 0.5);
  body.K = Eigen::MatrixXd::Zero(7, 7);
  body.K(6, 6) = 4;
  body.M = Eigen::MatrixXd::Identity(7, 7);
  body.m.resize(4, 4);
  body.m.setIdentity();
  body.frames = {{"left", {0, 0, 0}, {0, 1, 2}, Connection::average, {0.25, 0.25, 0.5}}};
  body.internal_omega = Eigen::VectorXd::Constant(1, 2);
  body.energy_missed = Eigen::VectorXd::Constant(1, 0.01);
  body.mesh.nodes = body.nodes;
  body.mesh.node_labels = {1, 2, 3, 4};
  body.mesh.elements = {{ElementType::tet4, 1, 0, 0}};
  body.mesh.connectivity = {0, 1, 2, 3};
  body.mesh.node_sets["base"] = {0, 1, 2};
  body.mesh.surfaces["base"] = {{0, 0}};
  body.materials = {{Eigen::Matrix<double, 6, 6>::Identity(), 1}};
  return body;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void check(const ReducedBody& body) {
  const auto size = body.Phi.cols();
  const bool complete = body.Phi.allFinite() && body.K.allFinite() && body.M.allFinite() && body.K.rows() == size &&
                        body.M.rows() == size && body.internal_omega.allFinite() && body.energy_missed.allFinite();
  if (!complete) std::abort();
  for (const InterfaceFrame& frame : body.frames) {
    if (!frame.origin.allFinite()) std::abort();
    for (const int node : frame.nodes)
      if (node < 0 || node >= static_cast<int>(body.nodes.size())) std::abort();
  }
  for (const Element& element : body.mesh.elements)
    for (int k = 0; k < node_count(element.type); ++k)
      if (body.mesh.nodes_of(element)[k] >= static_cast<int>(body.nodes.size())) std::abort();
}

/// Changes bytes by four bytes of input each: position and new byte; where the second is odd, the file is truncated
/// instead.
std::string damaged(std::string content, const std::uint8_t* data, std::size_t size) {
  const auto position = [&](std::size_t at) {
    return (data[at] | std::size_t{data[at + 1]} << 8 | std::size_t{data[at + 2]} << 16) % content.size();
  };
  if (size >= 5 && data[1] % 2 == 1) return content.substr(0, position(2));
  for (std::size_t k = 2; k + 4 <= size; k += 4) content[position(k)] = static_cast<char>(data[k + 3]);
  return content;
}

/// Numbers changed, ten bytes of the input each: which one, where in it, and its new value.
ReducedBody spoilt(ReducedBody body, const std::uint8_t* data, std::size_t size) {
  for (; size >= 10; data += 10, size -= 10) {
    double value = 0;
    std::memcpy(&value, data + 2, sizeof value);
    long long integer = 0;
    std::memcpy(&integer, data + 2, sizeof integer);
    const auto set = [&](double* values, Eigen::Index count) {
      if (count > 0) values[data[1] % count] = value;
    };
    const auto set_index = [&](std::vector<int>& indices) {
      if (!indices.empty()) indices[data[1] % indices.size()] = static_cast<int>(integer);
    };
    switch (data[0] % 18) {
      case 0:
        set(body.Phi.data(), body.Phi.size());
        break;
      case 1:
        set(body.K.data(), body.K.size());
        break;
      case 2:
        set(body.M.data(), body.M.size());
        break;
      case 3:
        set(body.m.valuePtr(), body.m.nonZeros());
        break;
      case 4:
        set(body.frames[0].origin.data(), 3);
        break;
      case 5:
        set(body.frames[0].weights.data(), static_cast<Eigen::Index>(body.frames[0].weights.size()));
        break;
      case 6:
        set(body.internal_omega.data(), body.internal_omega.size());
        break;
      case 7:
        set(body.energy_missed.data(), body.energy_missed.size());
        break;
      case 8:
        set(body.nodes[data[1] % 4].data(), 3);
        break;
      case 9:
        set(body.materials[0].D.data(), 36);
        break;
      case 10:
        body.materials[0].density = value;
        break;
      case 11:
        set_index(body.frames[0].nodes);
        break;
      case 12:
        set_index(body.mesh.connectivity);
        break;
      case 13:
        set_index(body.mesh.node_sets["base"]);
        break;
      case 14:
        body.mesh.surfaces["base"][0] = {static_cast<int>(integer), data[1]};
        break;
      case 15:
        body.mesh.elements[0].material = static_cast<int>(integer);
        break;
      case 16:
        body.mesh.elements[0].type = static_cast<ElementType>(data[1] % 7);
        break;
      default:
        body.frames[0].name.assign(data + 2, data + 10);
        break;
    }
  }
  return body;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path path = scratch();
  static const std::string real = [] {
    write_reduced_body(path, tetrahedron());
    check(read_reduced_body(path));
    return content_of(path);
  }();
  if (size == 0) return 0;
  if (data[0] % 2 == 0)
    std::ofstream(path, std::ios::binary) << damaged(real, data, size);
  else
    write_reduced_body(path, spoilt(tetrahedron(), data + 1, size - 1));
  try {
    check(read_reduced_body(path));
  } catch (const InputError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
