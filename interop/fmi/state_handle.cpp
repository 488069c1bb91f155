#include "interop/fmi/state_handle.h"

#include <memory>
#include <utility>

#include "engine/diagram/error.h"

namespace hysteron::interop {
namespace {

void need_state(const void* pointer) {
  if (pointer == nullptr)
    fail("bad_call", "state", "NULL was given", "give what the standard asks for: a state that was saved before");
}

}  // namespace

void save_state(const FmuInstance& instance, void** handle) {
  need_state(handle);
  auto copy = std::make_unique<FmuInstance::State>(instance.saved());
  if (*handle != nullptr)
    *static_cast<FmuInstance::State*>(*handle) = std::move(*copy);
  else
    *handle = copy.release();
}

void restore_state(FmuInstance& instance, const void* handle) {
  need_state(handle);
  instance.restore(*static_cast<const FmuInstance::State*>(handle));
}

void free_state(void** handle) {
  if (handle == nullptr) return;
  delete static_cast<FmuInstance::State*>(*handle);
  *handle = nullptr;
}

}  // namespace hysteron::interop
