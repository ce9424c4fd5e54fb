#include <pantin/bridge/writers/json_stream.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace pantin {
namespace {

std::string written(const std::function<void(JsonStream&)>& write) {
  std::ostringstream out;
  JsonStream json{out};
  write(json);
  return out.str();
}

TEST(JsonStream, NestsObjectsAndArrays) {
  // A reader of another make has to find the same structure, in whichever layout it was written.
  for (const JsonLayout layout : {JsonLayout::Compact, JsonLayout::Lines}) {
    const std::string text = written([&](JsonStream& json) {
      json.begin_object(layout).member("a", std::int64_t{1}).key("b").begin_array(layout);
      json.value(true).null().begin_object().end_object().begin_array().end_array().end_array();
      json.member("c", "d").end_object();
    });
    EXPECT_EQ(nlohmann::json::parse(text), nlohmann::json::parse(R"({"a":1,"b":[true,null,{},[]],"c":"d"})"))
        << text;
  }
}

TEST(JsonStream, NumbersReadBackToTheSameDouble) {
  // Round trip over random bit patterns, seeded; what is not finite has no JSON form and is null.
  std::mt19937_64 random{7};
  for (int i = 0; i < 10000; ++i) {
    double number = 0;
    const std::uint64_t bits = random();
    std::memcpy(&number, &bits, sizeof number);
    const std::string text = written([&](JsonStream& json) { json.value(number); });
    if (std::isfinite(number)) EXPECT_EQ(nlohmann::json::parse(text).get<double>(), number) << text;
    else EXPECT_EQ(text, "null");
  }
}

TEST(JsonStream, TextsSurviveWhateverTheyHold) {
  // Quotes, controls and UTF-8 read back; bytes that are no UTF-8 become the replacement character, never an
  // exception.
  const std::string odd = "a\"b\\c\n\x01\xC3\xA9";
  EXPECT_EQ(nlohmann::json::parse(written([&](JsonStream& json) { json.value(odd); })), odd);
  const std::string broken =
      written([](JsonStream& json) { json.begin_object().member("\xFF", "\xC3").end_object(); });
  EXPECT_EQ(nlohmann::json::parse(broken), nlohmann::json::parse(R"({"\ufffd": "\ufffd"})"));
}

TEST(JsonStream, WritesMatricesByRows) {
  // Column vectors: the translation stands in the last column of each row; quaternions begin with w.
  Affine M = Affine::Identity();
  M.translation() = Vector3{1, 2, 3};
  M.linear()(0, 1) = 5;
  EXPECT_EQ(
      nlohmann::json::parse(written([&](JsonStream& json) { json.value(M); })),
      nlohmann::json::parse("[[1.0,5.0,0.0,1.0],[0.0,1.0,0.0,2.0],[0.0,0.0,1.0,3.0],[0.0,0.0,0.0,1.0]]"));
  EXPECT_EQ(written([](JsonStream& json) { json.value(Quaternion{1, 2, 3, 4}); }), "[1.0, 2.0, 3.0, 4.0]\n");
}

}  // namespace
}  // namespace pantin
