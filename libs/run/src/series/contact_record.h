#pragma once

#include "hersey/mbd/contact.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// One contact in the results file.
class ContactRecord {
 public:
  ContactRecord(const model::Contact& contact, results::Writer& writer);
  /// @param observation  in ground's axes
  void append(const mbd::ContactObservation& observation) const { rows_.append(observation); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  QuantityRows<mbd::ContactObservation, model::Contact> rows_;
};

}  // namespace hersey::run
