#include "hersey/core/archive.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace hersey {
namespace archive_test {

enum class Colour { red, green };

struct Thing {
  double x = 0;
  bool flag = false;
  int count = 0;
  Colour colour = Colour::red;
  std::string text;
  std::vector<double> list;
  std::vector<int> counts;
  Eigen::VectorXd v;
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  std::optional<double> maybe, never = 1.0;
  std::vector<Eigen::VectorXd> vectors;

  void persist(Archive& archive) {
    archive.io("x", x);
    archive.io("flag", flag);
    archive.io("count", count);
    archive.io("colour", colour);
    archive.io("text", text);
    archive.io("list", list);
    archive.io("counts", counts);
    archive.io("v", v);
    archive.io("M", M);
    archive.io("maybe", maybe);
    archive.io("never", never);
    archive.each("vectors", vectors, [](Archive& a, Eigen::VectorXd& item) { a.io("item", item); });
  }
};

Thing filled() {
  Thing thing{.x = 0.1,
              .flag = true,
              .count = -7,
              .colour = Colour::green,
              .text = "a b",
              .list = {1, 2},
              .counts = {3, -4},
              .v = Eigen::VectorXd::LinSpaced(5, 0, 1),
              .maybe = 3.5,
              .never = std::nullopt,
              .vectors = {Eigen::VectorXd::Ones(2), Eigen::VectorXd(0)}};
  thing.M(2, 1) = 4;
  return thing;
}

TEST_CASE("Archive_RestoresWhatItSaved") {
  Archive out;
  Thing saved = filled();
  {
    const Archive::Group group(out, "thing a/b");
    saved.persist(out);
  }
  Archive in(out.content());
  Thing thing;
  {
    const Archive::Group group(in, "thing a/b");
    thing.persist(in);
  }
  CHECK(in.unread().empty());
  CHECK(thing.x == 0.1);
  CHECK(thing.flag);
  CHECK(thing.count == -7);
  CHECK(thing.colour == Colour::green);
  CHECK(thing.text == "a b");
  CHECK(thing.list == saved.list);
  CHECK(thing.counts == saved.counts);
  CHECK(thing.v == saved.v);
  CHECK(thing.M == saved.M);
  CHECK(thing.maybe == 3.5);
  CHECK_FALSE(thing.never.has_value());
  REQUIRE(thing.vectors.size() == 2);
  CHECK(thing.vectors[0] == saved.vectors[0]);
  CHECK(thing.vectors[1].size() == 0);
}

TEST_CASE("Archive_KeepsEveryBit") {
  Archive out;
  double nan = std::nan("7"), zero = -0.0, least = std::numeric_limits<double>::denorm_min();
  out.io("nan", nan);
  out.io("zero", zero);
  out.io("least", least);
  Archive in(out.content());
  double x = 1;
  for (const auto& [name, value] : {std::pair{"nan", nan}, {"zero", zero}, {"least", least}}) {
    in.io(name, x);
    CHECK(std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(value));
  }
}

TEST_CASE("ArchiveOfSomethingElse_IsRefused") {
  Archive out;
  Thing saved = filled();
  saved.persist(out);
  Archive in(out.content());
  double number = 0;
  CHECK_THROWS_WITH_AS(in.io("y", number), "there is no 'y'", ArchiveError);
  CHECK_THROWS_WITH_AS(in.io("v", number), "'v' has another shape", ArchiveError);
  Eigen::Matrix2d small;
  CHECK_THROWS_AS(in.io("M", small), ArchiveError);
  std::string text;
  CHECK_THROWS_AS(in.io("x", text), ArchiveError);
  CHECK_FALSE(in.unread().empty());
}

}  // namespace archive_test
}  // namespace hersey
