// Choices: each table names every value of its enum once, and a choice reads, writes and complains as its words do.
#include <gtest/gtest.h>

#include <set>

#include "app/study/choices.hpp"
#include "core/files/csv_format.hpp"
#include "core/keys/choice_value.hpp"
#include "fabric/identify/choices.hpp"
#include "mesher/exchange/export.hpp"
#include "mesher/scene/choices.hpp"
#include "post/dic/readers/choices.hpp"
#include "post/dic/settings/choices.hpp"
#include "post/transfer/write_fibre.hpp"

namespace weaveform {
namespace {

template <class Enum>
class ChoiceTable : public testing::Test {};

using Tables = testing::Types<BlankShape, LineFit, YarnElement, SeatbeltPartner, CellElement, Formulation, Thickness,
                              Section, YarnLaw, SymmetryUse, BlankEdge, Component, ToolShape, StepBound, LengthUnit,
                              Delimiter, DecimalSign, identify::ShearSource, identify::FormAsked, identify::TestedYarn,
                              identify::StrainKind, identify::StressKind, dic::MeasurementFormat, dic::MeasuredUnit,
                              dic::YAxis, dic::PositionOf, dic::GridZeros, dic::MatchBy, dic::RegistrationMethod,
                              dic::SpecimenMotion, dic::FieldSymmetry, dic::FieldsWritten, study::Finer,
                              study::ErrorReference, study::BisectionScale, MeshFormat, Materials, FibreFormat>;
TYPED_TEST_SUITE(ChoiceTable, Tables);

// In the order of the enum, so that none can be left out.
TYPED_TEST(ChoiceTable, NamesEveryValueOnce) {
  const auto table = choices_of(TypeParam{});
  std::set<std::string> names;
  for (std::size_t k = 0; k < table.size(); ++k) {
    EXPECT_EQ(table[k].value, static_cast<TypeParam>(k)) << table[k].name;
    EXPECT_TRUE(names.insert(std::string(table[k].name)).second) << table[k].name;
  }
}

TYPED_TEST(ChoiceTable, NamesReadBackToTheirValues) {
  for (const auto& choice : choices_of(TypeParam{})) {
    EXPECT_EQ(choice_named<TypeParam>(name_of(choice.value)), choice.value);
    EXPECT_EQ(toml_text(choice.value), toml_text(std::string(choice.name)));
  }
  EXPECT_FALSE(choice_named<TypeParam>("no such name").has_value());
}

struct Spec {
  Section section = Section::constant;
  std::optional<BlankEdge> edge;
  std::vector<Component> free = {Component::y};
};

std::string complaint_about(const std::string& toml, Spec& spec) {
  const auto rule = [](const char* name, std::vector<std::string> allowed) {
    return KeyRule{.name = name, .allowed = std::move(allowed)};
  };
  const toml::table table = parse_toml(toml, "s.toml");
  Complaints complaints("s.toml");
  if (const auto* node = table.get("section"))
    read_value(*node, rule("section", allowed_words(spec.section)), spec.section, complaints);
  if (const auto* node = table.get("edge"))
    read_value(*node, rule("edge", allowed_words(spec.edge)), spec.edge, complaints);
  if (const auto* node = table.get("free"))
    read_value(*node, rule("free", allowed_words(spec.free)), spec.free, complaints);
  try {
    complaints.throw_if_any();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ChoiceValue, ReadsAloneLeftOutAndInAList) {
  Spec spec;
  EXPECT_EQ(complaint_about("section = \"incompressible\"\nedge = \"top\"\nfree = [\"z\", \"x\"]", spec), "");
  EXPECT_EQ(spec.section, Section::incompressible);
  EXPECT_EQ(spec.edge, BlankEdge::top);
  EXPECT_EQ(spec.free, (std::vector<Component>{Component::z, Component::x}));
  EXPECT_EQ(toml_text(spec.free), "[\"z\", \"x\"]");
  EXPECT_EQ(complaint_about("free = []", spec), "");
  EXPECT_TRUE(spec.free.empty());
  EXPECT_EQ(toml_text(spec.free), std::nullopt);
  EXPECT_EQ(toml_text(std::optional<BlankEdge>()), std::nullopt);
}

TEST(ChoiceValue, AWrongWordNamesTheNearestAndLeavesTheValueAlone) {
  Spec spec;
  EXPECT_EQ(complaint_about("section = \"incompresible\"", spec),
            "s.toml:1:11: 'section' is 'incompresible'; it must be one of 'incompressible', 'constant'; did you mean "
            "'incompressible'?");
  EXPECT_EQ(complaint_about("edge = 3", spec), "s.toml:1:8: 'edge' is a whole number; it must be text");
  EXPECT_EQ(complaint_about("free = [\"x\", \"x\"]", spec), "s.toml:1:14: 'free' names 'x' twice; name it once");
  EXPECT_EQ(spec.section, Section::constant);
  EXPECT_FALSE(spec.edge.has_value());
  EXPECT_EQ(spec.free, (std::vector<Component>{Component::y}));
}

}  // namespace
}  // namespace weaveform
