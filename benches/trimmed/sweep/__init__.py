"""Generated parts, written in three formats and measured against OpenCASCADE and each other."""
