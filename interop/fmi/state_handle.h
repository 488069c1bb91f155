// Decides what a caller holds that has saved the state of an instance, the same for both versions of the interface: a
// pointer to a value of its own, which others may not look into.
#pragma once

#include "interop/fmi/fmu_instance.h"

namespace hysteron::interop {

/// Into what `*handle` points at, or into a new one where that is NULL. Throws Error "bad_call" where `handle` is NULL.
void save_state(const FmuInstance& instance, void** handle);
/// Throws Error "bad_call" where `handle` is NULL.
void restore_state(FmuInstance& instance, const void* handle);
/// NULL is allowed at both places; `*handle` becomes NULL.
void free_state(void** handle);

}  // namespace hysteron::interop
