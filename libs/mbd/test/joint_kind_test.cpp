// The table of joints against itself: the motions that a chain allows are those that the rows of the same type do not
// constrain.
#include "tree/joint_kind.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hersey/mbd/joint.h"
#include "tree/constraint_row.h"

namespace hersey::mbd {
namespace joint_kind_test {

constexpr double kRounding = 1e-14;  // of a few products of rotations and lengths of 1

const Vector3 kAxis = Vector3(0.3, -0.5, 0.8).normalized();

std::vector<double> values(JointType type) {
  std::vector<double> q;
  for (int i = 0; i < degrees_of_freedom(type); ++i) q.push_back(0.4 - 0.3 * i);
  return q;
}

double largest_value(JointType type, const std::vector<double>& q) {
  double largest = 0;
  for (const ConstraintRow& row : constraint_rows(type, kAxis))
    largest = std::max(largest, std::abs(row.value(joint_pose(type, kAxis, q))));
  return largest;
}

// The axis of the smallest rotation is normal to z for every direction; for -z it is not unique.
TEST_CASE("JointAxes_AreTheSmallestRotationFromZ") {
  for (const Vector3& given : {kAxis, Vector3(0.3, -0.5, -0.8), Vector3(1e-9, 0, 1), Vector3(2e-9, -1e-9, -1),
                               Vector3(1e-4, 3e-4, -1), Vector3(0, 0, 2), Vector3(0, 0, -1)}) {
    CAPTURE(given.x());
    CAPTURE(given.z());
    const Matrix3 R = joint_axes(given);
    CHECK((R.transpose() * R - Matrix3::Identity()).norm() <= kRounding);
    CHECK(std::abs(R.determinant() - 1) <= kRounding);
    CHECK((R.col(2) - given.normalized()).norm() <= kRounding);
    CHECK(R(0, 1) == R(1, 0));
  }
}

TEST_CASE("JointsOfTheTable_ConstrainWhatTheirChainsLeave") {
  for (const JointKind& kind : joint_kinds()) {
    if (kind.rows.empty()) continue;
    CAPTURE(kind.name);
    CHECK(static_cast<int>(kind.rows.size()) + degrees_of_freedom(kind.type) == 6);
    CHECK(largest_value(kind.type, values(kind.type)) <= kRounding);
  }
}

TEST_CASE("RowsOfAJoint_ConstrainEveryMotionOfAnotherThatItHasNot") {
  // A joint whose chain moves otherwise opens the rows: those of a hinge by every freedom of a planar joint but one.
  const auto opened = [](int value) {
    std::vector<double> q(3, 0);
    q[value] = 0.3;
    double largest = 0;
    for (const ConstraintRow& row : constraint_rows(JointType::revolute, kAxis))
      largest = std::max(largest, std::abs(row.value(joint_pose(JointType::planar, kAxis, q))));
    return largest;
  };
  CHECK(opened(0) == doctest::Approx(0.3).epsilon(kRounding));
  CHECK(opened(1) == doctest::Approx(0.3).epsilon(kRounding));
  CHECK(opened(2) <= kRounding);
}

TEST_CASE("CoordinatesOfJoints_FollowFromTheirChains") {
  const auto free = coordinates_of(JointType::free);
  REQUIRE(free.size() == 2);
  CHECK(free[0].name == "position");
  CHECK(free[0].size == 3);
  CHECK(!free[0].rotational);
  CHECK(free[1].offset == 3);
  CHECK(free[1].size == 3);
  CHECK(free[1].orientation);
  CHECK(find_coordinate(JointType::universal, "rotation_2")->offset == 1);
  CHECK(joint_type_of("screw") == JointType::screw);
  CHECK(!joint_type_of("scew"));
  CHECK(rotates_about_one_axis(JointType::planar));
  CHECK(!rotates_about_one_axis(JointType::universal));
  CHECK(!rotates_about_one_axis(JointType::spherical));
}

}  // namespace joint_kind_test
}  // namespace hersey::mbd
