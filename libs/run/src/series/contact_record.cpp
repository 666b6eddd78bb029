#include "series/contact_record.h"

#include "series/geometry_record.h"

namespace hersey::run {
namespace {

const std::vector<Attribute<model::Contact>>& contact_attributes() {
  static const auto name_of = [](const model::ShapeName& shape) { return shape.body + "." + shape.shape; };
  static const std::vector<Attribute<model::Contact>> table{
      {"first", "", "shape as `body.shape`", [](const model::Contact& contact) { return name_of(contact.first); }},
      {"second", "", "the other one", [](const model::Contact& contact) { return name_of(contact.second); }},
      {"stiffness", "SI", "of the law, as worked out", part(&model::Contact::law, &mbd::ContactLaw::stiffness)},
      {"exponent", "1", "of the law", part(&model::Contact::law, &mbd::ContactLaw::exponent)},
      {"damping", "SI", "of the law", part(&model::Contact::law, &mbd::ContactLaw::damping)},
  };
  return table;
}

const QuantityTable<mbd::ContactObservation, model::Contact>& contact_quantities() {
  static const QuantityTable<mbd::ContactObservation, model::Contact> table{
      {"normal_force",
       "N",
       "sum of the normal forces of all spots",
       &mbd::ContactObservation::normal_force,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest, .name = "largest normal force", .unit = "N"}}}},
      {"friction_force",
       "N",
       "size of the friction force",
       [](const mbd::ContactObservation& observation) { return observation.friction.norm(); },
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest, .name = "largest friction force", .unit = "N"}}}},
      {"gap",
       "m",
       "smallest distance of the shapes, negative where they overlap",
       &mbd::ContactObservation::gap,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::smallest, .name = "smallest distance", .unit = "µm"}}}},
      {"force", "N", "on the second shape's body, ground axes", &mbd::ContactObservation::force},
      {"position", "m", "centre of the normal forces in ground; not a number without contact",
       &mbd::ContactObservation::position},
      {"damping_power",
       "W",
       "taken by the contact's damping",
       &mbd::ContactObservation::damping_power,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::integral, .name = "energy lost in damping", .unit = "mJ"}}}},
      {"friction_power",
       "W",
       "taken by friction",
       &mbd::ContactObservation::friction_power,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::integral, .name = "energy lost in friction", .unit = "mJ"}}}},
      {"spots", "1", "number of spots that touch", &mbd::ContactObservation::spots},
  };
  return table;
}

}  // namespace

ContactRecord::ContactRecord(const model::Contact& contact, results::Writer& writer)
    : rows_(contact_quantities(), "/contacts/" + contact.name + "/", contact, writer) {
  write_once(contact_attributes(), "/contacts/" + contact.name + "/", contact, writer);
}

QuantityGroup ContactRecord::describe() {
  QuantityGroup group{.path = "/contacts/<c>/", .heading = "of a contact", .quantities = {}};
  run::describe(contact_attributes(), "n", group);
  describe_link(group);
  run::describe(contact_quantities(), "n", group);
  return group;
}

}  // namespace hersey::run
