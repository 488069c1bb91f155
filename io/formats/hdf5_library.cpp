#include "io/formats/hdf5_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <stdlib.h>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

[[noreturn]] void cannot_load(const std::string& why) {
  fail("no_hdf5", HYSTERON_HDF5_LIBRARY, fmt::format("the HDF5 library cannot be loaded: {}", why),
       "install it (Debian: libhdf5-103-1)");
}

void* symbol(void* library, const char* name) {
  void* found = dlsym(library, name);
  if (found == nullptr) cannot_load(fmt::format("it has no {}", name));
  return found;
}

Hdf5Library load() {
  void* library = dlopen(HYSTERON_HDF5_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) cannot_load(dlerror());
  Hdf5Library h;
#define HYSTERON_FIND(name) h.name = reinterpret_cast<decltype(h.name)>(symbol(library, #name));
  HYSTERON_HDF5_FUNCTIONS(HYSTERON_FIND)
#undef HYSTERON_FIND
  // A file whose disk is full cannot be closed; at the end of the program the library would try it once more, and
  // crash.
  h.H5dont_atexit();
  // Its own locks would meet those of atomic_file.h, whatever the file properties say, if the user has asked for them.
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  if (h.H5open() < 0) cannot_load("it does not start");
  // A program that is itself linked with HDF5 may hold these variables in place of the library (copy relocations),
  // whose own are then never set.
  const auto number = [&](const char* name) {
    const hid_t of_library = *static_cast<hid_t*>(symbol(library, name));
    const void* of_program = of_library > 0 ? nullptr : dlsym(RTLD_DEFAULT, name);
    return of_program == nullptr ? of_library : *static_cast<const hid_t*>(of_program);
  };
  h.real = number("H5T_IEEE_F64LE_g");
  h.whole = number("H5T_STD_I64LE_g");
  h.text = number("H5T_C_S1_g");
  h.reference = number("H5T_STD_REF_OBJ_g");
  h.file_creation = number("H5P_CLS_FILE_CREATE_ID_g");
  h.file_access = number("H5P_CLS_FILE_ACCESS_ID_g");
  h.dataset_creation = number("H5P_CLS_DATASET_CREATE_ID_g");
  return h;
}

}  // namespace

const Hdf5Library& hdf5() {
  static const Hdf5Library library = load();
  // What fails is told by us. Each thread has errors of its own.
  [[maybe_unused]] thread_local const herr_t silent = library.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return library;
}

std::mutex& hdf5_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace hysteron
