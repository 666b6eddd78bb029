// Entries as in the quick reference guide of MSC Nastran (2012).
#include "mesh/nastran_entries.h"

#include <algorithm>
#include <array>
#include <string>

namespace hersey::fem {
namespace {

bool is_listed(std::string_view all, std::string_view entry) {
  return all.find(' ' + std::string(entry) + ' ') != std::string_view::npos;
}

}  // namespace

bool changes_the_bulk(std::string_view entry) {
  const bool repeats = entry.starts_with('=') || entry.starts_with('+') || entry.starts_with('*');
  if (entry.starts_with("BEGIN")) return true;  // of a superelement
  return repeats ||
         is_listed(" CPYRAM CPYRA CTETRAR CBEND CBEAM3 GRIDB GRIDF GRIDS GRIDA BAROR BEAMOR CTRIAX CTRIAX6 ", entry);
}

bool concerns_no_bulk(std::string_view entry) {
  static constexpr std::array beginnings = {"SPC",    "FORCE", "MOMENT", "PLOAD", "GRAV",  "RFORCE", "TEMP",
                                            "EIG",    "ASET",  "BSET",   "CSET",  "QSET",  "OMIT",   "USET",
                                            "SUPORT", "TABLE", "TABD",   "TLOAD", "RLOAD", "FREQ",   "TSTEP",
                                            "NLPARM", "CORD",  "MATT",   "DES",   "DRESP", "ACCEL",  "BC"};
  const bool begins = std::any_of(beginnings.begin(), beginnings.end(),
                                  [&](const char* beginning) { return entry.starts_with(beginning); });
  return begins || is_listed(
                       " LOAD DLOAD LSEQ DAREA DELAY DPHASE PARAM ECHOON ECHOOFF MAT4 MAT5 PSHELL PCOMP PCOMPG PROD "
                       "PTUBE PBUSH PELAS "
                       "PMASS PDAMP PSHEAR PGAP SPOINT EPOINT SEQGP PLOTEL MPCADD SET2 ENDDATA ",
                       entry);
}

bool is_other_material(std::string_view entry) {
  return is_listed(" MAT2 MAT3 MAT8 MAT9 MAT10 MAT11 MATHP MATHE MATORT MATVE MATPE1 ", entry);
}

}  // namespace hersey::fem
