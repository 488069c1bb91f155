// Decides which files stand for the instruments of a laboratory: written from their published layouts, with samples of
// a closed form, so that tests know every number. Does not read them.
#pragma once

#include <string>
#include <vector>

namespace hysteron::instruments {

inline constexpr int rows = 40;
inline constexpr double interval = 1e-3;  // [s]

/// Samples of all files: a sine, and twice the sine with an offset.
double drive(int row);     ///< [V]
double response(int row);  ///< [V]
double time_of(int row);   ///< [s]

/// One of these at every row, `times` as large.
std::vector<double> samples(double (*of)(int), double times = 1);

/// As spreadsheets of half of Europe write numbers.
std::string with_comma(std::string text);

struct InstrumentFile {
  std::string name;                    ///< of the file
  std::string bytes;                   ///< of the file
  std::string drive, response;         ///< names of the columns as they come out
  std::string unit;                    ///< of both columns; "" = the file has none
  double start = 0;                    ///< [s] the time of the first row
  double half_digit = 1e-5;            ///< what rounding took: half of the last digit that is written
  std::vector<std::string> assumed{};  ///< facts that the reader must say
  double time_digit = 1e-9;            ///< [s] half_digit of the times
};

std::vector<InstrumentFile> text_files();

std::vector<InstrumentFile> binary_files();

/// HDF5, and MATLAB 7.3 over it.
std::vector<InstrumentFile> hdf5_files();

std::string tdms_of_daqmx();
std::string tdms_of_scaling(const std::string& type);
std::string mat_of_two_groups();

/// Good vectors, and structures within each other, `depth` of them; the last holds a matrix of 2^28 numbers, of which
/// one is in the file.
std::string mat_of_lost_numbers(int depth);

/// Of every format.
std::vector<InstrumentFile> all_files();

}  // namespace hysteron::instruments
