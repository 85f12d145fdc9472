// SPDX-License-Identifier: MIT
#include <hearth/io/hdf5_file.hpp>

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numeric>
#include <utility>

namespace hearth::io {
namespace {

/// Closes an HDF5 handle when it goes out of sight.
class handle {
  public:
    handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    handle(const handle&) = delete;
    handle& operator=(const handle&) = delete;
    ~handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

template <class Value> hid_t memory_type();
template <> hid_t memory_type<double>() { return H5T_NATIVE_DOUBLE; }
template <> hid_t memory_type<float>() { return H5T_NATIVE_FLOAT; }
template <> hid_t memory_type<std::int64_t>() { return H5T_NATIVE_INT64; }
template <> hid_t memory_type<std::int32_t>() { return H5T_NATIVE_INT32; }
template <> hid_t memory_type<std::uint8_t>() { return H5T_NATIVE_UINT8; }

/// Keeps HDF5 from printing: what went wrong is told in our own error.
struct quiet {
    quiet() {
        H5Eget_auto2(H5E_DEFAULT, &print, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~quiet() { H5Eset_auto2(H5E_DEFAULT, print, data); }
    H5E_auto2_t print;
    void* data;
};

/// The innermost cause on HDF5's stack of errors.
std::string cause() {
    std::string text;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD,
             [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
                 if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
                 return 0;
             },
             &text);
    return text.empty() ? "unknown cause" : text;
}

/// Ends a checksummed file, after what HDF5 wrote, which does not look there.
struct trailer {
    char magic[8] = {'h', 'e', 'a', 'r', 't', 'h', 0, 1};
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;
};

/// FNV-1a over words of eight bytes, goes on from `value`.
std::uint64_t checksum(std::uint64_t value, const char* data, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; k += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, data + k, std::min<std::size_t>(8, bytes - k));
        value = (value ^ word) * 1099511628211U;
        value ^= value >> 29;  // high bits reach the low ones, which a product alone never does
    }
    return value;
}

std::uint64_t checksum_start(std::uint64_t bytes) { return 14695981039346656037U ^ bytes; }

/// Of the first `bytes` of a file; a file that ends before gives 0.
std::uint64_t checksum(std::FILE* file, std::uint64_t bytes) {
    std::uint64_t value = checksum_start(bytes);
    std::vector<char> buffer(std::size_t{1} << 22);
    while (bytes > 0) {
        const auto want = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, buffer.size()));
        if (std::fread(buffer.data(), 1, want, file) != want) return 0;
        value = checksum(value, buffer.data(), want);
        bytes -= want;
    }
    return value;
}

struct closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using file_pointer = std::unique_ptr<std::FILE, closer>;

/// Appends the trailer and sees that all is on the disk.
bool seal(const std::string& path) {
    const file_pointer file(std::fopen(path.c_str(), "r+b"));
    if (!file || std::fseek(file.get(), 0, SEEK_END) != 0) return false;
    trailer end;
    end.bytes = static_cast<std::uint64_t>(std::ftell(file.get()));
    std::rewind(file.get());
    end.checksum = checksum(file.get(), end.bytes);
    std::fseek(file.get(), 0, SEEK_END);
    return std::fwrite(&end, sizeof end, 1, file.get()) == 1 && std::fflush(file.get()) == 0 && fsync(fileno(file.get())) == 0;
}

/// Writes the bytes of a whole file, with its trailer where it is to be sealed, and sees that all is on the disk.
bool put(const std::string& path, const std::vector<char>& image, bool sealed) {
    file_pointer file(std::fopen(path.c_str(), "wb"));
    if (!file) return false;
    trailer end;
    end.bytes = image.size();
    end.checksum = checksum(checksum_start(end.bytes), image.data(), image.size());
    return std::fwrite(image.data(), 1, image.size(), file.get()) == image.size() &&
           (!sealed || std::fwrite(&end, sizeof end, 1, file.get()) == 1) && std::fflush(file.get()) == 0 &&
           fsync(fileno(file.get())) == 0 && std::fclose(file.release()) == 0;
}

/// What is wrong with a checksummed file, or nothing.
std::string check_seal(const std::string& path) {
    const file_pointer file(std::fopen(path.c_str(), "rb"));
    if (!file) return std::string("cannot be opened: ") + std::strerror(errno);
    trailer end, expected;
    std::fseek(file.get(), 0, SEEK_END);
    const long size = std::ftell(file.get());
    if (size < static_cast<long>(sizeof end)) return "is too short to be a checkpoint";
    std::fseek(file.get(), -static_cast<long>(sizeof end), SEEK_END);
    if (std::fread(&end, sizeof end, 1, file.get()) != 1) return std::string("cannot be read: ") + std::strerror(errno);
    if (std::memcmp(end.magic, expected.magic, sizeof end.magic) != 0) return "is no checkpoint, or one that was cut off";
    if (end.bytes + sizeof end != static_cast<std::uint64_t>(size)) return "is damaged: its size is not what was written";
    std::rewind(file.get());
    return checksum(file.get(), end.bytes) == end.checksum ? "" : "is damaged: its checksum is not what was written";
}

std::string part(const std::string& path) { return path + ".part"; }

std::pair<hsize_t, hsize_t> even_share(hsize_t rows, int rank, int size) {
    const auto r = static_cast<hsize_t>(rank), n = static_cast<hsize_t>(size);
    return {rows * r / n, rows * (r + 1) / n};
}

std::string rows_name(const std::string& name) { return name + ".rows_per_rank"; }

}  // namespace

hdf5_file::hdf5_file(const std::string& path, mode access, MPI_Comm ranks) : path_(path), mode_(access), ranks_(ranks) {
    MPI_Comm_rank(ranks_, &rank_);
    MPI_Comm_size(ranks_, &size_);
    const quiet no_printing;
    if (reads()) {
        // MPI-IO says little about a file that is not there, so ask the system first.
        const file_pointer probe(std::fopen(path_.c_str(), "rb"));
        agree(!probe, std::string("cannot be opened: ") + std::strerror(errno));
        const std::string wrong = mode_ == mode::read_checksummed && rank_ == 0 ? check_seal(path_) : "";
        agree(!wrong.empty(), wrong);
        agree(H5Fis_hdf5(path_.c_str()) <= 0, "is not an HDF5 file");
    }
    const handle access_list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (size_ > 1) {
        H5Pset_fapl_mpio(access_list, ranks_, MPI_INFO_NULL);
    } else if (!reads()) {
        // Made in memory: HDF5 does not get over a disk that is full.  That there is a place for it is seen here.
        const file_pointer probe(std::fopen(part(path_).c_str(), "wb"));
        agree(!probe, std::string("cannot be opened: ") + std::strerror(errno));
        H5Pset_fapl_core(access_list, std::size_t{1} << 24, false);
    }
    if (reads()) {
        file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access_list);
    } else {
        file_ = H5Fcreate(part(path_).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_list);
    }
    if (file_ < 0) fail("cannot be opened: " + cause());
}

hdf5_file::~hdf5_file() { abandon(); }

void hdf5_file::abandon() {
    if (file_ < 0) return;
    const quiet no_printing;
    H5Fclose(std::exchange(file_, -1));
    if (!reads() && rank_ == 0) std::remove(part(path_).c_str());
}

void hdf5_file::close() {
    const quiet no_printing;
    bool failed = H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0;
    std::string why = failed ? cause() : "";
    std::vector<char> image;
    if (size_ == 1 && !reads()) {
        image.resize(static_cast<std::size_t>(std::max<ssize_t>(0, H5Fget_file_image(file_, nullptr, 0))));
        failed = H5Fget_file_image(file_, image.data(), image.size()) < 0 || image.empty() || failed;
    }
    failed = H5Fclose(std::exchange(file_, -1)) < 0 || failed;
    if (reads()) return;
    if (size_ == 1) {
        failed = failed || !put(part(path_), image, mode_ == mode::write_checksummed);
        failed = failed || std::rename(part(path_).c_str(), path_.c_str()) != 0;
        if (failed && why.empty()) why = std::strerror(errno);
        if (failed) std::remove(part(path_).c_str());
        agree(failed, "cannot be written: " + why);
        return;
    }
    int any = failed ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, ranks_);
    if (rank_ == 0) {
        if (any != 0) {
            std::remove(part(path_).c_str());
        } else {
            failed = (mode_ == mode::write_checksummed && !seal(part(path_))) ||
                     std::rename(part(path_).c_str(), path_.c_str()) != 0;
        }
    }
    agree(failed || any != 0, "cannot be completed (is the disk full?): " + (why.empty() ? std::strerror(errno) : why));
}

void hdf5_file::fail(const std::string& what) const { throw file_error(path_ + ": " + what); }

void hdf5_file::agree(bool failed, const std::string& what) const {
    int any = failed ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, ranks_);
    if (any != 0) fail(failed ? what : "another rank failed on this file");
}

template <class Value>
void hdf5_file::write(const std::string& name, const std::vector<Value>& values, std::size_t columns) {
    const quiet no_printing;
    if (values.size() % columns != 0) throw std::logic_error(name + ": not a whole number of rows");
    std::vector<std::int64_t> counts(static_cast<std::size_t>(size_));
    const auto mine = static_cast<std::int64_t>(values.size() / columns);
    MPI_Allgather(&mine, 1, MPI_INT64_T, counts.data(), 1, MPI_INT64_T, ranks_);
    const auto first = static_cast<hsize_t>(std::accumulate(counts.begin(), counts.begin() + rank_, std::int64_t{0}));
    const auto rows = static_cast<hsize_t>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
    const int dimensions = columns == 1 ? 1 : 2;
    const hsize_t all[2] = {rows, columns};
    const hsize_t start[2] = {first, 0};
    const hsize_t count[2] = {static_cast<hsize_t>(mine), columns};
    const handle file_space(H5Screate_simple(dimensions, all, nullptr), H5Sclose);
    const handle memory_space(H5Screate_simple(dimensions, count, nullptr), H5Sclose);
    const handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const handle set(H5Dcreate2(file_, name.c_str(), memory_type<Value>(), file_space, links, H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
    agree(set < 0, name + " cannot be created: " + (set < 0 ? cause() : ""));
    if (rows > 0) {
        H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr);
        if (mine == 0) {
            H5Sselect_none(file_space);
            H5Sselect_none(memory_space);
        }
        const handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
        if (size_ > 1) H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
        const bool failed = H5Dwrite(set, memory_type<Value>(), memory_space, file_space, transfer, values.data()) < 0;
        agree(failed, name + " cannot be written (is the disk full?): " + (failed ? cause() : ""));
    }
    if (mode_ == mode::write_checksummed && name.find(".rows_per_rank") == std::string::npos) {
        write(rows_name(name), std::vector<std::int64_t>{mine});
    }
}

template <class Value>
std::vector<Value> hdf5_file::read(const std::string& name, std::size_t columns) const {
    const quiet no_printing;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    agree(set < 0, "has no " + name);
    const handle file_space(H5Dget_space(set), H5Sclose);
    hsize_t all[2] = {0, 1};
    const int dimensions = H5Sget_simple_extent_ndims(file_space);
    if (dimensions < 1 || dimensions > 2) fail(name + " is not an array of rows");
    H5Sget_simple_extent_dims(file_space, all, nullptr);
    if (all[1] != columns) {
        fail(name + " has " + std::to_string(all[1]) + " columns, expected: " + std::to_string(columns));
    }
    auto [first, last] = even_share(all[0], rank_, size_);
    if (has(rows_name(name))) {
        const auto counts = read_all<std::int64_t>(rows_name(name));
        if (counts.size() == static_cast<std::size_t>(size_)) {
            first = static_cast<hsize_t>(std::accumulate(counts.begin(), counts.begin() + rank_, std::int64_t{0}));
            last = first + static_cast<hsize_t>(counts[static_cast<std::size_t>(rank_)]);
        }
    }
    if (last < first || last > all[0]) fail(name + " holds fewer rows than its ranks wrote");
    const hsize_t start[2] = {first, 0};
    const hsize_t count[2] = {last - first, columns};
    const handle memory_space(H5Screate_simple(dimensions, count, nullptr), H5Sclose);
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr);
    if (last == first) {
        H5Sselect_none(file_space);
        H5Sselect_none(memory_space);
    }
    std::vector<Value> values(static_cast<std::size_t>(last - first) * columns);
    const handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    if (size_ > 1) H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
    // An array without rows has no place in the file.
    const bool failed =
        all[0] > 0 && H5Dread(set, memory_type<Value>(), memory_space, file_space, transfer, values.data()) < 0;
    agree(failed, name + " cannot be read: " + (failed ? cause() : ""));
    return values;
}

template <class Value>
std::vector<Value> hdf5_file::read_all(const std::string& name) const {
    const quiet no_printing;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    agree(set < 0, "has no " + name);
    const handle space(H5Dget_space(set), H5Sclose);
    std::vector<Value> values(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0)));
    const bool failed =
        !values.empty() && H5Dread(set, memory_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0;
    agree(failed, name + " cannot be read: " + (failed ? cause() : ""));
    return values;
}

bool hdf5_file::has(const std::string& name) const {
    const quiet no_printing;
    for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
        if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
        if (slash == std::string::npos) return true;
    }
}

std::int64_t hdf5_file::open_group(const std::string& name) {
    if (has(name)) return H5Gopen2(file_, name.c_str(), H5P_DEFAULT);
    const handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    return H5Gcreate2(file_, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT);
}

void hdf5_file::write_attribute(const std::string& group, const std::string& name, const std::string& text) {
    const quiet no_printing;
    const handle place(open_group(group), H5Gclose);
    const handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const handle attribute(H5Acreate2(place, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const bool failed = attribute < 0 || H5Awrite(attribute, type, text.empty() ? "\0" : text.data()) < 0;
    agree(failed, group + "/" + name + " cannot be written: " + (failed ? cause() : ""));
}

void hdf5_file::write_attribute(const std::string& group, const std::string& name,
                                const std::vector<std::int64_t>& numbers) {
    const quiet no_printing;
    const handle place(open_group(group), H5Gclose);
    const hsize_t count = numbers.size();
    const handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    const handle attribute(H5Acreate2(place, name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const bool failed = attribute < 0 || H5Awrite(attribute, H5T_NATIVE_INT64, numbers.data()) < 0;
    agree(failed, group + "/" + name + " cannot be written: " + (failed ? cause() : ""));
}

std::string hdf5_file::read_text_attribute(const std::string& group, const std::string& name) const {
    const quiet no_printing;
    const handle place(H5Oopen(file_, group.c_str(), H5P_DEFAULT), H5Oclose);
    agree(place < 0 || H5Aexists(place, name.c_str()) <= 0, "has no attribute " + group + "/" + name);
    const handle attribute(H5Aopen(place, name.c_str(), H5P_DEFAULT), H5Aclose);
    const handle type(H5Aget_type(attribute), H5Tclose);
    std::string text(H5Tget_size(type), '\0');
    agree(H5Aread(attribute, type, text.data()) < 0, group + "/" + name + " is damaged");
    text.resize(std::min(text.size(), text.find('\0')));
    return text;
}

#define HEARTH_IO_INSTANTIATE(Value)                                                                       \
    template void hdf5_file::write(const std::string&, const std::vector<Value>&, std::size_t);           \
    template std::vector<Value> hdf5_file::read(const std::string&, std::size_t) const;                   \
    template std::vector<Value> hdf5_file::read_all(const std::string&) const;
HEARTH_IO_INSTANTIATE(double)
HEARTH_IO_INSTANTIATE(float)
HEARTH_IO_INSTANTIATE(std::int64_t)
HEARTH_IO_INSTANTIATE(std::int32_t)
HEARTH_IO_INSTANTIATE(std::uint8_t)
#undef HEARTH_IO_INSTANTIATE

}  // namespace hearth::io
