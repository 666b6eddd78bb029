// What the results file keeps of contacts.
#include "recorder.h"

namespace hersey::run {

void Recorder::declare_contacts() {
  for (const model::Contact& contact : model_.contacts) {
    const std::string group = "/contacts/" + contact.name, path = group + "/";
    writer_.attribute(group, "first", contact.first.body + "." + contact.first.shape);
    writer_.attribute(group, "second", contact.second.body + "." + contact.second.shape);
    writer_.attribute(group, "stiffness", contact.law.stiffness);
    writer_.attribute(group, "exponent", contact.law.exponent);
    writer_.attribute(group, "damping", contact.law.damping);
    const auto series = [&](const char* name, const char* unit, const char* description, int columns = 1) {
      return writer_.series(path + name, columns, unit, description);
    };
    contacts_.push_back(
        {series("gap", "m", "smallest distance of the shapes, negative where they overlap"),
         series("normal_force", "N", "sum of the normal forces of all spots"),
         series("friction_force", "N", "size of the friction force"),
         series("force", "N", "on the second shape's body, ground axes", 3),
         series("position", "m", "centre of the normal forces in ground; not a number without contact", 3),
         series("damping_power", "W", "taken by the contact's damping"),
         series("friction_power", "W", "taken by friction"), series("spots", "1", "number of spots that touch")});
  }
}

void Recorder::write_contacts(const std::vector<mbd::ContactObservation>& seen) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].gap.append(seen[i].gap);
    contacts_[i].normal_force.append(seen[i].normal_force);
    contacts_[i].friction_force.append(seen[i].friction.norm());
    contacts_[i].force.append(seen[i].force);
    contacts_[i].position.append(seen[i].position);
    contacts_[i].damping_power.append(seen[i].damping_power);
    contacts_[i].friction_power.append(seen[i].friction_power);
    contacts_[i].spots.append(seen[i].spots);
  }
}

}  // namespace hersey::run
