"""Values that calls take and return, and the checks of arguments."""
