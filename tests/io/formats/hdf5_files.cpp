// Files of HDF5 and of MATLAB 7.3, which is HDF5 behind a head of MATLAB's: written by the HDF5 library itself, as
// recorders and MATLAB do it (chunked, compressed, of either byte order, single numbers and integers, texts of both
// kinds as units, structures as groups, arrays of structures as references).
#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "tests/io/formats/instrument_files.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::instruments {
namespace {

using Sizes = std::vector<hsize_t>;

/// The bytes of a file of HDF5 that `write` fills; behind 512 bytes for others where `for_matlab`.
std::string hdf5_bytes(bool for_matlab, const std::function<void(hid_t)>& write) {
  const TemporaryFolder folder;
  const std::string name = folder.path("x");
  const hid_t made = H5Pcreate(H5P_FILE_CREATE);
  if (for_matlab) H5Pset_userblock(made, 512);
  const hid_t file = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, made, H5P_DEFAULT);
  write(file);
  H5Fclose(file);
  H5Pclose(made);
  return TemporaryFolder::read(name);
}

void text_attribute(hid_t at, const char* name, const std::string& text, bool variable) {
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  const char* pointer = text.c_str();
  H5Tset_size(type, variable ? H5T_VARIABLE : text.size());
  const hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, variable ? static_cast<const void*>(&pointer) : pointer);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

/// A dataset in chunks, compressed; returned open.
hid_t dataset(hid_t at, const char* name, const std::vector<double>& values, const Sizes& sizes, hid_t stored) {
  const auto rank = static_cast<int>(sizes.size());
  const hid_t space = H5Screate_simple(rank, sizes.data(), nullptr), made = H5Pcreate(H5P_DATASET_CREATE);
  Sizes chunk = sizes;
  for (auto& size : chunk) size = std::min<hsize_t>(size, 16);  // the last one is not full
  H5Pset_chunk(made, rank, chunk.data());
  H5Pset_shuffle(made);
  H5Pset_deflate(made, 3);
  const hid_t set = H5Dcreate2(at, name, stored, space, H5P_DEFAULT, made, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Pclose(made);
  H5Sclose(space);
  return set;
}

struct Stored {
  hid_t drive, response;
  std::string unit;
  double times = 1;  // of the numbers as they are stored
};

std::string recording(const Stored& as) {
  return hdf5_bytes(false, [&](hid_t file) {
    const hid_t group = H5Gcreate2(file, "run", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t t = dataset(group, "time", samples(time_of), {rows}, H5T_IEEE_F64BE);
    text_attribute(t, "units", "s", false);
    const hid_t u = dataset(group, "drive", samples(drive, as.times), {rows, 1}, as.drive);
    text_attribute(u, "unit", as.unit, true);
    const hid_t y = dataset(group, "response", samples(response, as.times), {1, rows}, as.response);
    text_attribute(y, "unit", as.unit, false);
    for (const hid_t set : {t, u, y}) H5Dclose(set);
    H5Gclose(group);
  });
}

// Single precision: half of the last of 24 bits of a number between 8 V and 16 V, 2^-21 V. Integers of mV: cut to the
// next one towards 0.
InstrumentFile recorder(const char* name, const Stored& as, double half_digit) {
  return {name, recording(as), "drive", "response", "V", 0, half_digit, {"an HDF5 file"}};
}

/// MAT-File Level 7.3: 512 bytes, of which 116 are a text, then the version 0x0200 and "IM".
std::string with_head(std::string bytes) {
  std::string head = "MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Thu May  2 09:10:11 2024 HDF5 schema 1.00 .";
  head.resize(116, ' ');
  head += std::string(8, '\0') + std::string("\x00\x02", 2) + "IM";
  return bytes.replace(0, head.size(), head);
}

/// A column of N rows is a dataset of 1 x N; the class of each stands in an attribute.
hobj_ref_t matlab_vector(hid_t at, const char* name, const std::vector<double>& values, hid_t stored,
                         const char* kind) {
  const hid_t set = dataset(at, name, values, {1, values.size()}, stored);
  text_attribute(set, "MATLAB_class", kind, false);
  H5Dclose(set);
  hobj_ref_t reference = 0;
  H5Rcreate(&reference, at, name, H5R_OBJECT, -1);
  return reference;
}
hobj_ref_t matlab_text(hid_t at, const char* name, const std::string& text) {
  const hid_t set = dataset(at, name, {text.begin(), text.end()}, {text.size(), 1}, H5T_STD_U16LE);
  text_attribute(set, "MATLAB_class", "char", false);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t decode = H5Acreate2(set, "MATLAB_int_decode", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
  const int two = 2;
  H5Awrite(decode, H5T_NATIVE_INT, &two);
  H5Aclose(decode);
  H5Sclose(space);
  H5Dclose(set);
  hobj_ref_t reference = 0;
  H5Rcreate(&reference, at, name, H5R_OBJECT, -1);
  return reference;
}
void references(hid_t at, const char* name, const std::vector<hobj_ref_t>& list) {
  const Sizes sizes{list.size(), 1};
  const hid_t space = H5Screate_simple(2, sizes.data(), nullptr);
  const hid_t set = H5Dcreate2(at, name, H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, list.data());
  H5Dclose(set);
  H5Sclose(space);
}

/// A structure is a group. MATLAB writes the order of its fields, one array of letters each; others do not.
hid_t matlab_structure(hid_t at, const char* name, const std::vector<std::string>& fields) {
  const hid_t group = H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  text_attribute(group, "MATLAB_class", "struct", false);
  if (fields.empty()) return group;
  const hid_t letter = H5Tcopy(H5T_C_S1), type = H5Tvlen_create(letter);
  const Sizes sizes{fields.size()};
  const hid_t space = H5Screate_simple(1, sizes.data(), nullptr);
  const hid_t attribute = H5Acreate2(group, "MATLAB_fields", type, space, H5P_DEFAULT, H5P_DEFAULT);
  std::vector<hvl_t> names;
  for (const auto& field : fields) names.push_back({field.size(), const_cast<char*>(field.data())});
  H5Awrite(attribute, type, names.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  H5Tclose(letter);
  return group;
}

InstrumentFile matlab_73() {
  const std::string bytes = hdf5_bytes(true, [](hid_t file) {
    matlab_vector(file, "t", samples(time_of), H5T_IEEE_F64LE, "double");
    matlab_vector(file, "u", samples(drive), H5T_IEEE_F64LE, "double");
    matlab_vector(file, "y", samples(response), H5T_IEEE_F32LE, "single");
    matlab_text(file, "comment", std::string(rows, 'x'));  // as long as the recording, and no signal of it
  });
  return {"v73.mat", with_head(bytes), "u", "y", "", 0, 4.8e-7, {"a MAT file"}};
}

InstrumentFile matlab_73_structure(const char* name, const std::vector<std::string>& fields) {
  const std::string bytes = hdf5_bytes(true, [&](hid_t file) {
    const hid_t group = matlab_structure(file, "rec", fields);
    matlab_vector(group, "t", samples(time_of), H5T_IEEE_F64LE, "double");
    matlab_vector(group, "drive", samples(drive), H5T_IEEE_F64LE, "double");
    matlab_vector(group, "sensor", samples(response), H5T_IEEE_F64LE, "double");
    H5Gclose(group);
  });
  return {name, with_head(bytes), "drive", "sensor", "", 0, 1e-12, {"a MAT file"}};
}

/// "Structure with time" of Simulink: signals is an array of structures, each field of which refers to elsewhere.
InstrumentFile simulink_73() {
  const std::string bytes = hdf5_bytes(true, [](hid_t file) {
    const hid_t elsewhere = H5Gcreate2(file, "#refs#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const auto values = {matlab_vector(elsewhere, "a", samples(drive), H5T_IEEE_F64LE, "double"),
                         matlab_vector(elsewhere, "b", samples(response), H5T_IEEE_F64LE, "double")};
    const auto labels = {matlab_text(elsewhere, "c", "drive"), matlab_text(elsewhere, "d", "sensor")};
    const hid_t out = matlab_structure(file, "out", {"time", "signals"});
    matlab_vector(out, "time", samples(time_of), H5T_IEEE_F64LE, "double");
    const hid_t signals = matlab_structure(out, "signals", {"values", "label"});
    references(signals, "values", values);
    references(signals, "label", labels);
    for (const hid_t group : {signals, out, elsewhere}) H5Gclose(group);
  });
  return {"simulink73.mat", with_head(bytes), "drive", "sensor", "", 0, 1e-12, {"a MAT file"}};
}

}  // namespace

std::vector<InstrumentFile> hdf5_files() {
  // As the program before its first file (hdf5_library.cpp), which this may come before: one whose disk was full
  // cannot be closed at the end.
  H5dont_atexit();
  return {recorder("little_endian.h5", {H5T_IEEE_F64LE, H5T_IEEE_F32LE, "V"}, 4.8e-7),
          recorder("big_endian.h5", {H5T_IEEE_F64BE, H5T_IEEE_F32BE, "V"}, 4.8e-7),
          recorder("integers.h5", {H5T_STD_I32BE, H5T_STD_I16LE, "mV", 1000}, 1.0001e-3),
          matlab_73(),
          matlab_73_structure("structure73.mat", {"t", "drive", "sensor"}),
          matlab_73_structure("without_order73.mat", {}),
          simulink_73()};
}

}  // namespace hysteron::instruments
