// Decides what "hysteron export c" does: C99 of a compensator or controller.
#pragma once

#include "app/exports/export_kind.h"

namespace hysteron {

ExportKind export_c();

}  // namespace hysteron
