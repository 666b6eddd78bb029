// libFuzzer target: whatever bytes of a results file change, its reader returns what it finds or throws ReadError.
// longest: 64
#include "damaged_file.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"

namespace {

using namespace hersey::results;

/// A small file with one of everything.
std::string real_file() {
  const std::filesystem::path path = scratch_file("real.h5");
  {
    Writer writer(path, {.overwrite = true});
    writer.attribute("/", "program", "hersey");
    writer.attribute("/bearings/main", "diameter", 0.05);
    writer.attribute("/bearings/main", "names", std::vector<std::string>{"a", "b"});
    writer.text("/model", "hersey: 1\n", "the model");
    writer.text_table("/files", {{"a.csv", "x"}, {"b.csv", "y"}}, "files");
    writer.constant("/bearings/main/z", std::vector<double>{-1, 0, 1}, "m", "places");
    const Series time = writer.series("/time", 1, "s", "time");
    const Series force = writer.series("/bearings/main/force", 3, "N", "force");
    const Series field = writer.field("/bearings/main/fields/pressure", {4, 3}, "Pa", "pressure");
    for (int k = 0; k < 5; ++k) {
      time.append(0.1 * k);
      force.append({1.0 * k, 2.0, 3.0});
      if (k % 2 == 0) field.append(std::vector<double>(12, k));
    }
    writer.finish(Status::completed);
  }
  std::string content = content_of(path);
  std::filesystem::remove(path);
  return content;
}

void read_all(const std::filesystem::path& path) {
  const Reader reader(path);
  (void)reader.rows();
  for (const std::string& group : reader.groups()) {
    (void)reader.children(group);
    for (const std::string& name : reader.attributes(group)) {
      (void)reader.text_attribute(group, name);
      (void)reader.number_attribute(group, name);
      (void)reader.list_attribute(group, name);
    }
  }
  for (const std::string& name : reader.datasets()) {
    try {
      (void)reader.info(name);
      (void)reader.read(name);
    } catch (const ReadError&) {
      (void)reader.text_table(name);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string real = real_file();
  static const std::filesystem::path path = scratch_file("results.h5");
  write_content(path, damaged(real, data, size));
  try {
    read_all(path);
  } catch (const ReadError&) {
    // the expected answer to much of it
  }
  return 0;
}
