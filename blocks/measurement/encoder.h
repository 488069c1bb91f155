// Decides the blocks "encoder" (of an angle) and "linear_encoder" (along a scale). Does not decide their law:
// models/measurement/encoder.h.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "engine/block/block.h"
#include "models/measurement/encoder.h"

namespace hysteron::blocks {

/// What both share. Of their Params the first tells the pitch.
struct Counting {
  template <class T>
  struct Params {
    T scale, divisions, cosine, sine, second_cosine, second_sine;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };

 protected:
  template <class T>
  static T read(const Params<T>& p, const T& pitch, const T& u) {
    return u + encoder::harmonic(1, p.cosine, p.sine, pitch, u) +
           encoder::harmonic(2, p.second_cosine, p.second_sine, pitch, u);
  }
  template <class T>
  static T step(const Params<T>& p, const T& pitch) {
    return value_of(p.divisions) > 0 ? T{pitch / p.divisions} : T{0};
  }
  template <class T>
  static Out<T> counted(const Params<T>& p, const T& pitch, const T& u) {
    return {encoder::counted(step(p, pitch), read(p, pitch, u))};
  }
  /// Zero half way between two counts.
  static std::array<double, 1> half_way(const Params<double>& p, double pitch, double u) {
    const double q = step(p, pitch);
    return {q > 0 ? std::cos(std::numbers::pi * read(p, pitch, u) / q) : 1.0};
  }
};

struct Encoder : Counting {
  static void describe(BlockSpec<Encoder>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return counted(p, pitch(p), in.u);
  }
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) {
    return half_way(p, pitch(p), in.u);
  }

 private:
  template <class T>
  static T pitch(const Params<T>& p) {
    return T{6.283185307179586476925287} / p.scale;
  }
};

struct LinearEncoder : Counting {
  static void describe(BlockSpec<LinearEncoder>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return counted(p, p.scale, in.u);
  }
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) {
    return half_way(p, p.scale, in.u);
  }
};

Kernel encoder_block();
Kernel linear_encoder_block();

}  // namespace hysteron::blocks
