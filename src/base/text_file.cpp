#include "lychnite/base/text_file.h"

#include <fstream>
#include <sstream>

#include "lychnite/base/error.h"

namespace lychnite {

std::string readText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(
        {.where = path.string(), .expected = "", .found = "cannot be opened", .todo = "check the name"});
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace lychnite
