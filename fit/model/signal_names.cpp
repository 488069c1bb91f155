#include "fit/model/signal_names.h"

namespace hysteron {

int find_named(const Program& program, const std::string& name) {
  for (std::size_t i = 0; i < program.output_names.size(); ++i)
    if (program.output_names[i] == name) return program.output_signals[i];
  return program.find_signal(name);
}

int named_signal(const Program& program, const std::string& name) {
  const int signal = find_named(program, name);
  return signal >= 0 ? signal : program.signal(name);  // throws, with the nearest name
}

}  // namespace hysteron
