// Decides how SUNDIALS adds, scales and measures vectors: with loops compiled here instead of its own, which Debian
// builds without vector instructions and which ask at every call what special case they have before them. Half of the
// time of a small simulation went there. Does not decide what is computed, nor in which order.
#pragma once

struct _generic_N_Vector;  // SUNDIALS' N_Vector points to it

namespace hysteron {

/// From now on `v`, a serial N_Vector, and all its clones compute with the operations of this file. Lengths up to ten
/// have loops of their own. Results are the same bits on every machine: sums have a fixed order and no product is
/// fused into an addition.
void use_own_operations(_generic_N_Vector* v);

/// weights_i = 1 / (relative * |x_i| + absolute_i), x and weights serial N_Vectors of one length.
void error_weights(double relative, const double* absolute, _generic_N_Vector* x, _generic_N_Vector* weights);

}  // namespace hysteron
