// TOML as JSON: names, order and kinds of values kept; and what becomes of text and numbers that JSON has not.
#include "core/json/toml_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "core/json/json_text.hpp"
#include "core/json/keys_json.hpp"

namespace weaveform {
namespace {

using OrderedJson = nlohmann::ordered_json;

TEST(TomlJson, KeepsNamesOrderAndKinds) {
  const OrderedJson json = toml_file_json(
      "zeta = 1\nalpha = 2.5\n[tools.punch]\nshape = \"sphere\"\n[[grip]]\nname = \"top\"\nheld = true\n", "s.toml");
  EXPECT_EQ(json.dump(),
            R"({"zeta":1,"alpha":2.5,"tools":{"punch":{"shape":"sphere"}},"grip":[{"name":"top","held":true}]})");
}

TEST(TomlJson, OfAValueIsTheValue) {
  EXPECT_EQ(toml_value_json("[100.0, 2]").dump(), "[100.0,2]");
  EXPECT_EQ(toml_value_json("\"auto\""), "auto");
  EXPECT_EQ(toml_value_json("1979-05-27"), "1979-05-27") << "a date is text";
  EXPECT_TRUE(toml_value_json("").is_null());
  EXPECT_THROW((void)toml_value_json("auto"), InputError);
}

TEST(JsonText, IsValidWhateverIsInIt) {
  EXPECT_EQ(json_text({{"name", "b\xF6x"}, {"value", std::numeric_limits<double>::quiet_NaN()}}),
            "{\n  \"name\": \"b\xEF\xBF\xBDx\",\n  \"value\": null\n}\n");
}

TEST(KeysJson, SaysWhatTheTableSays) {
  const OrderedJson keys = keys_json({{"blank", "size", "2 numbers", "mm", "[115, 230]", "> 0 mm", false, "extent"},
                                      {"", "name", "text", "", "", "", true, "of the fabric"}});
  EXPECT_EQ(keys[0]["key"], "blank.size");
  EXPECT_EQ(keys[0]["default"].dump(), "[115,230]");
  EXPECT_EQ(keys[0]["range"], "> 0 mm");
  EXPECT_EQ(keys[1]["key"], "name");
  EXPECT_TRUE(keys[1]["default"].is_null());
  EXPECT_TRUE(keys[1]["required"].get<bool>());
}

}  // namespace
}  // namespace weaveform
