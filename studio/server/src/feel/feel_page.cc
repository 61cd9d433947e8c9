#include "feel/feel_page.h"
