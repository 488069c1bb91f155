// Decides the document on which results and reports are tested: every kind of section and figure, hostile text
// included.
#pragma once

#include "io/results/result.h"

namespace hysteron::example {

/// A made-up discovery: 30 000 rows of a stage with hysteresis, one spike at row 12 345.
Document discovery();

constexpr std::size_t rows = 30000, spike_row = 12345;

}  // namespace hysteron::example
