"""Results about bodies."""
