// Entries as in the quick reference guide of MSC Nastran (2012).
#include "mesh/nastran_entries.h"

#include <algorithm>
#include <array>
#include <string>

#include "mesh/nastran_sets.h"

namespace hersey::fem {
namespace {

bool is_listed(std::string_view all, std::string_view entry) {
  return all.find(' ' + std::string(entry) + ' ') != std::string_view::npos;
}

}  // namespace

bool is_axisymmetric(std::string_view entry) {
  return is_listed(" CTRIAX CTRIAX6 CQUADX CQUADX4 CQUADX8 CTRAX3 CTRAX6 CTRAPAX CTRAPRG CTRIARG CTRIAAX CCONEAX ",
                   entry);
}

bool changes_the_bulk(std::string_view entry) {
  const bool repeats = entry.starts_with('=') || entry.starts_with('+') || entry.starts_with('*');  // of no entry
  if (entry.starts_with("BEGIN")) return !is_begin_bulk(entry);                                     // of a superelement
  return repeats || is_listed(" CTETRAR GRIDB GRIDF GRIDS GRIDA ", entry) || is_axisymmetric(entry);
}

bool concerns_no_bulk(std::string_view entry) {
  static constexpr std::array beginnings = {
      "SPC",   "FORCE", "MOMENT", "PLOAD", "GRAV", "RFORCE",  "TEMP",    "EIG",   "ASET",   "BSET",   "CSET",   "QSET",
      "OMIT",  "USET",  "SUPORT", "TABLE", "TABD", "TLOAD",   "RLOAD",   "FREQ",  "TSTEP",  "NLPARM", "MATT",   "DES",
      "DRESP", "ACCEL", "BC",     "DV",    "DEQ",  "DCONSTR", "DCONADD", "DLINK", "DTABLE", "DOPT",   "DSCREEN"};
  const bool begins = std::any_of(beginnings.begin(), beginnings.end(),
                                  [&](const char* beginning) { return entry.starts_with(beginning); });
  return begins || is_begin_bulk(entry) ||
         is_listed(
             " LOAD DLOAD LSEQ DAREA DELAY DPHASE PARAM ECHOON ECHOOFF MAT4 MAT5 PSHELL PCOMP PCOMPG PROD "
             "PTUBE PBUSH PELAS "
             "PMASS PDAMP PSHEAR PGAP SPOINT EPOINT SEQGP PLOTEL MPCADD SET2 ENDDATA BAROR BEAMOR ",
             entry);
}

bool is_other_material(std::string_view entry) {
  return is_listed(" MAT2 MAT3 MAT8 MAT9 MAT10 MAT11 MATHP MATHE MATORT MATVE MATPE1 ", entry);
}

}  // namespace hersey::fem
