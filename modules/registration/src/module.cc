#include "asperity/registration/registration_result.h"
