// Gives the module a translation unit until its first one lands.
