// Paths as links.
#include "engine/diagram/percent_text.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(PercentText, WhatIsReservedIsEscapedByteByByte) {
  EXPECT_EQ(percent_encoded("traces/a b\".csv"), "traces/a%20b%22.csv");
  EXPECT_EQ(percent_encoded("/tmp/~x_1-2/100%/\xc3\xbc:?#"), "/tmp/~x_1-2/100%25/%C3%BC%3A%3F%23");
}

}  // namespace
}  // namespace hysteron
