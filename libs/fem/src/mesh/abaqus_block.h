#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// A keyword with its parameters and all of its data.
struct AbaqusBlock {
  struct Line {
    FileLocation location;
    std::vector<std::string> parts;
  };
  std::string name;
  FileLocation location;
  std::map<std::string, std::string> parameters;  ///< by name in upper case, without blanks
  std::vector<Line> lines;

  [[nodiscard]] std::string value(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
};

/// A name as it was first written.
using Spelling = std::function<std::string(const std::string&)>;

/// True if a keyword ties nodes: *EQUATION, *TIE, *RIGID BODY, *MPC.
[[nodiscard]] bool ties_nodes(std::string_view keyword);

/// Adds the ties of a keyword to `raw`. @throws InputError with the line that cannot be interpreted
void add_abaqus_ties(RawMesh& raw, const AbaqusBlock& block, const Spelling& spelled);

/// Coordinate system of *NODE, by *SYSTEM and the parameter SYSTEM.
class AbaqusSystem {
 public:
  /// *SYSTEM: an origin, a point on the x-axis, and in a second line one in the x-y plane; no data: the basic axes.
  void set(const RawMesh& raw, const AbaqusBlock& block);

  /// @param kind  "", "R", "C" (radius, angle, z) or "S" (radius, angle from x towards y, angle from that plane), in
  /// degrees
  [[nodiscard]] Vector3 in_basic(char kind, const Vector3& q) const;

 private:
  Vector3 origin_ = Vector3::Zero();
  Matrix3 axes_ = Matrix3::Identity();
};

/// A node's number, also behind the name of its instance (Part-1-1.12); false where it is none.
[[nodiscard]] bool parse_label(std::string_view text, long& label);

}  // namespace hersey::fem
