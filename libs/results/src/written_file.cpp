#include <ctime>
#include <exception>

#include "hersey/core/sealed_file.h"
#include "hersey/results/writer.h"
#include "writer_parts.h"

// A results file from its first byte to its seal.
namespace hersey::results {
namespace {

std::string now_iso8601() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[sizeof "2026-01-31T12:34:56Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

std::string_view to_string(Status status) {
  switch (status) {
    case Status::running:
      return "running";
    case Status::completed:
      return "completed";
    case Status::stopped:
      return "stopped";
    case Status::failed:
      return "failed";
  }
  return "unknown";
}
Writer::Writer(std::filesystem::path path, Options options) {
  const Hdf5Session session;
  impl_ = std::make_unique<Impl>(options);
  impl_->file.path = std::move(path);
  impl_->file.open(options.overwrite);
  impl_->scales.emplace(impl_->file.handle.get());
  attribute("/", "format", "hersey-results");
  attribute("/", "format_version", 1);
  attribute("/", "created", now_iso8601());
  attribute("/", "status", to_string(Status::running));
  attribute("/", "message", "");
  impl_->flow.flush();
}

Writer::Writer(InMemory how) : impl_(std::make_unique<Impl>(Options{})) {
  impl_->in_memory = true;
  impl_->keeps_all = how.keeps_all;
}

Writer::~Writer() {
  try {
    finish(Status::failed, "ended by an error");
  } catch (const std::exception&) {
    // The file is closed, in the state of its last good flush; a destructor cannot report an error.
  }
}

const std::vector<LatestRow>& Writer::latest() const { return impl_->latest; }

const Kept& Writer::kept() const { return impl_->kept; }

void Writer::rename(const std::filesystem::path& path, bool replace) {
  if (impl_->in_memory) return;
  impl_->flow.settle();
  impl_->file.require_open();
  impl_->file.sync();
  impl_->file.rename(path, replace);
}

void Writer::flush() {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  impl_->flow.flush();
}

void Writer::flush_if_due() {
  if (!impl_->in_memory) impl_->flow.end_step();
}

void Writer::finish(Status status, std::string_view message) {
  if (impl_->in_memory) return;
  if (!impl_->file.handle.valid()) return;
  std::exception_ptr unreported;
  try {
    impl_->flow.settle();
  } catch (const WriteError&) {
    unreported = std::current_exception();
  }
  const Hdf5Session session;
  const bool failed_before = impl_->file.status.failed;
  if (!failed_before) {
    try {
      impl_->flow.flush();  // a reader who finds the final status finds all data, too
      const Handle root(H5Oopen(impl_->file.handle.get(), "/", H5P_DEFAULT));
      impl_->set_text(root.get(), "status", to_string(status));
      impl_->set_text(root.get(), "message", message);
      impl_->flow.flush();
    } catch (const WriteError&) {
      unreported = std::current_exception();
    }
  }
  impl_->flow.datasets().clear();
  impl_->parent.reset();
  impl_->file.close();
  if (unreported) std::rethrow_exception(unreported);
  if (failed_before) return;
  impl_->require(true, {});
  try {
    seal_file(impl_->file.path);
  } catch (const std::runtime_error&) {
    // All is there: without its seal the file is read as that of a run that was killed.
  }
}

const std::filesystem::path& Writer::path() const { return impl_->file.path; }

}  // namespace hersey::results
