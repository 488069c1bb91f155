// hysteron for other programs: load diagrams, carry out every verb, take columns of numbers without a copy, advance a
// diagram step by step. C99; docs/c.md shows it at work. The functions are defined in library.cpp, load.cpp, verb.cpp,
// tables.cpp and steps.cpp.
//
// Texts are UTF-8 and end with 0. What is structured is JSON. Handles are opaque and freed with hy_free(); texts and
// columns belong to the handle that they come from and live as long as it does. A handle is for one thread at a time;
// different handles may be used by different threads at once. Nothing is printed, no signal is caught, no exception
// leaves, and nothing is kept between calls.
//
// A function that fails returns NULL (or the exit code of the program, which is not 0) and, where `error` is not NULL,
// puts a handle there that says why; else `*error` becomes NULL.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HY_API __attribute__((visibility("default")))

typedef struct hy_diagram hy_diagram;
typedef struct hy_result hy_result;
typedef struct hy_stepper hy_stepper;
typedef struct hy_error hy_error;

/// Exit codes, as the program ends with them.
enum { HY_DONE = 0, HY_NO = 1, HY_BAD_INPUT = 2, HY_NUMERICS = 3, HY_INTERRUPTED = 130 };

/// "0.1.0"
HY_API const char* hy_version(void);

/// Frees any handle of this library; NULL is allowed.
HY_API void hy_free(void* handle);

// ---- errors

/// {"exit_code": 2, "problems": [{"code", "path", "what", "cure", "file", "line"}]}; "interrupted" where the work was
/// ended by the watch.
HY_API const char* hy_error_json(const hy_error* error);
HY_API int hy_error_code(const hy_error* error);  ///< one of the exit codes above

// ---- diagrams

/// Reads and compiles a diagram. `overrides_json` may be NULL, or {"set": {"kp": "0.5 V/um"}, "choose":
/// {"compensator": "none"}, "allow": ["/other/folder"]}, as the options --set, --choose and --allow.
HY_API hy_diagram* hy_load(const char* path, const char* overrides_json, hy_error** error);

/// {"title", "inputs": [{"name", "unit"}], "outputs": [{"name", "unit", "signal"}], "signals": [{"name", "unit"}],
/// "parameters": [{"name", "value", "unit", "free"}], "states": ["lag.x"], "warnings": [...]}. Inputs and signals are
/// counted from 0 in this order; "signal" is such a number.
HY_API const char* hy_diagram_json(const hy_diagram* diagram);

/// Writes the diagram, with its overrides, to a file; paths in it stay right.
HY_API int hy_diagram_save(const hy_diagram* diagram, const char* path, hy_error** error);

// ---- verbs

/// Told how far the work is (`fraction` 0 .. 1, negative where that is not known) and what is being done, at most every
/// 50 ms, by any thread, but never by two at once. Work ends when it returns other than 0.
typedef int (*hy_watch)(void* context, double fraction, const char* what);

/// Carries out a verb of the program with the words that would stand behind it: hy_verb("run", 3, {"stage.json",
/// "--until", "1 s"}, ...). `watch` may be NULL. Results are written where the words say it with "-o", else a folder of
/// results is not written at all.
HY_API hy_result* hy_verb(const char* verb, int n, const char* const* words, hy_watch watch, void* context,
                          hy_error** error);

/// {"verb", "exit_code", "headline", "verdict", "sentences", "facts" or the members that "hysteron schema" describes,
/// "warnings", "files", "text", "traces": [{"file", "rows", "columns": [{"name", "unit"}]}], "figures": N}
HY_API const char* hy_result_json(const hy_result* result);

/// The numbers of a column of a trace: their count, -1 if there is no such one. `*numbers` points into the result.
HY_API int64_t hy_result_column(const hy_result* result, const char* trace, const char* column, const double** numbers);

/// A figure of the first screen, counted from 0, as SVG; NULL if there is none. Belongs to the result.
HY_API const char* hy_result_figure(hy_result* result, int figure);

// ---- tables

/// Writes columns as a recording that verbs read as data: CSV where the path ends with .csv, numbers as memory holds
/// them where it ends with .f64. The first column is the time, "t" in "s". Names and units as a CSV has them; "" is the
/// unit of a plain number.
HY_API int hy_write_table(const char* path, int columns, const char* const* names, const char* const* units,
                          const double* const* values, int64_t rows, hy_error** error);

// ---- step by step

/// A stepper at the start of the diagram, its inputs zero. `options_json` may be NULL, or {"until": "10 s", "begin":
/// "0 s"}: how long it is going to last, roughly.
HY_API hy_stepper* hy_stepper_new(const hy_diagram* diagram, const char* options_json, hy_error** error);

/// Sets an input, in its unit, from now on: it jumps, and is there before what is sampled at this instant.
HY_API int hy_stepper_set(hy_stepper* stepper, int input, double value, hy_error** error);

/// Goes on to `until` [s]. In a diagram with inputs what is due at that very instant happens in the next call.
///
/// Where the watch ends it, HY_INTERRUPTED is returned and the stepper stands at hy_stepper_time(): another call goes
/// on from there, to the same bits as if nobody had asked.
HY_API int hy_stepper_advance(hy_stepper* stepper, double until, hy_error** error);

/// Who is asked while this stepper (no copy of it) works, as a verb asks; NULL: nobody. The fraction is not known.
HY_API void hy_stepper_watch(hy_stepper* stepper, hy_watch watch, void* context);

/// The value of a signal, in its unit, as the last advance left it.
HY_API int hy_stepper_get(hy_stepper* stepper, int signal, double* value, hy_error** error);

HY_API double hy_stepper_time(const hy_stepper* stepper);  ///< [s]

/// Goes on by itself from where the original is.
HY_API hy_stepper* hy_stepper_copy(const hy_stepper* stepper, hy_error** error);

#ifdef __cplusplus
}
#endif
