#include "hersey/core/hdf5_handle.h"

#include <doctest/doctest.h>
#include <hdf5.h>

#include <array>
#include <utility>

#include "temporary_directory.h"

namespace hersey {
namespace hdf5_handle_test {

TEST_CASE("Hdf5Handle_ReleasesItsIdentifierOnce") {
  const Hdf5Session session;
  Hdf5Handle first(H5Screate(H5S_SCALAR));
  const hid_t id = first.get();
  Hdf5Handle second = std::move(first);
  CHECK_FALSE(first.valid());
  CHECK(first.reset());
  CHECK(H5Iis_valid(id) > 0);
  Hdf5Handle third(H5Screate(H5S_SCALAR));
  const hid_t replaced = third.get();
  third = std::move(second);
  CHECK(third.get() == id);
  CHECK(H5Iis_valid(replaced) <= 0);
  CHECK(third.reset());
  CHECK(H5Iis_valid(id) <= 0);
}

TEST_CASE("Hdf5Session_IsSilentAndLeavesErrorsAsTheyWere") {
  H5E_auto2_t function = nullptr, now = nullptr;
  void *data = nullptr, *data_now = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &function, &data);
  {
    const Hdf5Session outer;
    { const Hdf5Session inner; }
    H5Eget_auto2(H5E_DEFAULT, &now, &data_now);
    CHECK((now == nullptr));
  }
  H5Eget_auto2(H5E_DEFAULT, &now, &data_now);
  CHECK((now == function));
  CHECK(data_now == data);
}

TEST_CASE("ExtentOfASpace_ListsItsLengths") {
  const Hdf5Session session;
  const std::array<hsize_t, 3> lengths{3, 0, 5};
  CHECK(extent_of(Hdf5Handle(H5Screate_simple(3, lengths.data(), nullptr)).get()) == std::vector<std::size_t>{3, 0, 5});
  CHECK(extent_of(Hdf5Handle(H5Screate(H5S_SCALAR)).get()).empty());
  CHECK(extent_of(-1).empty());
}

TEST_CASE("ObjectOfAFile_IsFoundByItsPath") {
  const Hdf5Session session;
  const TemporaryDirectory folder;
  const Hdf5Handle file(H5Fcreate((folder / "f.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  const Hdf5Handle outer(H5Gcreate2(file.get(), "a", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  const Hdf5Handle inner(H5Gcreate2(outer.get(), "b", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  for (const char* path : {"a", "/a", "a/b", "/a/b"}) CHECK(has_object(file.get(), path));
  for (const char* path : {"b", "/b", "a/c", "c/b", "/a/b/c"}) CHECK_FALSE(has_object(file.get(), path));
}

}  // namespace hdf5_handle_test
}  // namespace hersey
