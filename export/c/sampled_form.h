// Decides what stands in a controller for blocks whose states move continuously: linear ones become matrices from
// instant to instant, others the sampled block that their source names (CLaw::sampled_type). Does not write C.
#pragma once

#include <string>
#include <vector>

#include "engine/block/c_law.h"
#include "engine/diagram/diagram.h"
#include "engine/program/program.h"

namespace hysteron {

/// How the input of a linear block moves from one instant to the next.
enum class BetweenSteps { straight, held };

struct SampledForm {
  Diagram diagram;
  std::vector<std::string> replaced;  ///< "controller: pi_controller as matrices from step to step"
};

/// `diagram` with every block with continuous states that can be replaced in its sampled form at `period` [s]; others
/// stay as they are. `program`: `diagram`, compiled.
///
/// Linear, x' = A x + B u, u straight between instants (first-order hold):
///   z_k = x_k - G1 u_k,  z_(k+1) = F z_k + (G0 + F G1) u_k,  y_k = C z_k + (D + C G1) u_k,
///   F = e^(A T),  G0 + G1 = integral of e^(A s) ds B,  G1 = (1/T) integral of (T - s) e^(A s) ds B
/// held: z = x, z_(k+1) = F z_k + (G0 + G1) u_k. Exact for such inputs. Before the first instant u is taken to be zero.
/// Source: Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd ed. (1998), sections 4.3.1 and 6.3.2.
SampledForm sampled_form(const Diagram& diagram, const Program& program, const Registry& registry, double period,
                         BetweenSteps between);

}  // namespace hysteron
