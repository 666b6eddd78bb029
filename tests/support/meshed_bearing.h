#pragma once

#include <algorithm>
#include <string>

namespace hersey {

/// A body whose mesh is that of a RingFile, in a MeshedBearing.
struct MeshedBody {
  std::string mesh;    ///< file; empty: the body is rigid
  std::string keys;    ///< of `flexible` after its material, a line each
  std::string frames;  ///< a line each
};

/// Text of a model file with one bearing between a ring, which ground holds, and a shaft that is driven and loaded;
/// ring, shaft or both are meshes. Each member is what stands at its place in the file.
struct MeshedBearing {
  std::string title = "A ring around a journal";
  std::string ground = "";  ///< frames of it, a line each
  MeshedBody ring = {};     ///< rigid: ground is the shell
  MeshedBody shaft = {};
  std::string rigid_shaft = "{mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}";
  std::string foundation = "ring.hub", shell = "ring.hub", journal = "shaft";  ///< frames
  std::string guided_on = "ground";                                            ///< frame in whose plane the shaft moves
  std::string initial = "";                                                    ///< its coordinates at the start
  std::string load = "2 kN";  ///< towards -y, on a shaft that turns at 3000 rpm; empty: neither drive nor load
  std::string oil = "{viscosity: 15 mPa.s}";
  std::string diameter = "45 mm", width = "15.6 mm", clearance = "34 um", edge_pressure = "1 bar";
  std::string film = "";  ///< other keys of the bearing, a line each
  std::string simulation = "{duration: 1 ms, step: 0.1 ms}";
  std::string sections = "";  ///< after the simulation, a line each

  [[nodiscard]] std::string text() const {
    std::string bodies = ground.empty() ? "" : "  ground:\n    frames:\n" + lines(6, ground);
    if (!ring.mesh.empty()) bodies += body("ring", ring);
    bodies += shaft.mesh.empty() ? "  shaft: " + rigid_shaft + "\n" : body("shaft", shaft);
    return "hersey: 1\ntitle: " + title + "\nbodies:\n" + bodies + joints() + drive() + "lubricants:\n  oil: " + oil +
           "\n" + bearing() + "simulation: " + simulation + "\n" + lines(0, sections);
  }

 private:
  /// Each line of `block`, indented.
  static std::string lines(int indent, const std::string& block) {
    std::string text;
    for (std::size_t from = 0; from < block.size();) {
      const std::size_t end = std::min(block.find('\n', from), block.size());
      text += std::string(static_cast<std::size_t>(indent), ' ') + block.substr(from, end - from) + "\n";
      from = end + 1;
    }
    return text;
  }

  static std::string body(const std::string& name, const MeshedBody& body) {
    return "  " + name + ":\n    flexible:\n      mesh: " + body.mesh +
           "\n      length_unit: 1 mm\n"
           "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n" +
           lines(6, body.keys) + "    frames:\n" + lines(6, body.frames);
  }

  [[nodiscard]] std::string joints() const {
    return "joints:\n" + (ring.mesh.empty() ? "" : "  clamp: {type: fixed, between: [ground, " + foundation + "]}\n") +
           "  slide: {type: planar, between: [" + guided_on + ", " + journal + "]" +
           (initial.empty() ? "" : ", initial: " + initial) + "}\n";
  }

  [[nodiscard]] std::string drive() const {
    if (load.empty()) return "";
    return "drives:\n  motor: {joint: slide, coordinate: rotation, speed: 3000 rpm}\n"
           "forces:\n  push: {type: force, body: " +
           journal + ", components: [0 N, -" + load + ", 0 N]}\n";
  }

  [[nodiscard]] std::string bearing() const {
    return "bearings:\n  main:\n    shell: " + (ring.mesh.empty() ? "ground" : shell) + "\n    journal: " + journal +
           "\n    diameter: " + diameter + "\n    width: " + width + "\n    radial_clearance: " + clearance +
           "\n    lubricant: oil\n" + (edge_pressure.empty() ? "" : "    edge_pressure: " + edge_pressure + "\n") +
           lines(4, film);
  }
};

/// Frames of a ring fixed at its outside, and of a hollow shaft guided by its bore.
inline constexpr const char* kHub = "hub: {nodes: outside, connection: average, origin: 0 0 0 mm}";
inline constexpr const char* kPin = "pin: {nodes: bore, connection: average, origin: 0 0 0 mm}";

}  // namespace hersey
