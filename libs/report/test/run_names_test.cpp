#include "run_names.h"

#include <doctest/doctest.h>

namespace hersey::report {
namespace run_names_test {

using Names = std::vector<std::string>;

TEST_CASE("Runs_AreNamedByFileOrFolder") {
  CHECK(run_names({"/runs/a/results.h5", "/runs/b/results.h5"}) == Names{"a", "b"});
  CHECK(run_names({"/runs/s/load_100_N.h5", "/runs/s/load_200_N.h5"}) == Names{"load_100_N", "load_200_N"});
  CHECK(run_names({"/runs/rigid/results.h5", "/runs/old.h5"}) == Names{"rigid", "old"});
  CHECK(run_names({"/runs/rigid/results.h5"}) == Names{"rigid"});
  CHECK(run_names({"/results.h5"}) == Names{"results"});
}

TEST_CASE("RunsOfOneName_GetTheFoldersThatDiffer") {
  CHECK(run_names({"/w/monday/rigid/results.h5", "/w/tuesday/rigid/results.h5", "/w/monday/soft/results.h5"}) ==
        Names{"monday/rigid", "tuesday/rigid", "soft"});
  CHECK(run_names({"/w/a/run.h5", "/w/b/run.h5"}) == Names{"a/run", "b/run"});
  CHECK(run_names({"/w/a/results.h5", "/w/b/../a/results.h5"}) == Names{"w/a", "w/a (2)"});
  CHECK(run_names({"/w/a/results.h5", "/w/a.h5"}) == Names{"w/a", "w/a (2)"});
}

}  // namespace run_names_test
}  // namespace hersey::report
