#include "blocks/fmi/native_fmu.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "blocks/fmi/fmi2.h"
#include "blocks/fmi/fmi3.h"
#include "engine/diagram/error.h"
#include "engine/diagram/percent_text.h"

namespace hysteron {

class NativeFmu::Interface {
 public:
  explicit Interface(FmuPlace place) : place_(std::move(place)) {
    // Its names stay its own, and what it links is found now and not in the middle of a simulation.
    library_ = dlopen(place_.binary.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) refuse(fmt::format("its binary cannot be loaded: {}", dlerror()));
  }
  virtual ~Interface() {
    if (library_ != nullptr) dlclose(library_);
  }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  virtual void instantiate() = 0;
  virtual void enter_initialization(double start, std::optional<double> stop) = 0;
  virtual void exit_initialization() = 0;
  virtual void reset() = 0;
  virtual void set(std::span<const unsigned> references, std::span<const double> values) = 0;
  virtual void get(std::span<const unsigned> references, std::span<double> values) = 0;
  virtual void step(double from, double size) = 0;

 protected:
  [[noreturn]] void refuse(const std::string& why) const {
    fail("bad_fmu", place_.name, why, "ask who made it for one that keeps to the standard and runs on x86-64 Linux");
  }

  template <class Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(dlsym(library_, name));
    if (function == nullptr) refuse(fmt::format("its binary has no function {}", name));
  }

  /// `status`: 0 and 1 (a warning) are well in both versions. What was said in a call that went well does not explain
  /// a later failure.
  void need_well(int status, const char* what) {
    const std::string said = std::exchange(said_, "");
    if (status <= 1) return;
    const std::string words = said.empty() ? "it does not say why" : said;
    fail_numerics("fmu_failed", place_.name, fmt::format("the FMU failed in {}: {}", what, words),
                  "see its documentation; smaller steps (period) may help");
  }

  void hear(const char* text) {
    if (!said_.empty()) said_ += '\n';
    said_ += text;
  }

  FmuPlace place_;
  void* library_ = nullptr;
  std::string said_;
};

namespace {

std::string file_uri(const std::string& path) { return "file://" + percent_encoded(path); }

class Fmi2 : public NativeFmu::Interface {
 public:
  explicit Fmi2(FmuPlace place) : Interface(std::move(place)) {
    find("fmi2Instantiate", instantiate_), find("fmi2FreeInstance", free_), find("fmi2SetupExperiment", set_up_);
    find("fmi2EnterInitializationMode", enter_), find("fmi2ExitInitializationMode", exit_);
    find("fmi2Reset", reset_), find("fmi2SetReal", set_), find("fmi2GetReal", get_), find("fmi2DoStep", step_);
  }
  ~Fmi2() override {
    if (instance_ != nullptr) free_(instance_);
  }

  void instantiate() override {
    call_ = {log, std::calloc, std::free, nullptr, this};
    instance_ = instantiate_(place_.name.c_str(), fmi2CoSimulation, place_.token.c_str(),
                             file_uri(place_.resources).c_str(), &call_, fmi2False, fmi2False);
    if (instance_ == nullptr) refuse("it cannot be instantiated: " + said_);
  }
  void enter_initialization(double start, std::optional<double> stop) override {
    need_well(set_up_(instance_, fmi2False, 0, start, stop ? fmi2True : fmi2False, stop.value_or(0)), "its set-up");
    need_well(enter_(instance_), "its initialization");
  }
  void exit_initialization() override { need_well(exit_(instance_), "its initialization"); }
  void reset() override { need_well(reset_(instance_), "its reset"); }
  void set(std::span<const unsigned> references, std::span<const double> values) override {
    if (!references.empty())
      need_well(set_(instance_, references.data(), references.size(), values.data()), "taking values");
  }
  void get(std::span<const unsigned> references, std::span<double> values) override {
    if (!references.empty())
      need_well(get_(instance_, references.data(), references.size(), values.data()), "giving values");
  }
  void step(double from, double size) override { need_well(step_(instance_, from, size, fmi2True), "a step"); }

 private:
  static void log(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String, fmi2String message,
                  ...) {
    if (environment == nullptr || message == nullptr || status == fmi2OK) return;
    char text[4096];
    va_list rest;
    va_start(rest, message);
    std::vsnprintf(text, sizeof text, message, rest);
    va_end(rest);
    static_cast<Fmi2*>(environment)->hear(text);
  }

  fmi2CallbackFunctions call_{};
  fmi2Component instance_ = nullptr;
  decltype(fmi2Instantiate)* instantiate_ = nullptr;
  decltype(fmi2FreeInstance)* free_ = nullptr;
  decltype(fmi2SetupExperiment)* set_up_ = nullptr;
  decltype(fmi2EnterInitializationMode)*enter_ = nullptr, *exit_ = nullptr, *reset_ = nullptr;
  decltype(fmi2SetReal)* set_ = nullptr;
  decltype(fmi2GetReal)* get_ = nullptr;
  decltype(fmi2DoStep)* step_ = nullptr;
};

class Fmi3 : public NativeFmu::Interface {
 public:
  explicit Fmi3(FmuPlace place) : Interface(std::move(place)) {
    find("fmi3InstantiateCoSimulation", instantiate_), find("fmi3FreeInstance", free_);
    find("fmi3EnterInitializationMode", enter_), find("fmi3ExitInitializationMode", exit_);
    find("fmi3Reset", reset_), find("fmi3SetFloat64", set_), find("fmi3GetFloat64", get_), find("fmi3DoStep", step_);
  }
  ~Fmi3() override {
    if (instance_ != nullptr) free_(instance_);
  }

  void instantiate() override {
    const std::string resources = place_.resources + "/";
    instance_ = instantiate_(place_.name.c_str(), place_.token.c_str(), resources.c_str(), false, false, false, false,
                             nullptr, 0, this, log, nullptr);
    if (instance_ == nullptr) refuse("it cannot be instantiated: " + said_);
  }
  void enter_initialization(double start, std::optional<double> stop) override {
    need_well(enter_(instance_, false, 0, start, stop.has_value(), stop.value_or(0)), "its initialization");
  }
  void exit_initialization() override { need_well(exit_(instance_), "its initialization"); }
  void reset() override { need_well(reset_(instance_), "its reset"); }
  void set(std::span<const unsigned> references, std::span<const double> values) override {
    if (!references.empty())
      need_well(set_(instance_, references.data(), references.size(), values.data(), values.size()), "taking values");
  }
  void get(std::span<const unsigned> references, std::span<double> values) override {
    if (!references.empty())
      need_well(get_(instance_, references.data(), references.size(), values.data(), values.size()), "giving values");
  }
  void step(double from, double size) override {
    bool event = false, terminate = false, early = false;
    double last = from;
    need_well(step_(instance_, from, size, true, &event, &terminate, &early, &last), "a step");
    if (terminate) need_well(fmi3Error, "a step, behind which it wants to end");
  }

 private:
  static void log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String, fmi3String message) {
    if (environment != nullptr && message != nullptr && status != fmi3OK)
      static_cast<Fmi3*>(environment)->hear(message);
  }

  fmi3Instance instance_ = nullptr;
  decltype(fmi3InstantiateCoSimulation)* instantiate_ = nullptr;
  decltype(fmi3FreeInstance)* free_ = nullptr;
  decltype(fmi3EnterInitializationMode)* enter_ = nullptr;
  decltype(fmi3ExitInitializationMode)*exit_ = nullptr, *reset_ = nullptr;
  decltype(fmi3SetFloat64)* set_ = nullptr;
  decltype(fmi3GetFloat64)* get_ = nullptr;
  decltype(fmi3DoStep)* step_ = nullptr;
};

std::unique_ptr<NativeFmu::Interface> interface_of(FmuPlace place) {
  if (place.version == 3) return std::make_unique<Fmi3>(std::move(place));
  return std::make_unique<Fmi2>(std::move(place));
}

}  // namespace

NativeFmu::NativeFmu(FmuPlace place) : interface_(interface_of(std::move(place))) { interface_->instantiate(); }
NativeFmu::~NativeFmu() = default;

void NativeFmu::enter_initialization(double start, std::optional<double> stop) {
  interface_->enter_initialization(start, stop);
}
void NativeFmu::exit_initialization() { interface_->exit_initialization(); }
void NativeFmu::reset() { interface_->reset(); }
void NativeFmu::set(std::span<const unsigned> references, std::span<const double> values) {
  interface_->set(references, values);
}
void NativeFmu::get(std::span<const unsigned> references, std::span<double> values) {
  interface_->get(references, values);
}
void NativeFmu::step(double from, double size) { interface_->step(from, size); }

}  // namespace hysteron
