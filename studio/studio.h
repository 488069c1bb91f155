// Decides what hysteron studio is while it runs: a server on this machine alone, the page, and the address that opens
// it. Does not decide what is answered (api.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studio/api.h"

namespace hysteron::studio {

struct StudioSettings {
  std::string folder;
  int port = 0;  ///< 0: any that is free
  bool opens_browser = true;
  ApiSettings api;
};

/// Serves until `stop` says so. `ready` is told the address, token and all, once it answers; it also stands, for
/// programs of the same user, in FOLDER/.hysteron/studio.json while the studio runs. Throws Error "no_page" where the
/// program was built without it, "port_taken", "no_folder". Returns the address.
std::string serve(const StudioSettings& settings, const std::function<void(const std::string& address)>& ready,
                  const std::function<bool()>& stop);

}  // namespace hysteron::studio
