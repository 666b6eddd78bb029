#include "build/reduction_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <exception>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "hersey/core/packer.h"
#include "hersey/core/program_identity.h"
#include "hersey/core/sealed_file.h"
#include "hersey/model/reduction_folder.h"

namespace hersey::model {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "hersey kept reduction 1";
constexpr const char* kEnding = ".reduction";
constexpr std::uintmax_t kMostOnDisk = 2'000'000'000;

void persist_mass(Archive& archive, Eigen::SparseMatrix<double>& m) {
  const Archive::Group group(archive, "mass");
  m.makeCompressed();
  std::vector<int> begins(m.outerIndexPtr(), m.outerIndexPtr() + m.outerSize() + 1);
  std::vector<int> rows(m.innerIndexPtr(), m.innerIndexPtr() + m.nonZeros());
  std::vector<double> values(m.valuePtr(), m.valuePtr() + m.nonZeros());
  archive.io("begins", begins);
  archive.io("rows", rows);
  archive.io("values", values);
  if (!archive.restores()) return;
  const auto n = static_cast<Eigen::Index>(begins.size()) - 1;
  m = Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, static_cast<Eigen::Index>(values.size()), begins.data(),
                                                    rows.data(), values.data());
}

// All that is computed; mesh, materials and frames are those of the model.
void persist(Archive& archive, fem::ReducedBody& body) {
  archive.io("Phi", body.Phi);
  archive.io("K", body.K);
  archive.io("M", body.M);
  archive.io("internal_omega", body.internal_omega);
  archive.io("energy_missed", body.energy_missed);
  persist_mass(archive, body.m);
  archive.each("static_errors", body.static_errors, [](Archive& into, fem::StaticError& error) {
    into.io("surface", error.surface);
    into.io("shapes", error.shapes);
    into.io("modes", error.modes);
    into.io("reduced", error.reduced);
  });
  archive.each("film_modes", body.film_modes, [](Archive& into, fem::FilmModes& film) {
    into.io("shapes", film.shapes);
    into.io("loads", film.loads);
    into.io("pressures", film.pressures);
    into.io("compliance", film.compliance);
    into.io("lost", film.lost);
  });
}

std::vector<unsigned char> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) throw std::runtime_error("no file");
  std::vector<unsigned char> bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error("a file that cannot be read");
  return bytes;
}

std::span<const char> characters(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The bytes before the seal. @throws std::runtime_error if it is none of them
std::vector<unsigned char> unsealed(std::vector<unsigned char> bytes) {
  const std::size_t seal = seal_of({}).size();
  if (bytes.size() < seal) throw std::runtime_error("a file without a seal");
  const std::string found(bytes.end() - static_cast<std::ptrdiff_t>(seal), bytes.end());
  bytes.resize(bytes.size() - seal);
  if (found != seal_of(characters(bytes))) throw std::runtime_error("a damaged file");
  return bytes;
}

/// A limit to the size of files fails the write, as a full disk does, and does not end the program.
class IgnoredFileSizeSignal {
 public:
  IgnoredFileSizeSignal() : before_(std::signal(SIGXFSZ, SIG_IGN)) {}
  IgnoredFileSizeSignal(const IgnoredFileSizeSignal&) = delete;
  IgnoredFileSizeSignal& operator=(const IgnoredFileSizeSignal&) = delete;
  ~IgnoredFileSizeSignal() { std::signal(SIGXFSZ, before_); }

 private:
  void (*before_)(int);
};

/// True for the files that keep() writes, finished or not: 0123456789abcdef.reduction, and .reduction.4711.
bool is_ours(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == kEnding) return true;
  const bool is_number = ending.size() > 1 && std::all_of(ending.begin() + 1, ending.end(),
                                                          [](unsigned char c) { return std::isdigit(c) != 0; });
  return is_number && file.stem().extension() == kEnding;
}

std::mutex folder_mutex;
std::shared_ptr<const ReductionFolder> the_folder;

}  // namespace

ReductionFolder::ReductionFolder(fs::path folder, std::uintmax_t most)
    : folder_(std::move(folder)), most_(most), program_(program_identity()) {}

std::optional<fem::ReducedBody> ReductionFolder::find(const std::string& fingerprint) const {
  if (program_.empty()) return std::nullopt;
  try {
    const fs::path file = file_of(fingerprint);
    const std::vector<unsigned char> bytes = unsealed(bytes_of(file));
    Unpacker unpacker(bytes.data(), bytes.size());
    if (unpacker.text() != kFormat || unpacker.text() != program_ || unpacker.text() != fingerprint)
      return std::nullopt;
    Archive archive(unpacker.content());
    unpacker.require_end();
    fem::ReducedBody reduced;
    persist(archive, reduced);
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // it is used
    return reduced;
  } catch (const std::exception&) {
    return std::nullopt;  // it is reduced anew, and its file replaced
  }
}

void ReductionFolder::keep(const fem::ReducedBody& reduced, const std::string& fingerprint) const {
  try {
    if (!program_.empty()) write(reduced, fingerprint);
  } catch (const std::exception&) {
    return;  // such as of memory that does not suffice for the copy: the run needs none
  }
}

void ReductionFolder::write(const fem::ReducedBody& reduced, const std::string& fingerprint) const {
  const IgnoredFileSizeSignal ignored;
  Archive archive;
  fem::ReducedBody stored = reduced;
  persist(archive, stored);
  Packer packer;
  packer.put(std::string(kFormat));
  packer.put(program_);
  packer.put(fingerprint);
  packer.put(archive.content());
  const std::vector<unsigned char> bytes = packer.take();
  const std::string seal = seal_of(characters(bytes));
  if (bytes.size() > most_) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  remove_beyond(most_ - bytes.size());
  const fs::path file = file_of(fingerprint);
  fs::path unfinished = file;
  unfinished += fmt::format(".{}", ::getpid());  // other processes may keep the same body
  std::ofstream stream(unfinished, std::ios::binary);
  stream.write(characters(bytes).data(), static_cast<std::streamsize>(bytes.size()));
  stream << seal;
  stream.close();
  if (stream) fs::rename(unfinished, file, error);
  if (!stream || error) fs::remove(unfinished, error);
}

fs::path ReductionFolder::file_of(const std::string& fingerprint) const {
  const std::uint64_t hash = crc64(program_, crc64(fingerprint));
  return folder_ / fmt::format("{:016x}{}", hash, kEnding);
}

void ReductionFolder::remove_beyond(std::uintmax_t most) const {
  struct Kept {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t size;
  };
  std::vector<Kept> kept;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_ours(entry->path())) continue;
    std::error_code gone;
    const auto size = entry->file_size(gone);
    const auto used = gone ? fs::file_time_type() : entry->last_write_time(gone);
    if (!gone) kept.push_back({entry->path(), used, size});
  }
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.used > b.used; });
  std::uintmax_t sum = 0;
  for (const Kept& one : kept) {
    sum += one.size;
    if (sum > most) fs::remove(one.path, error);
  }
}

std::shared_ptr<const ReductionFolder> reduction_folder() {
  const std::lock_guard lock(folder_mutex);
  return the_folder;
}

void keep_reductions_in(const fs::path& folder) {
  const std::lock_guard lock(folder_mutex);
  the_folder = folder.empty() ? nullptr : std::make_shared<const ReductionFolder>(folder, kMostOnDisk);
}

}  // namespace hersey::model
