// Decides nothing: hands the words of the command line over.
// See command_line.h for reading and failing, verb.h for the verbs.
#include "app/cli/command_line.h"

int main(int argc, char** argv) { return hysteron::run_command_line({argv + 1, argv + argc}); }
