# Writes font files down as C: the way of font_data.S without an assembler.
# In: -DFONTS=<files in the order of Face> -DOUTPUT=<name>. Out: the source file. The bytes are
# strings, since compilers take far longer for lists of numbers: 2.8 MB take 2 s here and 1 s in GCC.
cmake_minimum_required(VERSION 3.25)

set(code "/* Written by embed_fonts.cmake. */\n")
set(table)
set(index 0)
foreach(font IN LISTS FONTS)
  file(READ ${font} bytes HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(APPEND code "static const unsigned char font_${index}[] = \"${bytes}\";\n")
  string(APPEND table "  {font_${index}, font_${index} + sizeof font_${index} - 1},\n")
  math(EXPR index "${index} + 1")
endforeach()
string(APPEND code
  "struct Font { const unsigned char* begin; const unsigned char* end; };\n"
  "extern const struct Font piblocks_fonts[];\n"
  "const struct Font piblocks_fonts[] = {\n${table}};\n")
file(WRITE ${OUTPUT} "${code}")
