// Decides how a MAT file of level 7.3 is read, which is HDF5: the class of a variable is an attribute of its dataset,
// structures are groups, arrays of structures groups of references (MathWorks says so of save -v7.3, not how; as
// MATLAB R2012b and later write it, and others who follow it).
#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "io/files/child_read.h"
#include "io/formats/hdf5_library.h"
#include "io/formats/hdf5_values.h"
#include "io/formats/mat_pipe.h"
#include "io/formats/mat_value.h"

namespace hysteron {
namespace {

constexpr char cure_of_mat73[] = "save it again, with -v7";

/// hdf5_mutex() is held by the caller.
class Mat73Reader {
 public:
  explicit Mat73Reader(const std::string& file) : file_(file), h_(hdf5()) {}

  MatVariables read() {
    const Hdf5Id access(h_.H5Pcreate(h_.file_access), h_.H5Pclose);
    h_.H5Pset_file_locking(access, false, true);
    const Hdf5Id file(h_.H5Fopen(file_.c_str(), 0, access), h_.H5Fclose);
    if (!file.good()) damaged("it cannot be opened");
    MatVariables variables;
    each_hdf5_object(file, most_hdf5_objects, [&](const std::string& name, hid_t object) {
      if (!name.starts_with('#')) variables.emplace_back(name, value(object, name, 0));  // #refs#, #subsystem#
    });
    return variables;
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(Fault::input, {{"damaged_file", file_, fmt::format("this MAT file cannot be read: {}", why),
                                cure_of_mat73, file_, 0}});
  }

  MatValue value(hid_t object, const std::string& name, int depth) {
    if (depth > deepest_of_mat || ++seen_ > most_hdf5_objects) return {};
    const auto kind = h_.H5Iget_type(object);
    if (kind == H5I_GROUP) return structure(object, name, depth);
    if (kind != H5I_DATASET) return {};
    if (h_.H5Aexists(object, "MATLAB_object_decode") > 0) return {MatValue::Kind::object};
    if (h_.H5Aexists(object, "MATLAB_empty") > 0) return {};
    const auto numbers = numbers_of_hdf5(object, 4, [&](const std::string& why) { damaged(name + ": " + why); });
    if (!numbers) return {};
    MatValue v;
    if (hdf5_text_attribute(object, "MATLAB_class") == "char") {
      v.kind = MatValue::Kind::text;
      for (const double c : numbers->values) v.text += c > 0 && c < 128 ? static_cast<char>(c) : '?';
      return v;
    }
    v.kind = MatValue::Kind::numbers;
    v.sizes.assign(numbers->sizes.rbegin(), numbers->sizes.rend());
    v.values = numbers->values;
    return v;
  }

  MatValue structure(hid_t group, const std::string& name, int depth) {
    MatValue v;
    if (h_.H5Aexists(group, "MATLAB_sparse") > 0) return v;
    if (h_.H5Aexists(group, "MATLAB_object_decode") > 0) return {MatValue::Kind::object};
    v.kind = MatValue::Kind::structure;
    each_hdf5_object(group, most_hdf5_objects, [&](const std::string& field, hid_t object) {
      std::vector<MatValue> of_element = referred(object, name + "." + field, depth);
      if (of_element.empty()) of_element.push_back(value(object, name + "." + field, depth + 1));
      v.elements = std::max(v.elements, of_element.size());
      v.fields.push_back({field, std::move(of_element)});
    });
    return v;
  }

  /// What a field of an array of structures refers to; a cell array, which looks alike but for its class, is none.
  std::vector<MatValue> referred(hid_t object, const std::string& name, int depth) {
    std::vector<MatValue> list;
    if (h_.H5Iget_type(object) != H5I_DATASET || h_.H5Aexists(object, "MATLAB_class") > 0) return list;
    const Hdf5Id type(h_.H5Dget_type(object), h_.H5Tclose), space(h_.H5Dget_space(object), h_.H5Sclose);
    const auto count = h_.H5Sget_simple_extent_npoints(space);
    if (h_.H5Tget_class(type) != H5T_REFERENCE || h_.H5Tget_size(type) != sizeof(hobj_ref_t)) return list;
    if (count <= 0 || count > static_cast<hssize_t>(most_elements_of_mat)) return list;
    std::vector<hobj_ref_t> references(static_cast<std::size_t>(count));
    if (h_.H5Dread(object, h_.reference, 0, 0, 0, references.data()) < 0) return list;
    for (const auto& reference : references) {
      const Hdf5Id to(h_.H5Rdereference2(object, 0, H5R_OBJECT, &reference), h_.H5Oclose);
      list.push_back(to.good() ? value(to, name, depth + 1) : MatValue{});
    }
    return list;
  }

  const std::string& file_;
  const Hdf5Library& h_;
  std::size_t seen_ = 0;
};

}  // namespace

MatVariables variables_of_mat73(const std::string& file) {
  hdf5();  // loaded before the child is there
  const std::lock_guard lock(hdf5_mutex());
  return read_in_child<MatVariables>({file, "MAT file", "the HDF5 library", cure_of_mat73},
                                     [&] { return Mat73Reader(file).read(); });
}

}  // namespace hysteron
