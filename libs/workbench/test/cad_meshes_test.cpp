#include "cad/cad_meshes.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "hersey/workbench/refused.h"
#include "temporary_directory.h"

namespace hersey::workbench {
namespace cad_meshes_test {

int status_of(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const Refused& refused) {
    return refused.status;
  }
  return 0;
}

/// A stand-in for `hersey`: a script.
std::filesystem::path program(const TemporaryDirectory& folder, const std::string& lines) {
  const std::filesystem::path file = folder / "program.sh";
  std::ofstream(file) << "#!/bin/sh\n" << lines;
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

CadState end_of(CadMeshes& meshes, const std::string& name) {
  using namespace std::chrono_literals;
  for (int i = 0; i < 500; ++i, std::this_thread::sleep_for(10ms))
    if (const CadState state = meshes.state(name); state.at != CadState::At::running) return state;
  return meshes.state(name);
}

TEST_CASE("CadMesh_IsWhatTheProgramWrites_ByTheOptionsThatWereAskedFor") {
  const TemporaryDirectory elsewhere, place;
  std::ofstream(place / "part.step") << "solid";
  const Folder folder(place.path());
  CadMeshes meshes(folder, program(elsewhere,
                                   "for w in \"$@\"; do case $w in --output=*) printf '%s\\n' \"$@\" "
                                   ">\"${w#--output=}\";; esac; done\n"));
  const std::string name = meshes.start({.path = "part.step", .output = "", .size = "4 mm", .order = 1, .around = 20});
  const CadState state = end_of(meshes, name);
  CHECK(state.at == CadState::At::made);
  CHECK(state.output == "part.msh");
  std::ifstream stream(place / "part.msh");
  const std::string said((std::istreambuf_iterator<char>(stream)), {});
  for (const char* word : {"mesh\n", "--size=4 mm\n", "--order=1\n", "--around=20\n"}) {
    CAPTURE(word);
    CHECK(said.find(word) != std::string::npos);
  }
  // What is there stays.
  CHECK(status_of([&] { meshes.start({.path = "part.step", .output = "", .size = "4 mm"}); }) == 409);
  CHECK(status_of([&] { meshes.start({.path = "part.step", .output = "a.txt", .size = "4 mm"}); }) == 422);
  CHECK(status_of([&] { meshes.start({.path = "part.step", .output = "../a.msh", .size = "4 mm"}); }) == 403);
  CHECK(status_of([&] { meshes.start({.path = "../part.step", .output = "", .size = "4 mm"}); }) == 403);
  CHECK(status_of([&] { meshes.start({.path = "none.step", .output = "", .size = "4 mm"}); }) == 404);
  CHECK(status_of([&] { meshes.start({.path = "part.msh", .output = "", .size = "4 mm"}); }) == 422);
  CHECK(status_of([&] { (void)meshes.state("77"); }) == 404);
  for (const int order : {0, 3, -1}) {
    CAPTURE(order);
    const CadRequest request{.path = "part.step", .output = "b.msh", .size = "4 mm", .order = order};
    CHECK(status_of([&] { meshes.start(request); }) == 422);
  }
}

TEST_CASE("CadMesh_ThatIsBeingMade_IsNotMadeTwice") {
  const TemporaryDirectory elsewhere, place;
  std::ofstream(place / "part.step") << "solid";
  const Folder folder(place.path());
  CadMeshes meshes(folder, program(elsewhere, "sleep 60\n"));
  const CadRequest first{.path = "part.step", .output = "a.msh", .size = "4 mm"};
  CadRequest second = first;
  const std::string name = meshes.start(first);
  CHECK(status_of([&] { meshes.start(second); }) == 409);
  second.output = "b.msh";
  CHECK(status_of([&] { meshes.stop(meshes.start(second)); }) == 0);
  meshes.stop(name);
  end_of(meshes, name);
  CHECK(status_of([&] { meshes.start(first); }) == 0);
}

TEST_CASE("CadMesh_ThatFailsSaysWhy_AndOneThatTakesLongIsStopped") {
  const TemporaryDirectory elsewhere, place;
  std::ofstream(place / "part.brep") << "solid";
  const Folder folder(place.path());
  CadMeshes failing(folder, program(elsewhere, "echo no solids >&2; exit 1\n"));
  const CadState failed = end_of(failing, failing.start({.path = "part.brep", .output = "", .size = "1 mm"}));
  CHECK(failed.at == CadState::At::failed);
  CHECK(failed.message == "no solids");
  const TemporaryDirectory other;
  CadMeshes slow(folder, program(other, "sleep 60\n"));
  const std::string name = slow.start({.path = "part.brep", .output = "", .size = "1 mm"});
  CHECK(slow.state(name).at == CadState::At::running);
  slow.stop(name);
  const CadState stopped = end_of(slow, name);
  CHECK(stopped.at == CadState::At::failed);
  CHECK(stopped.message == "It was stopped.");
}

}  // namespace cad_meshes_test
}  // namespace hersey::workbench
