#include "tests/io/formats/instrument_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace hysteron::instruments {
namespace {

/// A row for each sample; {t}, {u}, {y} and the number of the row.
std::string table(double start, const std::function<std::string(int, double, double, double)>& row) {
  std::string text;
  for (int k = 0; k < rows; ++k) text += row(k, start + k * interval, drive(k), response(k));
  return text;
}

std::string utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += {c, '\0'};
  return bytes;
}

std::string as_csv(int, double t, double u, double y) { return fmt::format("{:.6e},{:.5f},{:.5f}\n", t, u, y); }

InstrumentFile tektronix_mso() {
  return {"tek_mso.csv",
          "Model,MSO44\nFirmware Version,1.28.4\n\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.04,\n"
          "Sample Interval,0.001,\nRecord Length,40,\nGating,0.0% to 100.0%,\nProbe Attenuation,1,1\n"
          "Vertical Units,V,V\nVertical Offset,0,0\nVertical Scale,1,1\nLabel,drive,sensor\nTIME,CH1,CH2\n" +
              table(-0.02, as_csv),
          "drive",
          "sensor",
          "V",
          -0.02,
          0.51e-5,
          {"14 lines above the header", "names from the labels"}};
}

/// The older one: settings stand in the first three cells, beside the samples of one channel.
InstrumentFile tektronix_tds() {
  const std::vector<std::string> settings{"Record Length,40,Points",  "Sample Interval,1.000000e-03,s",
                                          "Trigger Point,20,Samples", ",,",
                                          "Trigger Time,-0.02,s",     ",,",
                                          "Horizontal Offset,0,s",    "Source,CH1,",
                                          "Vertical Units,V,",        "Horizontal Units,s,"};
  const auto row = [&](int k, double t, double u, double) {
    const std::string beside = k < static_cast<int>(settings.size()) ? settings[static_cast<std::size_t>(k)] : ",,";
    return fmt::format("{},{:013.9f},{:9.5f},\n", beside, t, u);
  };
  return {"tek_tds.csv", table(-0.02, row), "CH1", "", "V", -0.02, 0.51e-5, {"settings of the instrument"}};
}

InstrumentFile keysight() {
  return {"keysight_infiniivision.csv",
          "x-axis,1,2\nsecond,Volt,Volt\n" +
              table(-0.02,
                    [](int, double t, double u, double y) { return fmt::format("{:.5E},{:.5E},{:.5E}\n", t, u, y); }),
          "channel_1",
          "channel_2",
          "V",
          -0.02,
          0.51e-4,
          {"units from line 2"}};
}

InstrumentFile keysight_infiniium() {
  return {
      "keysight_infiniium.csv",
      "Revision:,0\nType:,raw\nStart:,0\nPoints:,40\nCount:,1\nXDispRange:,0.04\nXDispOrg:,-0.02\nXUnits:,second\n"
      "XInc:,1.000000e-003\nXOrg:,-2.000000e-002\nYUnits:,Volt\nFrame:,MSOS104A\nDate:,06 DEC 2012\nMax Bandwidth:,1e9\n"
      "drive,sensor\n" +
          table(0, [](int, double, double u, double y) { return fmt::format("{:.5e},{:.5e}\n", u, y); }),
      "drive",
      "sensor",
      "",
      -0.02,
      0.51e-4,
      {"times from the sample interval 0.001 s, from -0.02 s on"}};
}

InstrumentFile rigol() {
  return {"rigol_ds1000z.csv",
          "X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-2.000000e-02,1.000000e-03\n" +
              table(0, [](int k, double, double u, double y) { return fmt::format("{},{:.4e},{:.4e},\n", k, u, y); }),
          "CH1",
          "CH2",
          "V",
          -0.02,
          0.51e-3,
          {"times from the sample interval 0.001 s, from -0.02 s on"}};
}

InstrumentFile rigol_dho() {
  return {"rigol_dho800.csv",
          "CH1(V),CH2(V),t0 =-2.000000e-02, tInc = 1.000000e-03,\n" +
              table(0, [](int, double, double u, double y) { return fmt::format("{:.5f},{:.5f},,\n", u, y); }),
          "CH1",
          "CH2",
          "V",
          -0.02,
          0.51e-5,
          {"times from the sample interval 0.001 s"}};
}

InstrumentFile rohde_schwarz() {
  return {"rs_rtb.csv", "in s,C1 in V,C2 in V\n" + table(-0.02, as_csv), "C1", "C2", "V", -0.02, 0.51e-5, {}};
}

InstrumentFile picoscope() {
  return {
      "picoscope.csv",
      "Time;Channel A;Channel B\n(ms);(V);(mV)\n\n" +
          with_comma(table(-0.02, [](int, double t, double u,
                                     double y) { return fmt::format("{:.8f};{:.8f};{:.8f}\n", 1e3 * t, u, 1e3 * y); })),
      "Channel A",
      "Channel B",
      "V",
      -0.02,
      0.51e-8,
      {"decimal comma", "separated by \";\"", "units from line 2"}};
}

InstrumentFile lecroy() {
  return {"lecroy.csv",
          "LECROYWS424,12345,Waveform\nSegments,1,SegmentSize,40\nSegment,TrigTime,TimeSinceSegment1\n"
          "#1,06-Dec-2012 10:53:37,0\nTime,Ampl\n" +
              table(-0.02, [](int, double t, double u, double) { return fmt::format("{:.6e},{:.5f}\n", t, u); }),
          "Ampl",
          "",
          "",
          -0.02,
          0.51e-5,
          {"4 lines above the header", "taken as s"}};
}

InstrumentFile digilent() {
  return {
      "digilent.csv",
      "#Digilent WaveForms Oscilloscope Acquisition\r\n#Device Name: Discovery2\r\n#Serial Number: SN:210321A7F5C2\r\n"
      "#Date Time: 2024-05-02 09:10:11.123.456\r\n#Sample rate: 1e+03Hz\r\n#Samples: 40\r\n"
      "#Channel 1\r\n#Range: 50V\r\n\r\nTime (s),Channel 1 (V),Channel 2 (V)\r\n" +
          table(-0.02,
                [](int, double t, double u, double y) { return fmt::format("{:.6f},{:.6f},{:.6f}\r\n", t, u, y); }),
      "Channel 1",
      "Channel 2",
      "V",
      -0.02,
      0.51e-6,
      {}};
}

InstrumentFile saleae() {
  return {
      "saleae.csv",
      "Time [s],Channel 0,Channel 1\n" +
          table(0, [](int, double t, double u, double y) { return fmt::format("{:.9f},{:.6f},{:.6f}\n", t, u, y); }),
      "Channel 0",
      "Channel 1",
      "",
      0,
      0.51e-6,
      {"taken as plain numbers"}};
}

InstrumentFile siglent() {
  return {"siglent.csv",
          "Record Length,Analog:40\nSample Interval,Analog:1.000e-03\nVertical Units,CH1:V,CH2:V\n"
          "Vertical Scale,CH1:1.00,CH2:1.00\nHorizontal Units,s\nModel Number,SDS2104X\nSource,CH1,CH2\n"
          "Second,Volt,Volt\n" +
              table(-0.02, as_csv),
          "CH1",
          "CH2",
          "V",
          -0.02,
          0.51e-5,
          {}};
}

InstrumentFile labview_export() {
  return {
      "labview_export.txt",
      with_comma(
          "waveform\t[0]\t[1]\nt0\t26.01.2006 11:08:28,143000\t26.01.2006 11:08:28,143000\ndelta t\t0.001000\t0.001000\n\n"
          "time\tY[0]\tY[1]\n")
              .replace(0, 0, "") +
          with_comma(table(0,
                           [](int k, double, double u, double y) {
                             return fmt::format("26/01/2006 11:08:28.{:03}000\t{:.6f}\t{:.6f}\n", 143 + k, u, y);
                           })),
      "Y[0]",
      "Y[1]",
      "",
      0,
      0.51e-6,
      {"decimal comma", "separated by tabs", "times of day"}};
}

InstrumentFile german_spreadsheet() {
  return {"werkstatt.csv",
          "\xEF\xBB\xBFMessung vom 4. Mai\r\n\r\nZeit [ms];Spannung / V;Weg (V)\r\n" +
              with_comma(table(0, [](int, double t, double u,
                                     double y) { return fmt::format("{:.3f};{:.5f};{:.5f}\r\n", 1e3 * t, u, y); })),
          "Spannung",
          "Weg",
          "V",
          0,
          0.51e-5,
          {"decimal comma", "2 lines above the header", "Zeit is the time, in ms"}};
}

InstrumentFile latin_1() {
  return {"latin1.csv",
          "Zeit/\xB5s;Fl\xFCssigkeit;Weg\n" +
              table(0, [](int, double t, double u,
                          double y) { return fmt::format("{:.1f};{:.5f};{:.5f}\n", 1e6 * t, u, y); }),
          "Fl\xC3\xBCssigkeit",
          "Weg",
          "",
          0,
          0.51e-5,
          {"Latin-1"}};
}

InstrumentFile unicode_16() {
  return {"unicode.txt",
          utf16("Time\tForce (V)\tTravel (V)\r\n" +
                table(0, [](int, double t, double u,
                            double y) { return fmt::format("{:.3f}\t{:.5f}\t{:.5f}\r\n", t, u, y); })),
          "Force",
          "Travel",
          "V",
          0,
          0.51e-5,
          {"UTF-16", "separated by tabs"}};
}

InstrumentFile iso_times() {
  return {"logger.csv",
          "timestamp,drive [V],sensor [V]\n" +
              table(0,
                    [](int k, double, double u, double y) {
                      return fmt::format("2026-05-04T23:59:59.{:03}+02:00,{:.5f},{:.5f}\n", 900 + k, u, y);
                    }),
          "drive",
          "sensor",
          "V",
          0,
          0.51e-5,
          {"times of day, counted from the first row"}};
}

InstrumentFile clock_over_midnight() {
  return {"clock.csv",
          "Uhrzeit,drive [V],sensor [V]\n" + table(0,
                                                   [](int k, double, double u, double y) {
                                                     return fmt::format("{}.{:03},{:.5f},{:.5f}\n",
                                                                        k < 20 ? "23:59:59" : "00:00:00",
                                                                        k < 20 ? 980 + k : k - 20, u, y);
                                                   }),
          "drive",
          "sensor",
          "V",
          0,
          0.51e-5,
          {}};
}

InstrumentFile blanks() {
  return {"columns.dat",
          "% time  drive volts  sensor volts\n" +
              table(0, [](int, double t, double u,
                          double y) { return fmt::format("  {:.4f}   {:9.5f}  {:9.5f}\n", t, u, y); }),
          "drive volts",
          "sensor volts",
          "",
          0,
          0.51e-5,
          {"separated by blanks"}};
}

InstrumentFile quoted_commas() {
  return {"quoted.csv",
          "\"Zeit [s]\",\"drive [V]\",\"sensor [V]\"\n" +
              table(0,
                    [](int, double t, double u, double y) {
                      return with_comma(fmt::format("\"{:.4f}\"", t)) + "," + with_comma(fmt::format("\"{:.5f}\"", u)) +
                             "," + with_comma(fmt::format("\"{:.5f}\"", y)) + "\n";
                    }),
          "drive",
          "sensor",
          "V",
          0,
          0.51e-5,
          {"decimal comma"}};
}

InstrumentFile rate_in_settings() {
  return {"rate.txt",
          "# Abtastrate: 1 kHz\n# rig 3\ndrive [V]\tsensor [V]\n" +
              table(0, [](int, double, double u, double y) { return fmt::format("{:.5f}\t{:.5f}\n", u, y); }),
          "drive",
          "sensor",
          "V",
          0,
          0.51e-5,
          {"times from the sample interval 0.001 s"}};
}

}  // namespace

double time_of(int row) { return row * interval; }

std::vector<double> samples(double (*of)(int), double times) {
  std::vector<double> list;
  for (int k = 0; k < rows; ++k) list.push_back(times * of(k));
  return list;
}

std::string with_comma(std::string text) {
  std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

double drive(int row) { return 5 * std::sin(2 * std::numbers::pi * 37 * interval * row); }
double response(int row) { return 2 * drive(row) + 0.125; }

std::vector<InstrumentFile> text_files() {
  return {tektronix_mso(),   tektronix_tds(),
          keysight(),        keysight_infiniium(),
          rigol(),           rigol_dho(),
          rohde_schwarz(),   picoscope(),
          lecroy(),          digilent(),
          saleae(),          siglent(),
          labview_export(),  german_spreadsheet(),
          latin_1(),         unicode_16(),
          iso_times(),       clock_over_midnight(),
          blanks(),          quoted_commas(),
          rate_in_settings()};
}

std::vector<InstrumentFile> all_files() {
  static const std::vector<InstrumentFile> all = [] {
    std::vector<InstrumentFile> files = text_files();
    for (auto& file : binary_files()) files.push_back(std::move(file));
    for (auto& file : hdf5_files()) files.push_back(std::move(file));
    return files;
  }();
  return all;
}

}  // namespace hysteron::instruments
