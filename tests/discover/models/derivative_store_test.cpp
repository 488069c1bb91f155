// What fits leave to later ones, and what those beside each other see of it.
#include "discover/models/derivative_store.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

std::shared_ptr<const Dense> of_size(std::size_t numbers) {
  Dense d;
  d.rows = numbers;
  d.cols = 1;
  d.a.assign(numbers, 1.0);
  return std::make_shared<const Dense>(std::move(d));
}

TEST(DerivativeStore, KnowsWhatWasWrittenLast) {
  DerivativeStore notes;
  EXPECT_EQ(notes.derivatives_of("lag"), nullptr);
  notes.keep("lag", of_size(3));
  const auto last = of_size(3);
  notes.keep("lag", last);
  EXPECT_EQ(notes.derivatives_of("lag"), last);
}

TEST(DerivativeStore, FitsBesideEachOtherSeeWhatWasWrittenBeforeThem) {
  const auto notes = std::make_shared<DerivativeStore>();
  const auto before = of_size(1), first = of_size(1), second = of_size(1);
  notes->keep("lag", before);
  DerivativeStore one(notes), other(notes);
  one.keep("lag", first);
  other.keep("creep", second);
  one.count(5);
  other.count(7);
  EXPECT_EQ(one.derivatives_of("lag"), first);
  EXPECT_EQ(other.derivatives_of("lag"), before);
  EXPECT_EQ(one.derivatives_of("creep"), nullptr);
  EXPECT_EQ(notes->derivatives_of("lag"), before);
  notes->add(one);
  notes->add(other);  // has not written about the lag: what it saw there does not come back
  EXPECT_EQ(notes->derivatives_of("lag"), first);
  EXPECT_EQ(notes->derivatives_of("creep"), second);
  EXPECT_EQ(notes->runs(), 12);
}

TEST(DerivativeStore, ForgetsAllBeforeItOutgrowsMemory) {
  DerivativeStore notes;
  notes.keep("lag", of_size(6'000'000));
  notes.keep("lag", of_size(6'000'000));  // in place of the first
  EXPECT_NE(notes.derivatives_of("lag"), nullptr);
  notes.keep("creep", of_size(6'000'000));
  EXPECT_EQ(notes.derivatives_of("lag"), nullptr);
  EXPECT_NE(notes.derivatives_of("creep"), nullptr);
}

}  // namespace
}  // namespace hysteron
