// Which words of Gmsh's language describe geometry. Gmsh 4.8's own list (its lexer, and the commands its grammar tells
// apart by name); a word of the language that is on no list here is refused.
#pragma once

#include <string_view>

namespace weaveform {

enum class GeoWord {
  geometry,  // a word of the language for geometry, control flow, arithmetic
  refused,   // a word of the language for anything else
  name,      // not of the language: a variable, or a word that means something in its place only
};
[[nodiscard]] GeoWord kind_of_geo_word(std::string_view word);

// Names that may stand before a name, number or string ("Progression 1.1", "Name \"length\""). Any other name in that
// place is a command.
[[nodiscard]] bool may_lead(std::string_view word);

// Kinds of size fields that only compute ("Field[1] = Distance"); others read files or run programs.
[[nodiscard]] bool is_field_of_numbers(std::string_view kind);

// "Mesh.ElementOrder" and the like: options that take numbers and concern geometry, or how it looks.
[[nodiscard]] bool is_harmless_option(std::string_view category, std::string_view name);

}  // namespace weaveform
