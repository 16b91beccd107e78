#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/utils/nlohmann_json_utils.hpp>
#include <valijson/validator.hpp>

#include "forms_sample.h"

#include <welkin/error.h>

// docs/schemas/sh.schema.json against files that are right and files that are not; and the reader agrees with it.

namespace welkin {
namespace {

using Json = nlohmann::json;

class Schema {
 public:
  Schema() {
    Json document;
    EXPECT_TRUE(valijson::utils::loadDocument(WELKIN_SCHEMAS "/sh.schema.json", document));
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema_);
  }
  bool accepts(const Json& json) const {
    valijson::Validator validator;
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
  }

 private:
  valijson::Schema schema_;
};

bool reader_accepts(const Json& json) {
  try {
    read_sh_text(json.dump());
    return true;
  } catch (const Error&) {
    return false;
  }
}

ShDocument sample(int degree, ShQuantity quantity) {
  ShDocument document = random_document(1, degree);
  document.quantity = quantity;
  if (degree == 2) document.lights = {{{0.6, 0, 0.8}, {1, 2, 3}, 0.01}};
  return document;
}

TEST(ShSchema, AcceptsWhatIsWritten) {
  const Schema schema;
  for (int degree : {0, 1, 2, 3, 4, 7})
    for (ShQuantity quantity :
         {ShQuantity::radiance, ShQuantity::irradiance, ShQuantity::irradiance_over_pi}) {
      const Json json = Json::parse(write_sh(sample(degree, quantity), ShForm::json));
      EXPECT_TRUE(schema.accepts(json)) << degree;
      EXPECT_TRUE(reader_accepts(json)) << degree;
    }
}

TEST(ShSchema, AndTheReaderRefuseWhatIsNot) {
  const Schema schema;
  const std::pair<const char*, std::function<void(Json&)>> damages[] = {
      {"no quantity", [](Json& j) { j.erase("quantity"); }},
      {"no degree", [](Json& j) { j.erase("max_degree"); }},
      {"no convention", [](Json& j) { j.erase("convention"); }},
      {"no coefficients", [](Json& j) { j.erase("coefficients"); }},
      {"another quantity", [](Json& j) { j["quantity"] = "luminance"; }},
      {"a quantity that the convention contradicts", [](Json& j) { j["quantity"] = "irradiance"; }},
      {"a degree below 0", [](Json& j) { j["max_degree"] = -1; }},
      {"a degree too large", [](Json& j) { j["max_degree"] = 129; }},
      {"a degree in words", [](Json& j) { j["max_degree"] = "2"; }},
      {"another degree", [](Json& j) { j["max_degree"] = 1; }},
      {"a row missing", [](Json& j) { j["coefficients"].erase(3); }},
      {"a row too many",
       [](Json& j) {
         j["coefficients"].push_back({1, 2, 3});
       }},
      {"a channel missing", [](Json& j) { j["coefficients"][4].erase(0); }},
      {"a channel too many", [](Json& j) { j["coefficients"][4].push_back(1); }},
      {"a number in words", [](Json& j) { j["coefficients"][0][0] = "1"; }},
      {"null", [](Json& j) { j["coefficients"][0][0] = nullptr; }},
      {"rows that are none", [](Json& j) { j["coefficients"] = 1; }},
      {"the other sign", [](Json& j) { j["convention"]["condon_shortley_sign"] = true; }},
      {"another index", [](Json& j) { j["convention"]["index"] = "m-major"; }},
      {"another axis", [](Json& j) { j["convention"]["polar_axis"] = "y"; }},
      {"constants", [](Json& j) { j["convention"]["basis_constants_applied"] = true; }},
      {"a source that is none", [](Json& j) { j["source"] = 1; }},
      {"lights that are none", [](Json& j) { j["lights"] = 1; }},
      {"a light without irradiance", [](Json& j) { j["lights"][0].erase("irradiance"); }},
      {"a light that darkens", [](Json& j) { j["lights"][0]["irradiance"][1] = -1; }},
      {"a direction too long", [](Json& j) { j["lights"][0]["direction"][0] = 2; }},
      {"a radius of half the sphere", [](Json& j) { j["lights"][0]["angular_radius_degrees"] = 180; }},
      {"no word of the cosine", [](Json& j) { j["convention"].erase("cosine_applied"); }},
      {"a list", [](Json& j) { j = Json::array({j}); }}};
  const Json good = Json::parse(write_sh(sample(2, ShQuantity::radiance), ShForm::json));
  for (const auto& [what, damage] : damages) {
    Json json = good;
    damage(json);
    EXPECT_FALSE(schema.accepts(json)) << what;
    EXPECT_FALSE(reader_accepts(json)) << what;
  }
}

}  // namespace
}  // namespace welkin
