#include "writer_parts.h"

// Data that a results file contains once: attributes, texts, constants, labels.
namespace hersey::results {

void Writer::attribute(std::string_view object, std::string_view name, std::string_view text) {
  if (impl_->in_memory) return impl_->keep_attribute(object, name, std::string(text));
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  impl_->set_text(impl_->open_or_make(absolute(object)).get(), name, text);
}

void Writer::attribute(std::string_view object, std::string_view name, double value) {
  if (impl_->in_memory) return impl_->keep_attribute(object, name, value);
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, H5T_NATIVE_DOUBLE, impl_->scalar.get(), &value);
}

void Writer::attribute(std::string_view object, std::string_view name, int value) {
  if (impl_->in_memory) return impl_->keep_attribute(object, name, static_cast<double>(value));
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, H5T_NATIVE_INT, impl_->scalar.get(), &value);
}

void Writer::attribute(std::string_view object, std::string_view name, const std::vector<std::string>& texts) {
  if (impl_->in_memory) return impl_->keep_attribute(object, name, texts);
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t n = texts.size();
  const Handle space(n > 0 ? H5Screate_simple(1, &n, nullptr) : H5Screate(H5S_NULL));
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, impl_->text.get(), space.get(), pointers.data());
}

void Writer::text(std::string_view path, std::string_view content, std::string_view description) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle dataset =
      impl_->make_dataset(path, impl_->text.get(), impl_->scalar.get(), H5P_DEFAULT, H5P_DEFAULT, "1", description);
  const std::string copy(content);
  const char* pointer = copy.c_str();
  impl_->require(H5Dwrite(dataset.get(), impl_->text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer) >= 0,
                 "HDF5 cannot write text");
}

void Writer::text_table(std::string_view path, const std::vector<std::pair<std::string, std::string>>& rows,
                        std::string_view description) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  std::vector<const char*> pointers;
  for (const auto& [name, content] : rows) pointers.insert(pointers.end(), {name.c_str(), content.c_str()});
  const std::array<hsize_t, 2> shape{rows.size(), 2};
  const Handle space(H5Screate_simple(2, shape.data(), nullptr));
  const Handle dataset =
      impl_->make_dataset(path, impl_->text.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, "1", description);
  if (rows.empty()) return;
  const std::string name = absolute(path);
  impl_->name_dimensions(dataset, name,
                         {impl_->numbers(name + "_row", rows.size(), "row of " + name + ", counted from 0"),
                          impl_->numbers(name + "_column", 2, "0: name; 1: text")});
  impl_->require(H5Dwrite(dataset.get(), impl_->text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0,
                 "HDF5 cannot write a table");
}

void Writer::constant(std::string_view path, std::span<const double> values, std::string_view unit,
                      std::string_view description, std::string_view dimension) {
  if (impl_->in_memory) {
    if (impl_->keeps_all)
      impl_->kept.constants[absolute(path)] = {
          std::string(unit), std::string(description), {values.begin(), values.end()}};
    return;
  }
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(!values.empty(), "a constant has numbers");
  impl_->write_constant(absolute(path), values, unit, description, dimension);
}

void Writer::labels(std::string_view path, const std::vector<std::string>& names, std::string_view description) {
  if (impl_->in_memory) {
    impl_->words[absolute(path)] = names;
    return;
  }
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(!names.empty(), "labels are of something");
  impl_->write_labels(absolute(path), names, description);
}

}  // namespace hersey::results
