// Decides how the HDF5 library is reached: loaded when the first file needs it, since loading it with the program would
// double the start of every verb. Internal to io.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

namespace hysteron {

// Every function that is called, by its name in the library.
#define HYSTERON_HDF5_FUNCTIONS(X)                                                                                     \
  X(H5open)                                                                                                            \
  X(H5dont_atexit)                                                                                                     \
  X(H5Eset_auto2)                                                                                                      \
  X(H5Fcreate)                                                                                                         \
  X(H5Fopen)                                                                                                           \
  X(H5Fclose)                                                                                                          \
  X(H5Pcreate)                                                                                                         \
  X(H5Pclose) X(H5Pset_chunk) X(H5Pset_obj_track_times) X(H5Pset_file_locking) X(H5Pset_fletcher32) X(H5Screate)       \
      X(H5Screate_simple) X(H5Sclose) X(H5Sselect_hyperslab) X(H5Sget_simple_extent_npoints) X(H5Dcreate2) X(H5Dopen2) \
          X(H5Dclose) X(H5Dwrite) X(H5Dread) X(H5Dset_extent) X(H5Dget_space) X(H5Acreate2) X(H5Aopen) X(H5Aexists)    \
              X(H5Awrite) X(H5Aread) X(H5Aclose) X(H5Aget_space) X(H5Aget_type) X(H5Tcopy) X(H5Tset_size)              \
                  X(H5Tget_size) X(H5Tget_class) X(H5Tclose) X(H5Gget_info) X(H5Gclose) X(H5Lget_name_by_idx)          \
                      X(H5Oopen) X(H5Oclose) X(H5Iget_type) X(H5Sget_simple_extent_ndims) X(H5Sget_simple_extent_dims) \
                          X(H5Dget_type) X(H5Dget_storage_size) X(H5Tis_variable_str) X(H5free_memory)                 \
                              X(H5Rdereference2) X(H5Oget_info2)

/// An open thing of the library, closed with its function. The mutex is held by whoever has one.
class Hdf5Id {
 public:
  Hdf5Id(hid_t id, herr_t (*closing)(hid_t)) : id_(id), close_(closing) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&&) = delete;
  ~Hdf5Id() { close(); }
  operator hid_t() const { return id_; }  // NOLINT: as the library takes it
  bool good() const { return id_ >= 0; }
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The functions, and the numbers by which the library calls its types and lists of properties.
struct Hdf5Library {
#define HYSTERON_DECLARE(name) decltype(&::name) name = nullptr;
  HYSTERON_HDF5_FUNCTIONS(HYSTERON_DECLARE)
#undef HYSTERON_DECLARE
  hid_t real = 0, whole = 0, text = 0, reference = 0;
  hid_t file_creation = 0, file_access = 0, dataset_creation = 0;
};

/// Throws Error "no_hdf5" where it cannot be loaded.
const Hdf5Library& hdf5();

/// The library is not made for threads: hold this while it is called.
std::mutex& hdf5_mutex();

}  // namespace hysteron
