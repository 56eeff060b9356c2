// Never compiled: the layer check must refuse it (tests/CMakeLists.txt).
#include "lychnite/scene/scene.h"
