#pragma once

#include <optional>
#include <vector>

#include "hersey/mbd/mechanism_spec.h"
#include "tree/tree.h"

namespace hersey::mbd {

/// Chooses, by their inertias, which of the bodies that move together carries the others (theory manual, section "Light
/// bodies carry nothing"). A joint that lets a body move as it likes, in space or in a plane, need not be in a path:
/// the body beyond it may have a pose of its own, from which the joint's coordinates are read off.
class Roots {
 public:
  /// @param tree  with joints in order of declaration; its initial configuration gives the distances of bodies
  Roots(const MechanismSpec& spec, const Tree& tree);

  /// True if any body of `spec` may be too light to carry others.
  [[nodiscard]] bool may_matter() const;

  /// True if joint `j` may be omitted from all paths.
  [[nodiscard]] bool may_leave(int j) const { return leavable_[static_cast<std::size_t>(j)]; }

  /// The body that carries all that comes with `first`, the first one beyond joint `j`; `first` unless that one is far
  /// too light. Without a joint the bodies are free.
  [[nodiscard]] int carrier(std::optional<int> j, int first) const;

  /// True if the moment of inertia of `body` is too small to carry the bodies that `first` brings along
  /// (mechanisms.28): coordinates counted from it would be the outcome of two fast motions (mechanisms.27).
  [[nodiscard]] bool is_too_light(int body, int first) const;

  /// True if all motions of joint `other` (none: a body free in space) are motions that joint `j` allows.
  [[nodiscard]] bool keeps_motions(std::optional<int> other, int j) const;

  /// Returns the centre of mass at the start, ground axes, of a body and of the bodies fixed to it; that of all bodies
  /// it brings along if it has no mass.
  [[nodiscard]] Vector3 centre(int body) const;

  /// True if joint `j` (none: no joint connects the body) allows `body` to move freely in space, with coordinates about
  /// another point than that centre.
  [[nodiscard]] bool rotates_off_centre(std::optional<int> j, int body) const;

  /// Pose of a body at the start, and its velocity at ground's origin and in its axes.
  [[nodiscard]] const Pose& pose(int body) const { return poses_[static_cast<std::size_t>(body)]; }
  [[nodiscard]] const Vector6& velocity(int body) const { return velocities_[static_cast<std::size_t>(body)]; }
  /// Axes t1, t2, axis of joint `j` at the start, in ground's.
  [[nodiscard]] Matrix3 axes(int j) const;

 private:
  struct Weight {
    double mass = 0;
    double inertia = 0;                ///< half the trace of the inertia about the centre [kg m^2]
    Vector3 centre = Vector3::Zero();  ///< at the start, ground axes [m]
    void add(const Weight& other);
    [[nodiscard]] double inertia_about(const Vector3& point) const;
  };

  [[nodiscard]] int body_of(FrameId frame) const { return spec_.frames[frame.index].body.index; }
  [[nodiscard]] int other_end(int j, int body) const;
  [[nodiscard]] int fixed_root(int body) const;
  void find_leavable_joints();
  void weigh();
  [[nodiscard]] std::vector<int> cluster(int first) const;
  [[nodiscard]] std::vector<int> candidates(std::optional<int> j, int first) const;
  [[nodiscard]] double share_of(const std::vector<int>& carried, int body) const;

  const MechanismSpec& spec_;
  double length_;  ///< size of the mechanism [m]
  std::vector<Pose> poses_;
  std::vector<Vector6> velocities_;
  std::vector<std::vector<int>> at_body_;  ///< joints of each body
  std::vector<bool> eligible_;             ///< bodies of groups whose paths may be chosen
  std::vector<bool> rigid_;                ///< bodies of groups without elastic ones
  std::vector<bool> leavable_;             ///< joints
  std::vector<int> fixed_to_;              ///< links of fixed joints, see fixed_root
  std::vector<Weight> own_;                ///< inertia of each body
  std::vector<Weight> whole_;              ///< inertia of all bodies fixed to each other, at their fixed_root
};

/// Returns the joints whose coordinates are read, driven, sprung or coupled and therefore have to be in the tree.
[[nodiscard]] std::vector<bool> joints_in_use(const MechanismSpec& spec);

}  // namespace hersey::mbd
