# Embeds the built-in cards, so that the binary needs no data folder; editing a card reconfigures.
set(BUILTIN_CARDS "")
foreach(card IN ITEMS twintex-pw twintex-tw)
  set(file ${CMAKE_CURRENT_SOURCE_DIR}/cards/${card}.toml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND BUILTIN_CARDS "      {\"${card}\", R\"card(${text})card\"},\n")
endforeach()
configure_file(card/builtin_cards.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/card/builtin_cards.cpp @ONLY)
