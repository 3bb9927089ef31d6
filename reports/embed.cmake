# cmake -DPARTS=a;b -DOUTPUT=x.cpp -P embed.cmake
# Writes a C++ file with one raw string literal a part, and part(name) to find it by its file name.
set(text "#include <reports/page_parts.hpp>\n#include <stdexcept>\n#include <string>\n\n")
string(APPEND text "namespace liecheck::reports {\n\nstd::string_view part(std::string_view name) {\n")
foreach(path IN LISTS PARTS)
  get_filename_component(name ${path} NAME)
  file(READ ${path} content)
  string(APPEND text "  if (name == \"${name}\") return R\"liecheck(${content})liecheck\";\n")
endforeach()
string(APPEND text "  throw std::logic_error(\"no such part of the page: \" + std::string(name));\n}\n\n")
string(APPEND text "}  // namespace liecheck::reports\n")
file(WRITE ${OUTPUT} "${text}")
