// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/fields.h>

namespace pcl_als {
namespace {

using namespace field;

enum class Colour { red, green };
const char* toString(Colour colour) {
  return colour == Colour::red ? "red" : "green";
}

struct Leaf {
  std::string name;
  double angle = 0.0;  // radians
  std::optional<int> level;
};

struct Tree {
  bool evergreen = false;
  long balance = -3;
  std::size_t rings = 7;
  double height = 1.5, unknown = std::nan("");
  std::string remark;
  Colour colour = Colour::green;
  Eigen::Vector2d place = {1.0, 2.0};
  Eigen::MatrixXd table = Eigen::MatrixXd::Identity(2, 2);
  std::vector<Leaf> leaves;
  std::optional<Leaf> bud;
  std::vector<std::vector<double>> nested;
  NamedValues<Leaf> named;
  std::map<std::string, double> sizes;
};

constexpr double kUnit = 0.5;

const Fields<Leaf>& leafFields() {
  static const Fields<Leaf> fields(
      "leaf", "A leaf.",
      {{"name", &Leaf::name, "Its name"},
       {"angle_deg", &Leaf::angle, "Its angle", in(kUnit), within(90.0)},
       {"level", &Leaf::level, "Its level"}});
  return fields;
}

const Fields<Tree>& treeFields() {
  using F = Field<Tree>;
  static const Fields<Tree> fields(
      "tree", "A tree.",
      {F::constant("format", "tree", "Format"),
       {"evergreen", &Tree::evergreen, "Keeps its leaves"},
       {"balance", &Tree::balance, "Balance"},
       {"rings", &Tree::rings, "Rings", mayBeMissing},
       {"height_m", &Tree::height, "Height", alwaysKnown, notNegative, csv(2)},
       {"unknown_m", &Tree::unknown, "Not known", csv(2)},
       {"remark", &Tree::remark, "Remark, \"quoted\"", unlessEmpty, csv("note")},
       {"colour", &Tree::colour, FieldNames<Colour>(toString, {Colour::red, Colour::green}),
        "Colour", csv(0)},
       {"place_m", &Tree::place, "Place"},
       {"table", &Tree::table, "Numbers"},
       {"leaves", &Tree::leaves, leafFields(), "Leaves"},
       {"bud", &Tree::bud, leafFields(), "A bud", unlessEmpty},
       {"twice_m", [](const Tree& t) { return 2.0 * t.height; }, "Twice the height",
        onlyIf(&Tree::evergreen)},
       {"old", [](const Tree& t) { return t.rings > 100; }, "Age",
        knownIf([](const Tree& t) { return t.rings > 0; })},
       {"nested", &Tree::nested, "Lists of lists"},
       {"named", &Tree::named, leafFields(), "Leaves by name", unlessEmpty},
       {"sizes_m", &Tree::sizes, "Sizes by name", unlessEmpty}});
  return fields;
}

Tree exampleTree() {
  Tree tree;
  tree.leaves = {{"a", 0.25, 3}, {"b", -0.5, std::nullopt}};
  tree.nested = {{1.0, 2.0}, {}};
  return tree;
}

/// The message of reading the example with one value changed.
std::string refusalOfValue(std::string_view key, FieldValue value) {
  FieldValue file = treeFields().write(exampleTree());
  file.set(key, std::move(value));
  Tree tree;
  try {
    treeFields().read(tree, {file, "tree.json"});
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Fields, ValuesByNameKeepTheirOrder) {
  Tree tree = exampleTree();
  tree.named = {{"second", {"b", 0.25, 3}}, {"first", {"a", 0.5, 1}}};
  tree.sizes = {{"x", 2.0}};
  const FieldValue file = treeFields().write(tree);
  const auto& named = *file.find("named")->as<FieldValue::Object>();
  EXPECT_EQ(named.front().first, "second");
  EXPECT_EQ(*named.front().second.find("angle_deg"), FieldValue(0.5));
  Tree read;
  treeFields().read(read, {file, "tree.json"});
  EXPECT_EQ(treeFields().write(read), file);
  EXPECT_EQ(read.named.at(1).second.name, "a");
  EXPECT_EQ(read.sizes.at("x"), 2.0);
  EXPECT_NE(refusalOfValue("sizes_m", FieldValue::Object{{"y", "large"}}).find("'sizes_m.y'"),
            std::string::npos);
  EXPECT_NE(refusalOfValue("named", 3).find("must be an object"), std::string::npos);
  const FieldValue schema = schemaOf(treeFields(), "tree.json");
  const FieldValue* sizes = schema.find("properties")->find("sizes_m");
  EXPECT_EQ(*sizes->find("additionalProperties")->find("type"),
            FieldValue(FieldValue::List{"number", "null"}));
}

TEST(Fields, WriteAndReadTheSameValues) {
  Tree tree = exampleTree();
  tree.evergreen = true;
  tree.remark = "x";
  tree.colour = Colour::red;
  tree.bud = Leaf{"c", 1.0, 1};
  const FieldValue file = treeFields().write(tree);
  EXPECT_EQ(*file.find("leaves")->as<FieldValue::List>()->front().find("angle_deg"),
            FieldValue(0.5));
  EXPECT_EQ(*file.find("colour"), FieldValue("red"));
  EXPECT_EQ(*file.find("twice_m"), FieldValue(3.0));
  Tree read;
  treeFields().read(read, {file, "tree.json"});
  EXPECT_EQ(treeFields().write(read), file);
  EXPECT_EQ(read.leaves[0].angle, 0.25);
  EXPECT_EQ(read.place, tree.place);
  EXPECT_EQ(read.table, tree.table);
  EXPECT_EQ(read.balance, -3);
  EXPECT_FALSE(read.leaves[1].level.has_value());
  EXPECT_TRUE(std::isnan(read.unknown));
}

TEST(Fields, UnknownValuesAreNullAndConditionalOnesAbsent) {
  Tree tree = exampleTree();
  tree.rings = 0;
  const FieldValue file = treeFields().write(tree);
  EXPECT_TRUE(file.find("old")->isNull());
  EXPECT_EQ(file.find("twice_m"), nullptr);
  EXPECT_EQ(file.find("remark"), nullptr);
  EXPECT_EQ(file.find("bud"), nullptr);
  tree.rings = 101;
  EXPECT_EQ(*treeFields().write(tree).find("old"), FieldValue(true));
}

TEST(Fields, FieldsThatAreNotDescribedAreIgnored) {
  EXPECT_EQ(refusalOfValue("not_described", FieldValue(3)), "");
}

TEST(Fields, DamagedFieldsAreNamedWithTheirPath) {
  FieldValue leaf;
  leaf.set("name", "a");
  leaf.set("angle_deg", "steep");
  leaf.set("level", FieldValue());
  FieldValue::List leaves{
      treeFields().write(exampleTree()).find("leaves")->as<FieldValue::List>()->front()};
  leaves.push_back(leaf);
  EXPECT_EQ(refusalOfValue("leaves", leaves), "tree.json: 'leaves[1].angle_deg' must be a number");
  leaves[1].set("angle_deg", 90.5);
  EXPECT_EQ(
      refusalOfValue("leaves", leaves),
      "tree.json: 'leaves[1].angle_deg' is out of range: 90.5 deg is not between -90 and 90 deg");
  leaves[1] = FieldValue(FieldValue::Object());
  EXPECT_EQ(refusalOfValue("leaves", leaves), "tree.json: 'leaves[1].name' is missing");
  EXPECT_EQ(refusalOfValue("leaves", 3), "tree.json: 'leaves' must be a list");
  EXPECT_EQ(refusalOfValue("colour", "blue"),
            "tree.json: 'colour' is 'blue'; it must be red or green");
  EXPECT_EQ(refusalOfValue("height_m", FieldValue()), "tree.json: 'height_m' must be a number");
  EXPECT_EQ(refusalOfValue("height_m", -1.0), "tree.json: 'height_m' must not be negative");
  EXPECT_EQ(refusalOfValue("evergreen", 1), "tree.json: 'evergreen' must be true or false");
  EXPECT_EQ(refusalOfValue("rings", -1), "tree.json: 'rings' must be a whole number, 0 or more");
  EXPECT_EQ(refusalOfValue("balance", 0.5), "tree.json: 'balance' must be a whole number");
  EXPECT_EQ(refusalOfValue("place_m", FieldValue::List{1.0}),
            "tree.json: 'place_m' must have 2 values, has 1");
  EXPECT_EQ(refusalOfValue("bud", FieldValue::List{}), "tree.json: 'bud' must be an object");
}

TEST(Fields, FieldsThatMayBeMissingKeepTheirValue) {
  const FieldValue written = treeFields().write(exampleTree());
  FieldValue::Object file = *written.as<FieldValue::Object>();
  file.erase(file.begin() + 3);  // rings
  const FieldValue without = file;
  Tree tree;
  tree.rings = 41;
  treeFields().read(tree, {without, "tree.json"});
  EXPECT_EQ(tree.rings, 41U);
  file.erase(file.begin() + 3);  // height_m
  const FieldValue damaged = file;
  EXPECT_THROW(treeFields().read(tree, {damaged, "tree.json"}), InputError);
  EXPECT_THROW(treeFields().read(tree, {FieldValue("x"), "tree.json"}), InputError);
}

TEST(Fields, ColumnsOfCsvFiles) {
  Tree tree = exampleTree();
  tree.remark = "a, \"b\"";
  EXPECT_EQ(treeFields().csvHeader(), "height_m,unknown_m,note,colour\n");
  EXPECT_EQ(treeFields().csvLine(tree), "1.50,,\"a, \"\"b\"\"\",green\n");
  EXPECT_EQ(treeFields().csvHeader("tree_", ""),
            "tree_height_m,tree_unknown_m,tree_note,tree_colour");
}

TEST(Fields, SchemaStatesTypesUnitsAndConditions) {
  const FieldValue schema = schemaOf(treeFields(), "tree.json");
  const auto property = [&](const char* name) { return *schema.find("properties")->find(name); };
  const FieldValue::List number_or_null{"number", "null"};
  EXPECT_EQ(*property("unknown_m").find("type"), FieldValue(number_or_null));
  EXPECT_EQ(*property("unknown_m").find("unit"), FieldValue("m"));
  EXPECT_EQ(*property("height_m").find("type"), FieldValue("number"));
  EXPECT_EQ(*property("height_m").find("minimum"), FieldValue(0));
  EXPECT_EQ(*property("rings").find("minimum"), FieldValue(0));
  EXPECT_EQ(*property("format").find("const"), FieldValue("tree"));
  EXPECT_EQ(*property("colour").find("enum"), FieldValue(FieldValue::List{"red", "green"}));
  EXPECT_EQ(*property("place_m").find("minItems"), FieldValue(2));
  EXPECT_EQ(*property("leaves").find("items")->find("$ref"), FieldValue("#/$defs/leaf"));
  EXPECT_EQ(
      *schema.find("$defs")->find("leaf")->find("properties")->find("angle_deg")->find("maximum"),
      FieldValue(90.0));
  const auto& required = *schema.find("required")->as<FieldValue::List>();
  const auto isRequired = [&](const char* name) {
    return std::find(required.begin(), required.end(), FieldValue(name)) != required.end();
  };
  EXPECT_TRUE(isRequired("rings"));
  EXPECT_FALSE(isRequired("bud"));
  EXPECT_FALSE(isRequired("twice_m"));
}

TEST(Fields, ReferenceHasASectionForEachTable) {
  const std::string text = referenceOf(treeFields(), "tree");
  EXPECT_NE(text.find("| `unknown_m` | number or null | m | Not known |"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| `leaves` | list of: [leaf](#tree-leaf) |"), std::string::npos);
  EXPECT_NE(text.find("| `bud` | [leaf](#tree-leaf) or null, optional |"), std::string::npos);
  EXPECT_NE(text.find("### tree: leaf\n"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
