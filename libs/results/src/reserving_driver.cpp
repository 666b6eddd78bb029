#include "reserving_driver.h"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

namespace hersey::results {
namespace {

constexpr haddr_t reserve_step = haddr_t{1} << 20;  // few system calls for many small allocations

/// What a property list carries to the driver; plain, for HDF5 copies it by memcpy.
struct Info {
  int fd;
  DriverStatus* status;
};

/// A piece of metadata (indices, headers) that waits for the end of the flush.
struct Piece {
  H5FD_mem_t type;
  std::vector<char> bytes;
};

/// HDF5 sees only its public part, which must come first.
struct ReservedFile {
  H5FD_t base;
  int fd;
  DriverStatus* status;
  haddr_t eoa;                       // end of the space HDF5 has taken
  haddr_t reserved;                  // end of the space the disk has promised
  std::map<haddr_t, Piece> waiting;  // without overlaps
  std::set<haddr_t> index_nodes;     // addresses of B-tree nodes that are in the file
};

ReservedFile& self(H5FD_t* file) { return *reinterpret_cast<ReservedFile*>(file); }
const ReservedFile& self(const H5FD_t* file) { return *reinterpret_cast<const ReservedFile*>(file); }

void fail(ReservedFile& file, int error) {
  if (file.status->failed) return;
  file.status->failed = true;
  file.status->reason = std::strerror(error);
}

/// Growing beyond RLIMIT_FSIZE raises SIGXFSZ, which would end the program; the error code alone is wanted.
class WithoutSizeSignal {
 public:
  WithoutSizeSignal() {
    sigemptyset(&signal_);
    sigaddset(&signal_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  WithoutSizeSignal(const WithoutSizeSignal&) = delete;
  WithoutSizeSignal& operator=(const WithoutSizeSignal&) = delete;
  ~WithoutSizeSignal() {
    const timespec now{0, 0};
    while (sigtimedwait(&signal_, nullptr, &now) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t signal_;
  sigset_t before_;
};

int grow(ReservedFile& file, haddr_t end) {
  const WithoutSizeSignal guard;
  int error = 0;
  do {
    error = posix_fallocate(file.fd, static_cast<off_t>(file.reserved), static_cast<off_t>(end - file.reserved));
  } while (error == EINTR);
  if (error == 0) file.reserved = end;
  return error;
}

void reserve(ReservedFile& file, haddr_t end) {
  if (end <= file.reserved || file.status->failed) return;
  const haddr_t generous = (end / reserve_step + 1) * reserve_step;
  if (grow(file, generous) == 0) return;
  if (const int error = grow(file, end)) fail(file, error);
}

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* info = static_cast<const Info*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  return &std::make_unique<ReservedFile>(ReservedFile{{}, info->fd, info->status, 0, 0, {}, {}}).release()->base;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  // Metadata is not gathered into blocks: allocate() gives every piece its own address.
  if (flags != nullptr) *flags = H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return self(file).eoa; }

herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  reserve(self(file), address);
  self(file).eoa = address;
  return 0;
}

/// Finds room at the end of the file. A kill can cut a write where it crosses from one memory page to the next, and an
/// index node cut in two is not readable: a piece of metadata that fits into a page is put into one.
haddr_t allocate(H5FD_t* base, H5FD_mem_t type, hid_t, hsize_t size) {
  static const auto page = static_cast<haddr_t>(sysconf(_SC_PAGESIZE));
  ReservedFile& file = self(base);
  haddr_t address = file.eoa;
  const bool crosses = address % page + size > page;
  if (type != H5FD_MEM_DRAW && size <= page && crosses) address = (address / page + 1) * page;
  reserve(file, address + size);
  file.eoa = address + size;
  return address;
}

haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return self(file).reserved; }

haddr_t end_of(const std::pair<const haddr_t, Piece>& entry) { return entry.first + entry.second.bytes.size(); }

/// The first waiting piece that ends beyond `address`.
std::map<haddr_t, Piece>::iterator first_beyond(ReservedFile& file, haddr_t address) {
  auto next = file.waiting.upper_bound(address);
  if (next == file.waiting.begin()) return next;
  const auto before = std::prev(next);
  return end_of(*before) > address ? before : next;
}

/// Waiting pieces are newer than the contents of the file.
void overlay(ReservedFile& file, haddr_t address, std::size_t size, char* buffer) {
  for (auto at = first_beyond(file, address); at != file.waiting.end() && at->first < address + size; ++at) {
    const auto& [start, piece] = *at;
    const haddr_t from = std::max(start, address), to = std::min(end_of(*at), address + size);
    std::memcpy(buffer + (from - address), piece.bytes.data() + (from - start), to - from);
  }
}

/// A piece replaces the waiting ones it covers; the uncovered parts of older ones remain.
void put(ReservedFile& file, haddr_t address, Piece piece) {
  const haddr_t end = address + piece.bytes.size();
  for (auto at = first_beyond(file, address); at != file.waiting.end() && at->first < end;) {
    const haddr_t start = at->first, old_end = end_of(*at);
    if (old_end > end) {
      const auto tail = at->second.bytes.begin() + static_cast<std::ptrdiff_t>(end - start);
      file.waiting.emplace(end, Piece{at->second.type, {tail, at->second.bytes.end()}});
    }
    if (start < address) {
      at->second.bytes.resize(address - start);
      ++at;
    } else {
      at = file.waiting.erase(at);
    }
  }
  file.waiting.insert_or_assign(address, std::move(piece));
}

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  ReservedFile& file = self(base);
  auto* to = static_cast<char*>(buffer);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = pread(file.fd, to + done, size - done, static_cast<off_t>(address + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file, errno);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  std::memset(to + done, 0, size - done);  // reserved, never written
  overlay(file, address, size, to);
  return 0;
}

void write_now(ReservedFile& file, haddr_t address, const char* from, std::size_t size) {
  while (size > 0 && !file.status->failed) {
    const ssize_t n = pwrite(file.fd, from, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return fail(file, errno);
    from += n;
    address += static_cast<haddr_t>(n);
    size -= static_cast<std::size_t>(n);
  }
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t type, hid_t, haddr_t address, std::size_t size, const void* buffer) {
  ReservedFile& file = self(base);
  const auto* from = static_cast<const char*>(buffer);
  if (file.status->failed) return 0;
  if (type == H5FD_MEM_DRAW)
    write_now(file, address, from, size);
  else
    put(file, address, Piece{type, std::vector<char>(from, from + size)});
  return 0;
}

/// Height of a B-tree node above the leaves, byte 5 of its image (HDF5 file format 3.0, III.A.1); 0 for other pieces.
int node_level(const Piece& piece) {
  const bool node = piece.bytes.size() > 5 && std::memcmp(piece.bytes.data(), "TREE", 4) == 0;
  return node ? static_cast<unsigned char>(piece.bytes[5]) : 0;
}

/// Smaller ranks are written first, so that nothing in the file ever points to what is not there yet: the superblock,
/// for it states how far the file reaches (the space is there already); index nodes before the headers that state the
/// number of rows; among index nodes the new ones first, then from the root to the leaves, for a split leaf must not
/// shrink before its parent knows the other half.
std::tuple<int, int> rank(const ReservedFile& file, haddr_t address, const Piece& piece) {
  switch (piece.type) {
    case H5FD_MEM_SUPER:
      return {0, 0};
    case H5FD_MEM_BTREE:
      return file.index_nodes.contains(address) ? std::tuple{2, -node_level(piece)} : std::tuple{1, 0};
    case H5FD_MEM_OHDR:
      return {4, 0};
    default:
      return {3, 0};
  }
}

/// Ends a flush: writes all metadata to the file, in an order that keeps it readable if the program is killed midway.
herr_t commit(H5FD_t* base, hid_t, hbool_t) {
  ReservedFile& file = self(base);
  std::map<std::tuple<std::tuple<int, int>, haddr_t>, const Piece*> ordered;
  for (const auto& [address, piece] : file.waiting) ordered[{rank(file, address, piece), address}] = &piece;
  for (const auto& [key, piece] : ordered) write_now(file, std::get<1>(key), piece->bytes.data(), piece->bytes.size());
  for (const auto& [address, piece] : file.waiting)
    if (piece.type == H5FD_MEM_BTREE) file.index_nodes.insert(address);
  file.waiting.clear();
  return 0;
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<ReservedFile> file(&self(base));
  commit(base, H5P_DEFAULT, true);
  if (!file->status->failed && fdatasync(file->fd) != 0 && errno != EINVAL) fail(*file, errno);
  if (close(file->fd) != 0) fail(*file, errno);
  return 0;
}

/// Gives back what was reserved and not used. HDF5 calls it with every flush: only the last one counts.
herr_t truncate_file(H5FD_t* base, hid_t, hbool_t closing) {
  ReservedFile& file = self(base);
  if (!closing || file.status->failed) return 0;
  if (ftruncate(file.fd, static_cast<off_t>(file.eoa)) != 0) fail(file, errno);
  file.reserved = file.eoa;
  return 0;
}

constexpr H5FD_class_t make_class() {
  H5FD_class_t driver{};
  driver.name = "hersey-reserving";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Info);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query;
  driver.alloc = allocate;
  driver.get_eoa = get_eoa;
  driver.set_eoa = set_eoa;
  driver.get_eof = get_eof;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.flush = commit;
  driver.truncate = truncate_file;
  for (H5FD_mem_t& type : driver.fl_map) type = H5FD_MEM_DEFAULT;
  return driver;
}

constexpr H5FD_class_t driver_class = make_class();

}  // namespace

bool use_reserving_driver(hid_t access, int fd, DriverStatus& status) {
  static const hid_t driver = H5FDregister(&driver_class);
  const Info info{fd, &status};
  return driver >= 0 && H5Pset_driver(access, driver, &info) >= 0;
}

}  // namespace hersey::results
