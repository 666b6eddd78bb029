// Keywords as in the CalculiX 2.20 manual, chapter 7, and the Abaqus 2016 keywords reference guide.
#include "mesh/abaqus_keywords.h"

#include <map>

namespace hersey::fem {

bool changes_the_mesh(std::string_view keyword) {
  static const std::set<std::string_view> all = {"NGEN",         "NFILL",      "NCOPY",  "NMAP",
                                                 "ELGEN",        "ELCOPY",     "ADJUST", "SYMMETRICMODELGENERATION",
                                                 "IMPERFECTION", "MODELCHANGE"};
  return all.contains(keyword);
}

bool concerns_no_mesh(std::string_view keyword) {
  static constexpr std::string_view all =
      " HEADING PREPRINT RESTART ASSEMBLY ENDASSEMBLY PART ENDPART INSTANCE ENDINSTANCE STEP ENDSTEP AMPLITUDE "
      "BOUNDARY "
      "INITIALCONDITIONS TRANSFORM ORIENTATION DISTRIBUTION DISTRIBUTIONTABLE SHELLSECTION MEMBRANESECTION "
      "SURFACESECTION BEAMGENERALSECTION SECTIONCONTROLS EXPANSION CONDUCTIVITY SPECIFICHEAT PHYSICALCONSTANTS DEPVAR "
      "DAMAGEINITIATION SURFACEINTERACTION SURFACEBEHAVIOR FRICTION GAPCONDUCTANCE CONTACT CONTACTPAIR CONTACTCONTROLS "
      "CONTACTDAMPING CONTACTINCLUSIONS CONTACTEXCLUSIONS CONTACTPROPERTYASSIGNMENT FILEFORMAT NODEFILE ELFILE "
      "NODEPRINT ELPRINT OUTPUT TIMEPOINTS ";
  return all.find(' ' + std::string(keyword) + ' ') != std::string_view::npos;
}

const std::set<std::string_view>* parameters_of(std::string_view keyword) {
  static const std::map<std::string_view, std::set<std::string_view>> all = {
      {"NODE", {"NSET", "SYSTEM"}},
      {"ELEMENT", {"TYPE", "ELSET"}},
      {"NSET", {"NSET", "GENERATE", "UNSORTED", "INTERNAL", "INSTANCE"}},
      {"ELSET", {"ELSET", "GENERATE", "UNSORTED", "INTERNAL", "INSTANCE"}},
      {"SURFACE", {"NAME", "TYPE", "INTERNAL"}},
      {"MATERIAL", {"NAME"}},
      {"ELASTIC", {"TYPE", "MODULI"}},
      {"DENSITY", {}},
      {"TIE", {"NAME", "POSITION TOLERANCE", "POSITIONTOLERANCE", "ADJUST", "TYPE", "NO ROTATION"}},
      {"EQUATION", {}},
      {"RIGIDBODY",
       {"NSET", "ELSET", "REF NODE", "REFNODE", "ROT NODE", "ROTNODE", "TIE NSET", "TIENSET", "PIN NSET", "PINNSET",
        "ISOTHERMAL", "POSITION", "ANALYTICAL SURFACE"}},
      {"SYSTEM", {}},
      {"MPC", {}},
      {"SOLIDSECTION", {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS", "REFNODE"}},
  };
  const auto found = all.find(keyword);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace hersey::fem
