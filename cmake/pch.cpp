// Anchor of the shared precompiled header (cmake/HerseyModule.cmake).
