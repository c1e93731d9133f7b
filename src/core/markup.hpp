// Text inside of HTML and XML.
// In: any text. Out: what shows as that text, in attributes too.
#pragma once

#include <string>

namespace piblocks {

/// What XML does not allow is escaped as printable() does.
std::string escaped(const std::string& text);

}  // namespace piblocks
