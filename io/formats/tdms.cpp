// Decides how a TDMS file of LabVIEW is read, from its published layout ("TDMS File Format Internal Structure"):
// segments with a lead-in, what changed since the segment before, and samples channel by channel or interleaved. How
// counts become values of a channel is tdms_scaling.h.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/formats/file_format.h"
#include "io/formats/named_vectors.h"
#include "io/formats/tdms_scaling.h"

namespace hysteron {
namespace {

enum Contents : std::uint32_t {
  has_objects = 2,
  new_list = 4,
  has_samples = 8,
  interleaved = 32,
  big_endian = 64,
  daqmx = 128
};
enum Type : std::uint32_t {
  i8 = 1,
  i16,
  i32,
  i64,
  u8,
  u16,
  u32,
  u64,
  real_32,
  real_64,
  real_32_unit = 0x19,
  real_64_unit = 0x1A,
  text = 0x20,
  truth = 0x21,
  moment = 0x44
};
constexpr std::size_t lead_in = 28;
constexpr std::size_t longest_list = 1 << 20;  // of objects or properties: more is damage

/// Bytes in each sample; 0 for what is no number.
std::size_t size_of(std::uint32_t type) {
  switch (type) {
    case i8:
    case u8:
    case truth:
      return 1;
    case i16:
    case u16:
      return 2;
    case i32:
    case u32:
    case real_32:
    case real_32_unit:
      return 4;
    case i64:
    case u64:
    case real_64:
    case real_64_unit:
      return 8;
    case moment:
      return 16;
    default:
      return 0;
  }
}

struct TdmsChannel {
  std::string name;  ///< "group/channel"
  std::uint32_t type = 0;
  std::uint64_t values = 0;  ///< in each chunk of the segment
  std::uint64_t bytes = 0;   ///< of texts
  bool has_index = false;
  std::vector<double> samples{};
  TdmsProperties properties{};
};

class TdmsReader {
 public:
  TdmsReader(const std::string& file, const ReadingChoices& choices) : choices_(choices), bytes_(read_file(file)) {
    table_.file = file;
  }

  MeasuredTable read() {
    for (std::size_t begin = 0; begin + lead_in <= bytes_.size();) begin = segment(begin);
    table_.assumed.push_back("a TDMS file");
    std::vector<MeasuredColumn> vectors;
    for (auto& channel : channels_) {
      if (channel.samples.empty() || !is_wanted(channel)) continue;
      clock(channel);
      const std::string unit = channel.type == moment ? "s" : text_property(channel.properties, "unit_string");
      vectors.push_back(
          {channel.name, unit, scaled(std::move(channel.samples), channel.properties, channel.name, table_.file)});
    }
    return table_of_vectors(std::move(table_), std::move(vectors), choices_);
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(Fault::input, {{"damaged_file", table_.file, fmt::format("this TDMS file cannot be read: {}", why),
                                "export it again, or as CSV", table_.file, 0}});
  }

  // ---- bytes --------------------------------------------------------------------------------------------------------

  std::uint64_t unsigned_at(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) damaged("it ends within a segment");
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k)
      value = value << 8 | static_cast<unsigned char>(bytes_[at + (big_ ? k : size - 1 - k)]);
    return value;
  }
  std::uint64_t take(std::size_t size) {
    const std::uint64_t value = unsigned_at(at_, size);
    at_ += size;
    return value;
  }
  std::uint32_t take_32() { return static_cast<std::uint32_t>(take(4)); }
  std::string take_text() {
    const std::size_t length = take_32();
    if (length > bytes_.size() - at_) damaged("a name is longer than the file");
    at_ += length;
    return bytes_.substr(at_ - length, length);
  }

  double number_at(std::size_t at, std::uint32_t type) const {
    const std::size_t size = size_of(type);
    if (type == moment) {  // 2^-64 s, and whole seconds since 1904
      const std::uint64_t a = unsigned_at(at, 8), b = unsigned_at(at + 8, 8);
      const std::uint64_t fraction = big_ ? b : a, seconds = big_ ? a : b;
      return static_cast<double>(static_cast<std::int64_t>(seconds) - first_second_) +
             std::ldexp(static_cast<double>(fraction), -64);
    }
    const std::uint64_t bits = unsigned_at(at, size);
    switch (type) {
      case i8:
        return static_cast<std::int8_t>(bits);
      case i16:
        return static_cast<std::int16_t>(bits);
      case i32:
        return static_cast<std::int32_t>(bits);
      case i64:
        return static_cast<double>(static_cast<std::int64_t>(bits));
      case real_32:
      case real_32_unit:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case real_64:
      case real_64_unit:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  // ---- segments -----------------------------------------------------------------------------------------------------

  std::size_t segment(std::size_t begin) {
    if (bytes_.compare(begin, 4, "TDSm") != 0) damaged("a segment does not begin where the one before it ends");
    big_ = false;
    const auto contents = static_cast<std::uint32_t>(unsigned_at(begin + 4, 4));
    big_ = (contents & big_endian) != 0;
    const std::uint64_t length = unsigned_at(begin + 12, 8), head = unsigned_at(begin + 20, 8);
    const std::size_t rest = bytes_.size() - begin - lead_in;
    const bool open = length > rest;  // all ones where the program that recorded it ended early
    if (open && length != ~std::uint64_t{0}) table_.assumed.push_back("the last segment is not complete");
    const std::size_t end = open ? bytes_.size() : begin + lead_in + static_cast<std::size_t>(length);
    if (head > end - begin - lead_in) damaged("a segment is shorter than its own head");
    at_ = begin + lead_in;
    if ((contents & has_objects) != 0) objects((contents & new_list) != 0);
    if ((contents & daqmx) != 0 && (contents & has_samples) != 0) refuse_daqmx();
    if ((contents & has_samples) != 0)
      samples(begin + lead_in + static_cast<std::size_t>(head), end, (contents & interleaved) != 0);
    return end;
  }

  [[noreturn]] void refuse_daqmx() const {
    throw Error(Fault::input,
                {{"unknown_file_type", table_.file,
                  "this is a TDMS file with DAQmx scalings, whose raw counts are not read here",
                  "write it anew with scaled values: LabVIEW \"TDMS Convert Format\", DIAdem, or export it as CSV",
                  table_.file, 0}});
  }

  void objects(bool anew) {
    if (anew) order_.clear();
    const std::size_t count = take_32();
    if (count > longest_list) damaged("it has more objects than bytes");
    for (std::size_t k = 0; k < count; ++k) object(take_text());
  }

  /// "/'group'/'channel'" as "group/channel"; "" for what is no channel.
  static std::string channel_name(const std::string& path) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (path[i] != '\'') continue;
      std::string part;
      for (++i; i < path.size(); ++i) {
        if (path[i] == '\'' && (i + 1 >= path.size() || path[i + 1] != '\'')) break;
        if (path[i] == '\'') ++i;
        part += path[i] == '/' ? '.' : path[i];
      }
      parts.push_back(std::move(part));
    }
    return parts.size() == 2 ? parts[0] + "/" + parts[1] : "";
  }

  void object(const std::string& path) {
    const auto [found, is_new] = index_.emplace(path, channels_.size());
    if (is_new) channels_.push_back({channel_name(path)});
    TdmsChannel& channel = channels_[found->second];
    const std::uint32_t index = take_32();
    if (index == 0x1269 || index == 0x126A || index == 0x1369) refuse_daqmx();
    if (index != 0xFFFFFFFFU) {
      if (index != 0) raw_index(channel);
      if (!channel.has_index) damaged("a channel says that it is as before, and was not there");
      if (std::find(order_.begin(), order_.end(), found->second) == order_.end()) order_.push_back(found->second);
    }
    const std::size_t count = take_32();
    if (count > longest_list) damaged("it has more properties than bytes");
    for (std::size_t k = 0; k < count; ++k) property(channel);
  }

  void raw_index(TdmsChannel& channel) {
    const std::uint32_t type = take_32();
    if (take_32() != 1) damaged("a channel has more than one dimension");
    channel.values = take(8);
    channel.bytes = type == text ? take(8) : 0;
    if (type != text && size_of(type) == 0)
      damaged(fmt::format("\"{}\" has samples of the unknown type {}", channel.name, type));
    if (channel.has_index && channel.type != type && !channel.samples.empty()) damaged("a channel changes its type");
    if (channel.values > bytes_.size()) damaged("a channel has more samples than the file has bytes");
    channel.type = type;
    channel.has_index = true;
  }

  void property(TdmsChannel& channel) {
    const std::string name = take_text();
    const std::uint32_t type = take_32();
    if (type == text) {
      channel.properties[name] = take_text();
    } else if (type == moment) {
      channel.properties[name] = fmt::format("{} {}", unsigned_at(at_, 8), unsigned_at(at_ + 8, 8));
      at_ += 16;
    } else {
      const std::size_t size = size_of(type);
      if (size == 0) damaged(fmt::format("the property {} has the unknown type {}", name, type));
      channel.properties[name] = number_at(at_, type);
      at_ += size;
    }
  }

  // ---- samples ------------------------------------------------------------------------------------------------------

  void samples(std::size_t begin, std::size_t end, bool rows) {
    std::uint64_t chunk = 0;
    for (const auto c : order_)
      chunk += channels_[c].type == text ? channels_[c].bytes : channels_[c].values * size_of(channels_[c].type);
    if (chunk == 0) return;
    LookUp look_up;
    for (std::size_t at = begin; at < end; at += static_cast<std::size_t>(chunk)) {
      look_up();
      if (rows)
        interleaved_chunk(at, end);
      else
        chunk_by_channel(at, end);
      if (chunk > end - at) break;
    }
  }

  void append(TdmsChannel& channel, std::size_t at) {
    if (channel.type == moment && channel.samples.empty())
      first_second_ = static_cast<std::int64_t>(unsigned_at(big_ ? at : at + 8, 8));
    channel.samples.push_back(number_at(at, channel.type));
  }

  void chunk_by_channel(std::size_t at, std::size_t end) {
    for (const auto c : order_) {
      TdmsChannel& channel = channels_[c];
      if (channel.type == text) {
        at += static_cast<std::size_t>(std::min<std::uint64_t>(channel.bytes, end - at));
        continue;
      }
      const std::size_t size = size_of(channel.type);
      for (std::uint64_t k = 0; k < channel.values && at + size <= end; ++k, at += size) append(channel, at);
    }
  }

  void interleaved_chunk(std::size_t at, std::size_t end) {
    std::size_t row = 0;
    std::uint64_t rows = 0;
    for (const auto c : order_) {
      if (channels_[c].type == text) damaged("texts are interleaved with numbers");
      row += size_of(channels_[c].type);
      rows = std::max(rows, channels_[c].values);
    }
    for (std::uint64_t k = 0; k < rows && at + row <= end; ++k)
      for (const auto c : order_) {
        append(channels_[c], at);
        at += size_of(channels_[c].type);
      }
  }

  // ---- times --------------------------------------------------------------------------------------------------------

  bool is_wanted(const TdmsChannel& channel) const {
    return !channel.name.empty() && (choices_.group.empty() || channel.name.starts_with(choices_.group + "/"));
  }

  /// Increment, offset and start of a waveform: of all channels the same, or they are no rows of one table.
  void clock(const TdmsChannel& channel) {
    const auto interval = number_property(channel.properties, "wf_increment");
    if (!interval || !(*interval > 0)) return;
    const double start = number_property(channel.properties, "wf_start_offset").value_or(0);
    const std::string begin = text_property(channel.properties, "wf_start_time");
    if (!table_.clock) {
      table_.clock = SampleClock{start, *interval};
      start_time_ = begin;
      first_ = channel.name;
      return;
    }
    if (table_.clock->interval == *interval && table_.clock->start == start && start_time_ == begin) return;
    throw Error(
        Fault::input,
        {{"ambiguous_time", channel.name,
          fmt::format("channel {} was sampled at other times than {}", channel.name, first_),
          "choose a group whose channels were sampled together (--group NAME), or export them into files of their own",
          table_.file, 0}});
  }

  const ReadingChoices& choices_;
  MeasuredTable table_;
  std::string bytes_;
  std::size_t at_ = 0;
  bool big_ = false;
  std::int64_t first_second_ = 0;
  std::map<std::string, std::size_t> index_;
  std::vector<TdmsChannel> channels_;
  std::vector<std::size_t> order_;  ///< of the channels in the samples of a segment
  std::string start_time_, first_;
};

}  // namespace

bool is_tdms(std::string_view bytes) { return bytes.starts_with("TDSm"); }

MeasuredTable read_tdms(const std::string& file, const ReadingChoices& choices) {
  return TdmsReader(file, choices).read();
}

}  // namespace hysteron
