#include "io/formats/tdms_scaling.h"

#include <fmt/format.h>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr int most_scales = 64;

class Chain {
 public:
  Chain(const std::vector<double>& counts, const TdmsProperties& properties, const std::string& channel,
        const std::string& file)
      : counts_(counts), properties_(properties), channel_(channel), file_(file) {}

  /// What comes out of scale `index`, or the counts themselves (0xFFFFFFFF). A scale rests on those before it.
  std::vector<double> values(double index, int below = most_scales) {
    const int scale = index >= 0 && index < most_scales ? static_cast<int>(index) : -1;
    if (scale < 0) return counts_;
    if (scale >= below) refuse("damaged_file", "a scale rests on itself", "export the file again, or as CSV");
    if (const auto done = done_.find(scale); done != done_.end()) return done->second;
    return done_[scale] = computed(scale);
  }

 private:
  std::vector<double> computed(int scale) {
    const std::string type = text_property(properties_, key(scale, "Scale_Type"));
    if (type == "Linear") return linear(scale);
    if (type == "Polynomial") return polynomial(scale);
    if (type == "Add" || type == "Subtract") return sum(scale, type);
    refuse("unknown_scaling", fmt::format("channel {} has a scaling \"{}\", which is not known here", channel_, type),
           "write the file with scaled values, or export it as CSV");
  }

  [[noreturn]] void refuse(std::string code, std::string what, std::string cure) const {
    throw Error(Fault::input, {{std::move(code), channel_, std::move(what), std::move(cure), file_, 0}});
  }

  static std::string key(int scale, const std::string& name) { return fmt::format("NI_Scale[{}]_{}", scale, name); }
  double number(int scale, const std::string& name, double otherwise) const {
    return number_property(properties_, key(scale, name)).value_or(otherwise);
  }

  std::vector<double> linear(int scale) {
    std::vector<double> v = values(number(scale, "Linear_Input_Source", -1), scale);
    const double slope = number(scale, "Linear_Slope", 1), zero = number(scale, "Linear_Y_Intercept", 0);
    for (double& x : v) x = slope * x + zero;
    return v;
  }

  std::vector<double> polynomial(int scale) {
    std::vector<double> v = values(number(scale, "Polynomial_Input_Source", -1), scale);
    const double size = number(scale, "Polynomial_Coefficients_Size", 4);
    if (!(size >= 0 && size <= 1000))
      refuse("damaged_file", "a polynomial has no number of coefficients", "export the file again");
    std::vector<double> c(static_cast<std::size_t>(size));
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = number(scale, fmt::format("Polynomial_Coefficients[{}]", k), 0);
    for (double& x : v) {
      double y = 0;
      for (std::size_t k = c.size(); k-- > 0;) y = y * x + c[k];
      x = y;
    }
    return v;
  }

  std::vector<double> sum(int scale, const std::string& type) {
    std::vector<double> a = values(number(scale, type + "_Left_Operand_Input_Source", -1), scale);
    const std::vector<double> b = values(number(scale, type + "_Right_Operand_Input_Source", -1), scale);
    // As the layout has it: "Subtract" takes the left operand from the right one.
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = type == "Add" ? a[k] + b[k] : b[k] - a[k];
    return a;
  }

  const std::vector<double>& counts_;
  const TdmsProperties& properties_;
  const std::string &channel_, &file_;
  std::map<int, std::vector<double>> done_;
};

}  // namespace

std::string text_property(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  const auto* text = found == properties.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text == nullptr ? "" : *text;
}

std::optional<double> number_property(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  const auto* number = found == properties.end() ? nullptr : std::get_if<double>(&found->second);
  return number == nullptr ? std::nullopt : std::optional(*number);
}

std::vector<double> scaled(std::vector<double> counts, const TdmsProperties& properties, const std::string& channel,
                           const std::string& file) {
  const auto scales = number_property(properties, "NI_Number_Of_Scales");
  if (!scales || !(*scales >= 1) || text_property(properties, "NI_Scaling_Status") == "scaled") return counts;
  if (*scales > most_scales)
    throw Error(Fault::input, {{"damaged_file", channel, "a channel has more scales than any device",
                                "export the file again", file, 0}});
  return Chain(counts, properties, channel, file).values(*scales - 1);
}

}  // namespace hysteron
