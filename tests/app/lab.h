// Decides the small laboratory of these tests: a diagram that works, recordings of a known law, and ways to spoil them.
#pragma once

#include <string>

#include "tests/app/hysteron_process.h"

namespace hysteron::lab {

/// y = 1.5 um/V * u + 0.2 um, u a sampled triangle; `rows` rows of 10 ms. `extra` is added to y [um].
std::string recording(int rows = 200, double extra = 0);

/// The same law with sensor noise of 5 nm rms (fixed by `seed`), and with u behind a lag of `tau` [s] where tau > 0.
std::string noisy_recording(unsigned seed, double tau = 0);

/// Diagram with input u [V] and output y [um]: gain 1.5 um/V and offset 0.2 um, the gain free.
std::string diagram();

/// A data set of a.csv (train) and b.csv (validate).
std::string dataset();

/// diagram.json, dataset.json, a.csv, b.csv.
void furnish(const process::Folder& folder);

}  // namespace hysteron::lab
