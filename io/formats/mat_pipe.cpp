#include "io/formats/mat_pipe.h"

namespace hysteron {
namespace {

// One more than readers go down; what is deeper comes from a child whose memory is broken.
constexpr int deepest_in_pipe = deepest_of_mat + 2;

void put_value(PipeWriter& to, const MatValue& v) {
  to.put(static_cast<std::uint64_t>(v.kind));
  to.put(std::uint64_t{v.sizes.size()});
  for (const std::size_t size : v.sizes) to.put(std::uint64_t{size});
  to.put(std::span<const double>(v.values));
  to.put(std::string_view(v.text));
  to.put(std::uint64_t{v.elements});
  to.put(std::uint64_t{v.fields.size()});
  for (const auto& field : v.fields) {
    to.put(std::string_view(field.name));
    to.put(std::uint64_t{field.of_element.size()});
    for (const auto& element : field.of_element) put_value(to, element);
  }
}

MatValue value_of(PipeReader& from, int depth) {
  if (depth > deepest_in_pipe) throw PipeEnded{};
  MatValue v;
  v.kind = static_cast<MatValue::Kind>(from.number());
  for (std::uint64_t k = from.number(); k > 0; --k) v.sizes.push_back(from.number());
  v.values = from.numbers();
  v.text = from.text();
  v.elements = from.number();
  for (std::uint64_t k = from.number(); k > 0; --k) {
    MatValue::Field field{from.text(), {}};
    for (std::uint64_t e = from.number(); e > 0; --e) field.of_element.push_back(value_of(from, depth + 1));
    v.fields.push_back(std::move(field));
  }
  return v;
}

}  // namespace

void put(PipeWriter& to, const MatVariables& variables) {
  to.put(std::uint64_t{variables.size()});
  for (const auto& [name, value] : variables) {
    to.put(std::string_view(name));
    put_value(to, value);
  }
}

void take(PipeReader& from, MatVariables& variables) {
  variables.clear();
  for (std::uint64_t k = from.number(); k > 0; --k) {
    std::string name = from.text();
    variables.emplace_back(std::move(name), value_of(from, 0));
  }
}

}  // namespace hysteron
