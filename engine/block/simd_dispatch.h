// Decides for which vector instructions a loop is compiled, and which of these versions this processor takes: those of
// two, four or eight doubles. All give the same bits (CMakeLists.txt: no contraction but where the code says so).
#pragma once

#include <vector>

namespace hysteron {

/// Body: `Arguments` and `static void run(const Arguments&)`, all of it inline.
template <class Body>
struct SimdDispatch {
  using Call = void (*)(const typename Body::Arguments&);

  static Call on_this_processor() { return versions().back(); }

  /// Those that this processor can run, the widest last.
  static std::vector<Call> versions() {
    std::vector<Call> list{&plain};
#if defined(__x86_64__) && defined(__OPTIMIZE__)
    static const bool eight = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                              __builtin_cpu_supports("avx512cd");
    static const bool four = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                             __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    if (four) list.push_back(&of_four);
    if (eight) list.push_back(&of_eight);
#endif
    return list;
  }

 private:
  [[gnu::flatten]] static void plain(const typename Body::Arguments& a) { Body::run(a); }
#if defined(__x86_64__) && defined(__OPTIMIZE__)
  [[gnu::flatten, gnu::target("arch=x86-64-v3")]] static void of_four(const typename Body::Arguments& a) {
    Body::run(a);
  }
  [[gnu::flatten, gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] static void of_eight(
      const typename Body::Arguments& a) {
    Body::run(a);
  }
#endif
};

}  // namespace hysteron
