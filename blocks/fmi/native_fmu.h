// Decides how the binary of an unpacked FMU is loaded and driven for co-simulation, the same for both versions of the
// interface. Runs foreign code in this process: whoever makes one has asked the user before.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace hysteron {

struct FmuPlace {
  int version = 2;        ///< of the interface: 2 or 3
  std::string binary;     ///< "/tmp/x/binaries/linux64/stage.so"
  std::string resources;  ///< "/tmp/x/resources", absolute
  std::string token;      ///< guid, or instantiationToken
  std::string name;       ///< for messages
};

/// One instance. Its functions throw Error with what the FMU said where it fails, numerics where a step does.
class NativeFmu {
 public:
  explicit NativeFmu(FmuPlace place);
  ~NativeFmu();
  NativeFmu(const NativeFmu&) = delete;
  NativeFmu& operator=(const NativeFmu&) = delete;

  /// Into its initialization, where start values are set and read; from its end on it takes steps. Times [s].
  void enter_initialization(double start, std::optional<double> stop);
  void exit_initialization();
  void reset();
  /// In the units of the FMU, by value references.
  void set(std::span<const unsigned> references, std::span<const double> values);
  void get(std::span<const unsigned> references, std::span<double> values);
  void step(double from, double size);

  class Interface;  ///< the functions of one version (native_fmu.cpp)

 private:
  std::unique_ptr<Interface> interface_;
};

}  // namespace hysteron
