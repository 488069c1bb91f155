// hysteron export fmu: a diagram as a co-simulation unit of the Functional Mock-up Interface. Its binary is prepared
// (interop/fmi) and runs the diagram that is packed beside it.
// Does not write the model description (io/fmi).
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "app/cli/load.h"
#include "app/cli/target.h"
#include "app/cli/words.h"
#include "app/exports/export_kind.h"
#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/simulate/stepped_simulation.h"
#include "export/c/c_text.h"
#include "io/diagram/packed_diagram.h"
#include "io/files/atomic_file.h"
#include "io/files/zip_archive.h"
#include "io/fmi/exported_description.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr char help[] =
    "A unit of the Functional Mock-up Interface (co-simulation, FMI 2.0 or 3.0) for x86-64 Linux, which\n"
    "other simulators import. It holds the diagram and the engine of this program: its results are those\n"
    "of \"hysteron run\", and neither a compiler nor any library but libc is needed, here or there. Inputs\n"
    "of the diagram are its inputs, held over each step; outputs its outputs (what it records, where it\n"
    "has none); parameters can be set before the start, each with unit and range; every other signal can\n"
    "be read. docs/fmi.md says more.\n\n"
    "  hysteron export fmu stage.json\n"
    "  hysteron export fmu stage.json -o plant.fmu --fmi 3 --set kp=\"0.5 V/um\"\n\n"
    "Writes one file, named after the diagram or by -o.";

/// The binary lies beside the program, or where it was installed.
std::string runtime_file() {
  constexpr char name[] = "libhysteron_fmu.so";
  Dl_info info;
  std::error_code code;
  fs::path own;
  if (dladdr(reinterpret_cast<const void*>(&export_fmu), &info) != 0 && info.dli_fname != nullptr)
    own = fs::canonical(info.dli_fname, code);
  if (own.empty() || code) own = fs::read_symlink("/proc/self/exe", code);
  const fs::path here = own.parent_path();
  for (const fs::path& folder :
       {here, here / "hysteron", here.parent_path() / "interop", here.parent_path() / "lib" / "hysteron",
        here.parent_path() / "lib" / "x86_64-linux-gnu" / "hysteron"})
    if (fs::exists(folder / name, code)) return (folder / name).string();
  fail("no_file", name, fmt::format("the binary that FMUs run was not found beside {}", own.string()),
       "build it (cmake --build build --target hysteron_fmu) or install the program whole");
}

void need_own_laws(const Program& program) {
  for (const auto& block : program.blocks)
    if (block.kernel->declaration.type == "fmu")
      fail("not_exportable", block.path, "an FMU is a program of somebody else, and is not packed into another one",
           "export the diagram without it, and couple both where they are used");
}

int version_of(const Arguments& arguments) {
  const std::string wish = arguments.text("--fmi", "2");
  if (wish == "2" || wish == "3") return wish[0] - '0';
  fail("bad_command_line", "--fmi", fmt::format("there is no version \"{}\"", wish), "write --fmi 2 or --fmi 3");
}

Answer act(const Arguments& arguments, const Watch& watch) {
  const int version = version_of(arguments);
  const std::string file = arguments.text("-o", stem_of(arguments.text("diagram")) + ".fmu");
  need_ending("-o", file, {".fmu"}, "an FMU, e.g. -o stage.fmu");
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  need_own_laws(*program);
  with_lines_of(diagram, [&] { SteppedSimulation begins(program, simulate_options(*program)); });
  const std::string packed = exported_program(diagram, all_blocks);
  FmiDescription description =
      exported_description(*program, version, c_text::identifier(stem_of(file)), packed_token(packed));
  description.tool = std::string("hysteron ") + version_of_program();
  Answer answer;
  answer.files.push_back({file, zipped({{"modelDescription.xml", fmi_description_text(description)},
                                        {"resources/program.json", packed},
                                        {fmi_binary_name(description), read_file(runtime_file())}})});
  long inputs = 0, parameters = 0;
  for (const auto& v : description.variables) {
    inputs += v.causality == "input" ? 1 : 0;
    parameters += v.causality == "parameter" ? 1 : 0;
  }
  answer.closing = fmt::format(
      "wrote {}: FMI {}.0 for co-simulation, {}, {}, {}\n", file, version, count_text(inputs, "input"),
      count_text(static_cast<long>(description.outputs.size()), "output"), count_text(parameters, "parameter"));
  answer.facts = Facts::object({{"fmu", file}, {"fmi", version}});
  return answer;
}

std::vector<shape::Member> shape_of() {
  return {{"fmu", shape::text("the file"), shape::sometimes}, {"fmi", shape::whole("its version"), shape::sometimes}};
}

}  // namespace

ExportKind export_fmu() {
  return {"fmu", "a unit for co-simulation in other simulators",
          help,  {{"--fmi", "2|3", "version of the interface (default 2)", false, false}},
          act,   shape_of};
}

}  // namespace hysteron
