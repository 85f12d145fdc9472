// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// Files that several ranks write together: checkpoints that restart a run, and pictures for ParaView.
namespace hearth::io {

/// A file cannot be written or read: names the file, the place in it and the cause.  Thrown on every rank.
struct file_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An HDF5 file of named arrays.  Rows of an array are spread over the ranks, in order of rank.
///
/// A file that is being written has the ending `.part`; close() flushes it, and rank 0 renames it, so that a run that is
/// killed leaves the file that was there before, or the new one, never a broken one.  A checksummed file that was damaged
/// or cut off is refused, with what is wrong, before anything of it is used.
class hdf5_file {
  public:
    enum class mode {
        read,              ///< an existing file
        read_checksummed,  ///< an existing file that must be, to the last byte, what was written
        write,             ///< a new file
        write_checksummed  ///< a new file that ends with a checksum of all its bytes
    };

    hdf5_file(const std::string& path, mode access, MPI_Comm ranks = MPI_COMM_WORLD);
    /// A file that is not closed is given up: its `.part` is removed.
    ~hdf5_file();
    hdf5_file(const hdf5_file&) = delete;
    hdf5_file& operator=(const hdf5_file&) = delete;

    /// Flushes, closes and puts the file in its place.
    void close();

    /// Writes rows of `columns` numbers each; this rank's rows follow those of the ranks below it.  Value is double, float,
    /// std::int64_t, std::int32_t or std::uint8_t.  Groups in the name are made.
    template <class Value>
    void write(const std::string& name, const std::vector<Value>& values, std::size_t columns = 1);

    /// Reads this rank's share of the rows: those that it wrote where as many ranks read as wrote, else an even split.
    template <class Value>
    std::vector<Value> read(const std::string& name, std::size_t columns = 1) const;

    /// Reads all rows on every rank.
    template <class Value>
    std::vector<Value> read_all(const std::string& name) const;

    bool has(const std::string& name) const;

    /// Attributes of a group: a text of fixed length, or whole numbers.
    void write_attribute(const std::string& group, const std::string& name, const std::string& text);
    void write_attribute(const std::string& group, const std::string& name, const std::vector<std::int64_t>& numbers);
    std::string read_text_attribute(const std::string& group, const std::string& name) const;

  private:
    bool reads() const { return mode_ == mode::read || mode_ == mode::read_checksummed; }
    [[noreturn]] void fail(const std::string& what) const;
    /// Throws on every rank where it failed on any.
    void agree(bool failed, const std::string& what) const;
    std::int64_t open_group(const std::string& name);
    void abandon();

    std::string path_;
    mode mode_;
    MPI_Comm ranks_;
    int rank_ = 0;
    int size_ = 1;
    std::int64_t file_ = -1;
};

}  // namespace hearth::io
