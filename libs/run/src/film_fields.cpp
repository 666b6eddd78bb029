#include "hersey/run/film_fields.h"

namespace hersey::run {

const std::vector<FilmField>& film_fields() {
  using F = film::FilmFields;
  static const std::string of_elastic = "of surfaces of elastic bodies; against the surface's frame";
  static const std::vector<FilmField> table{
      {"pressure", "Pa", "film pressure", "pressure", "MPa", 1e-6, &F::p, "p"},
      {"asperity_pressure", "Pa", "asperity contact pressure", "asperity pressure", "MPa", 1e-6, &F::p_asperity, "p_a"},
      {"thickness", "m", "film thickness, depth of features included", "film thickness", "um", 1e6, &F::thickness, "h"},
      {"fill", "1", "fill fraction", "fill fraction", "", 1, &F::theta, "theta"},
      {"shell_displacement", "m", "radial displacement of the shell's surface, outward", "shell displacement", "um",
       1e6, &F::d_shell, "", of_elastic},
      {"journal_displacement", "m", "radial displacement of the journal's surface, outward", "journal displacement",
       "um", 1e6, &F::d_journal, "", of_elastic},
  };
  return table;
}

}  // namespace hersey::run
