/* Variables of libc that code for programs reaches for directly, which a library cannot: the linker (--wrap) sends it
 * here. udunits' parser knows the streams; the standard library of C++ asks whether there is but one thread. */
#include <stdio.h>

extern FILE *__real_stdin, *__real_stdout, *__real_stderr;
FILE *__wrap_stdin, *__wrap_stdout, *__wrap_stderr;
char __wrap___libc_single_threaded; /* 0: there may be others */

__attribute__((constructor)) static void take_streams(void) {
  __wrap_stdin = __real_stdin;
  __wrap_stdout = __real_stdout;
  __wrap_stderr = __real_stderr;
}
