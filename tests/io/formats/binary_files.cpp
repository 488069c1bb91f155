// Files of LabVIEW, Excel and MATLAB, byte by byte from their published layouts.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>

#include "tests/io/formats/instrument_files.h"

namespace hysteron::instruments {
namespace {

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);  // little-endian, as the machine
  return bytes;
}

// ---- LVM ------------------------------------------------------------------------------------------------------------

InstrumentFile lvm(const std::string& name, const std::string& x_columns, bool comma) {
  const bool multi = x_columns == "Multi", none = x_columns == "No";
  std::string text = fmt::format(
      "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t{}\n"
      "Multi_Headings\tNo\nX_Columns\t{}\nTime_Pref\tRelative\nOperator\tlab\nDate\t2024/05/02\nTime\t09:10:11.123\n"
      "***End_of_Header***\t\n\t\nChannels\t2\t\t\nSamples\t40\t40\t\nY_Unit_Label\tVolts\tVolts\t\nX_Dimension\tTime\tTime\t\n"
      "X0\t-2.0E-2\t-2.0E-2\t\nDelta_X\t0.001000\t0.001000\t\n***End_of_Header***\t\t\t\n",
      comma ? "," : ".", x_columns);
  text += multi ? "X_Value\tVoltage\tX_Value\tSensor\tComment\n" : "X_Value\tVoltage\tSensor\tComment\n";
  for (int k = 0; k < rows; ++k) {
    const std::string t = none ? "" : fmt::format("{:.6f}", -0.02 + k * interval);
    text += fmt::format("{0}\t{1:.6f}\t{2}{3:.6f}{4}\n", t, drive(k), multi ? t + "\t" : "", response(k),
                        k == 0 ? "\tfirst of all" : "");
  }
  return {name, comma ? with_comma(text) : text, "Voltage", "Sensor", "V", -0.02, 0.51e-6, {"a LabVIEW measurement"}};
}

// ---- XLSX -----------------------------------------------------------------------------------------------------------

std::uint32_t crc_32(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  return ~crc;
}

/// An archive whose entries are stored as they are.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string archive, directory;
  for (const auto& [name, content] : entries) {
    const auto size = static_cast<std::uint32_t>(content.size());
    const std::string facts = raw<std::uint16_t>(20) + raw<std::uint16_t>(0) + raw<std::uint16_t>(0) +
                              raw<std::uint32_t>(0) + raw(crc_32(content)) + raw(size) + raw(size) +
                              raw(static_cast<std::uint16_t>(name.size())) + raw<std::uint16_t>(0);
    directory += "PK\x01\x02" + raw<std::uint16_t>(20) + facts + raw<std::uint16_t>(0) + raw<std::uint16_t>(0) +
                 raw<std::uint16_t>(0) + raw<std::uint32_t>(0) + raw(static_cast<std::uint32_t>(archive.size())) + name;
    archive += "PK\x03\x04" + facts + name + content;
  }
  const auto count = static_cast<std::uint16_t>(entries.size());
  return archive + directory + "PK\x05\x06" + raw<std::uint32_t>(0) + raw(count) + raw(count) +
         raw(static_cast<std::uint32_t>(directory.size())) + raw(static_cast<std::uint32_t>(archive.size())) +
         raw<std::uint16_t>(0);
}

constexpr char xml[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";

/// Two sheets; the first begins in row 3, its names are shared texts, its times carry the format of a date.
InstrumentFile workbook(const std::string& name, bool with_dates) {
  std::string sheet =
      std::string(xml) +
      "<worksheet><sheetData><row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><r><t>Messung </t></r><r><t>4</t></r></is></c></row>"
      "<row r=\"3\"><c r=\"A3\" t=\"s\"><v>0</v></c><c r=\"B3\" t=\"s\"><v>1</v></c><c r=\"C3\" t=\"s\"><v>2</v></c></row>";
  for (int k = 0; k < rows; ++k) {
    // 46146.5 is noon of 2026-05-04; a day number holds the time to about a microsecond
    const std::string time =
        with_dates ? fmt::format("<c r=\"A{}\" s=\"1\"><v>{:.12f}</v></c>", k + 4, 46146.5 + k * interval / 86400)
                   : fmt::format("<c r=\"A{}\"><v>{:.6f}</v></c>", k + 4, k * interval);
    sheet += fmt::format(
        "<row r=\"{0}\">{1}<c r=\"B{0}\"><v>{2:.6f}</v></c><c r=\"C{0}\"><f>2*B{0}</f><v>{3:.6f}</v></c></row>", k + 4,
        time, drive(k), response(k));
  }
  sheet += "</sheetData></worksheet>";
  const std::string other =
      std::string(xml) +
      "<worksheet><sheetData><row><c t=\"inlineStr\"><is><t>notes</t></is></c></row></sheetData></worksheet>";
  return {
      name,
      zip_of(
          {{"[Content_Types].xml", std::string(xml) + "<Types/>"},
           {"xl/workbook.xml", std::string(xml) +
                                   "<workbook xmlns:r=\"r\"><sheets><sheet name=\"data\" sheetId=\"1\" r:id=\"rId1\"/>"
                                   "<sheet name=\"notes\" sheetId=\"2\" r:id=\"rId2\"/></sheets></workbook>"},
           {"xl/_rels/workbook.xml.rels",
            std::string(xml) + "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/sheet1.xml\"/>"
                               "<Relationship Id=\"rId2\" Target=\"/xl/worksheets/sheet2.xml\"/></Relationships>"},
           {"xl/styles.xml",
            std::string(xml) + "<styleSheet><cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"22\"/></cellXfs></styleSheet>"},
           {"xl/sharedStrings.xml",
            std::string(xml) +
                "<sst><si><t>Zeit [s]</t></si><si><t>drive [V]</t></si><si><t>sensor [V]</t></si></sst>"},
           {"xl/worksheets/sheet1.xml", sheet},
           {"xl/worksheets/sheet2.xml", other}}),
      "drive",
      "sensor",
      "V",
      0,
      0.51e-6,
      {"sheet \"data\" of a workbook", "lines above the header"},
      with_dates ? 1.1e-6 : 1e-9};
}

// ---- TDMS -----------------------------------------------------------------------------------------------------------

std::string tdms_text(const std::string& text) { return raw(static_cast<std::uint32_t>(text.size())) + text; }
std::string tdms_number(const std::string& name, double value) {
  return tdms_text(name) + raw<std::uint32_t>(10) + raw(value);
}
std::string tdms_count(const std::string& name, std::uint32_t value) {
  return tdms_text(name) + raw<std::uint32_t>(7) + raw(value);
}
std::string tdms_string(const std::string& name, const std::string& value) {
  return tdms_text(name) + raw<std::uint32_t>(0x20) + tdms_text(value);
}

std::string tdms_segment(std::uint32_t contents, const std::string& head, const std::string& data) {
  return "TDSm" + raw(contents) + raw<std::uint32_t>(4713) + raw<std::uint64_t>(head.size() + data.size()) +
         raw<std::uint64_t>(head.size()) + head + data;
}

std::string tdms_index(std::uint32_t type, std::uint64_t values) {
  return raw<std::uint32_t>(20) + raw(type) + raw<std::uint32_t>(1) + raw(values);
}

std::string waveform() {
  return tdms_number("wf_increment", interval) + tdms_number("wf_start_offset", -0.02) + tdms_text("wf_start_time") +
         raw<std::uint32_t>(0x44) + raw<std::uint64_t>(0) + raw<std::int64_t>(3'797'000'000);
}

/// Two segments of 20 rows. The drive is written as int16 counts of 0.5 mV behind two scales, the response as doubles.
InstrumentFile tdms(const std::string& name, bool interleaved) {
  const std::string scales =
      tdms_count("NI_Number_Of_Scales", 2) + tdms_string("NI_Scaling_Status", "unscaled") +
      tdms_string("NI_Scale[0]_Scale_Type", "Polynomial") + tdms_count("NI_Scale[0]_Polynomial_Coefficients_Size", 2) +
      tdms_number("NI_Scale[0]_Polynomial_Coefficients[0]", 4.0) +
      tdms_number("NI_Scale[0]_Polynomial_Coefficients[1]", 1.0) +
      tdms_count("NI_Scale[0]_Polynomial_Input_Source", 0xFFFFFFFFU) + tdms_string("NI_Scale[1]_Scale_Type", "Linear") +
      tdms_number("NI_Scale[1]_Linear_Slope", 0.0005) + tdms_number("NI_Scale[1]_Linear_Y_Intercept", -0.002) +
      tdms_count("NI_Scale[1]_Linear_Input_Source", 0) + tdms_string("unit_string", "Volts");
  const std::string head = raw<std::uint32_t>(4) + tdms_text("/") + raw(0xFFFFFFFFU) + raw<std::uint32_t>(0) +
                           tdms_text("/'run'") + raw(0xFFFFFFFFU) + raw<std::uint32_t>(0) +
                           tdms_text("/'run'/'drive'") + tdms_index(2, 20) + raw<std::uint32_t>(12 + 3) + scales +
                           waveform() + tdms_text("/'run'/'it''s'") + tdms_index(10, 20) + raw<std::uint32_t>(4) +
                           tdms_string("unit_string", "V") + waveform();
  const auto data = [&](int first) {
    std::string u, y, both;
    for (int k = first; k < first + 20; ++k) {
      const std::string count = raw(static_cast<std::int16_t>(std::lround(drive(k) / 0.0005))),
                        value = raw(response(k));
      u += count, y += value, both += count + value;
    }
    return interleaved ? both : u + y;
  };
  const std::uint32_t contents = interleaved ? 8U + 32U : 8U;
  return {name,    tdms_segment(contents + 2U + 4U, head, data(0)) + tdms_segment(contents, "", data(20)),
          "drive", "it's",
          "V",     -0.02,
          0.26e-3, {"a TDMS file", "times from the sample interval 0.001 s, from -0.02 s on"}};
}

// ---- MAT ------------------------------------------------------------------------------------------------------------

std::string mat_element(std::uint32_t type, std::string data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  data.resize((data.size() + 7) / 8 * 8);
  return raw(type) + raw(size) + data;
}

std::string mat_matrix(const std::string& name, std::uint32_t kind, std::int32_t n, std::int32_t m,
                       const std::string& content) {
  return mat_element(14, mat_element(6, raw(kind) + raw<std::uint32_t>(0)) + mat_element(5, raw(n) + raw(m)) +
                             mat_element(1, name) + content);
}

std::string mat_vector(const std::string& name, const std::vector<double>& values) {
  std::string data;
  for (const double v : values) data += raw(v);
  return mat_matrix(name, 6, static_cast<std::int32_t>(values.size()), 1, mat_element(9, data));
}
std::string mat_text(const std::string& name, const std::string& text) {
  std::string data;
  for (const char c : text) data += raw(static_cast<std::uint16_t>(c));
  return mat_matrix(name, 4, 1, static_cast<std::int32_t>(text.size()), mat_element(4, data));
}

/// Names of at most 31 letters, then the fields of each element.
std::string mat_struct(const std::string& name, std::int32_t elements, const std::vector<std::string>& names,
                       const std::string& fields) {
  std::string list;
  for (std::string field : names) {
    field.resize(32);
    list += field;
  }
  return mat_matrix(name, 2, 1, elements,
                    raw<std::uint32_t>(5 | 4U << 16) + raw<std::uint32_t>(32) + mat_element(1, list) + fields);
}

std::string mat_head() {
  std::string head = "MATLAB 5.0 MAT-file, written by a test";
  head.resize(124, ' ');
  return head + raw<std::uint16_t>(0x0100) + "IM";
}

/// As version 7 stands on the disk: the element within a zlib stream, here of one block that is stored as it is.
std::string mat_compressed(const std::string& element) {
  std::uint32_t a = 1, b = 0;
  for (const char c : element) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  const auto size = static_cast<std::uint16_t>(element.size());
  std::string stream = "\x78\x01\x01" + raw(size) + raw(static_cast<std::uint16_t>(~size)) + element;
  for (const std::uint32_t part : {b, a}) stream += {static_cast<char>(part >> 8), static_cast<char>(part & 255)};
  return raw<std::uint32_t>(15) + raw(static_cast<std::uint32_t>(stream.size())) + stream;
}

/// Level 4: kind, rows, columns, whether complex, length of the name, the name, numbers; 1000 = big-endian doubles.
InstrumentFile mat_4(const std::string& file, bool big_endian) {
  const auto bytes_of = [&](auto value) {
    std::string bytes = raw(value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  const auto vector = [&](const std::string& name, const std::vector<double>& values) {
    std::string bytes;
    for (const std::int32_t head : {big_endian ? 1000 : 0, rows, 1, 0, static_cast<std::int32_t>(name.size()) + 1})
      bytes += bytes_of(head);
    bytes += name + '\0';
    for (const double value : values) bytes += bytes_of(value);
    return bytes;
  };
  return {
      file,    vector("t", samples(time_of)) + vector("drive", samples(drive)) + vector("response", samples(response)),
      "drive", "response",
      "",      0,
      1e-15,   {"a MAT file"}};
}

InstrumentFile mat_5() {
  return {"vectors.mat",
          mat_head() + mat_vector("t", samples(time_of)) + mat_vector("gain", {2}) +
              mat_vector("drive", samples(drive)) + mat_vector("response", samples(response)),
          "drive",
          "response",
          "",
          0,
          1e-15,
          {"a MAT file"}};
}

InstrumentFile mat_7() {
  return {"compressed.mat",
          mat_head() + mat_compressed(mat_vector("time", samples(time_of))) +
              mat_compressed(mat_vector("drive", samples(drive))) +
              mat_compressed(mat_vector("response", samples(response))),
          "drive",
          "response",
          "",
          0,
          1e-15,
          {"a MAT file"}};
}

/// "Structure with time" of Simulink: time, and signals with values and label.
InstrumentFile simulink() {
  const std::string signals = mat_struct("", 2, {"values", "label"},
                                         mat_vector("", samples(drive)) + mat_text("", "drive") +
                                             mat_vector("", samples(response)) + mat_text("", "sensor"));
  return {"simulink.mat",
          mat_head() + mat_struct("out", 1, {"time", "signals"}, mat_vector("", samples(time_of)) + signals),
          "drive",
          "sensor",
          "",
          0,
          1e-15,
          {}};
}

/// PicoScope: channels A and B, Tstart and Tinterval.
InstrumentFile picoscope_mat() {
  return {"picoscope.mat",
          mat_head() + mat_vector("Tstart", {-0.02}) + mat_vector("Tinterval", {interval}) +
              mat_vector("Length", {40}) + mat_vector("A", samples(drive)) + mat_vector("B", samples(response)),
          "A",
          "B",
          "",
          -0.02,
          1e-15,
          {"times from the sample interval 0.001 s"}};
}

}  // namespace

std::vector<InstrumentFile> binary_files() {
  return {lvm("one.lvm", "One", false),
          lvm("none.lvm", "No", true),
          lvm("multi.lvm", "Multi", true),
          workbook("numbers.xlsx", false),
          workbook("dates.xlsx", true),
          tdms("blocks.tdms", false),
          tdms("rows.tdms", true),
          mat_4("level4.mat", false),
          mat_4("level4_big_endian.mat", true),
          mat_5(),
          mat_7(),
          simulink(),
          picoscope_mat()};
}

std::string tdms_of_daqmx() {
  const std::string head =
      raw<std::uint32_t>(1) + tdms_text("/'a'/'b'") + raw<std::uint32_t>(0x1269) + raw<std::uint32_t>(0);
  return tdms_segment(2 + 4 + 8 + 128, head, "");
}

std::string tdms_of_scaling(const std::string& type) {
  const std::string head = raw<std::uint32_t>(1) + tdms_text("/'a'/'b'") + tdms_index(10, 2) + raw<std::uint32_t>(2) +
                           tdms_count("NI_Number_Of_Scales", 1) + tdms_string("NI_Scale[0]_Scale_Type", type);
  return tdms_segment(2 + 4 + 8, head, raw(1.0) + raw(2.0));
}

/// Two groups with times of their own.
std::string mat_of_two_groups() {
  const auto group = [](const std::string& name, double slow) {
    return mat_struct(name, 1, {"t", "y"}, mat_vector("", {0, slow, 2 * slow}) + mat_vector("", {1, 2, 3}));
  };
  return mat_head() + group("monday", 1) + group("tuesday", 2);
}

std::string mat_of_lost_numbers(int depth) {
  std::string inside = mat_matrix("", 6, 1 << 28, 1, mat_element(9, raw(1.0)));
  for (int k = 0; k < depth; ++k) inside = mat_struct(k + 1 < depth ? "" : "deep", 1, {"a"}, inside);
  return mat_5().bytes + inside;
}

}  // namespace hysteron::instruments
