# Writes OUTPUT: a C++ file whose FUNCTION(), declared in HEADER, returns the text of FILE.
file(READ ${FILE} hex HEX)
string(LENGTH "${hex}" digits)
math(EXPR bytes "${digits} / 2")
string(REGEX REPLACE "(..)" "'\\\\x\\1'," characters "${hex}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\nnamespace voxilux {\nnamespace {\n\n"
  "constexpr char k_${FUNCTION}[] = {${characters}'\\0'};\n\n}  // namespace\n\n"
  "std::string_view ${FUNCTION}() {\n    return {k_${FUNCTION}, ${bytes}};\n}\n\n}  // namespace voxilux\n")
